// SPDX-License-Identifier: BSD-3-Clause
// The server of the window, a process of its own that ends with this one.
#pragma once

#include <filesystem>
#include <optional>

#include "options.hpp"

namespace bubblesim::app {

/// A new folder that only this user may enter, for a socket; removed at the end.
class PrivateFolder {
 public:
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

class WebServer {
 public:
  /// Starts the server if the options want it, and sets their window_socket, where it waits for the remote API server.
  /// Throws std::runtime_error when it cannot be started.
  explicit WebServer(Options& options);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

 private:
  std::optional<PrivateFolder> folder_;  // of the socket
  int lifeline_ = -1;                    // the server ends when this is closed
};

}  // namespace bubblesim::app
