// SPDX-License-Identifier: BSD-3-Clause
// The server of the window, a process of its own that ends with this one.
#pragma once

#include "options.hpp"

namespace bubblesim::app {

/// Takes a free port for the door if the window is wanted and no port for clients is given, and lets the simulation
/// start at once, as without a door.
void complete_for_web(Options& options);

class WebServer {
 public:
  /// Starts the server if the options want it. It waits for the door. Throws std::runtime_error when it cannot be
  /// started.
  explicit WebServer(const Options& options);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

 private:
  int lifeline_ = -1;  // the server ends when this is closed
};

}  // namespace bubblesim::app
