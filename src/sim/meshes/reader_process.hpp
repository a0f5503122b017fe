// SPDX-License-Identifier: BSD-3-Clause
// A program of the library that reads files in its own process, which may crash or be killed at its limits.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace bubblesim {

/// The process is killed at the latest when this ends. Its input is a stream socket, and it has no other open files.
class ReaderProcess {
 public:
  /// Starts a program in the folder bubblesim next to the library. Throws MeshError.
  explicit ReaderProcess(const std::string& name);
  ~ReaderProcess() { end(); }
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// To the process.
  int socket() const { return sockets_.ends[0]; }

  /// Kills it, and returns why it had ended by itself. `seconds` is its limit of CPU time.
  std::string reason_of_end(std::uint64_t seconds);

 private:
  /// A pair of stream sockets, close-on-exec also for programs started elsewhere.
  struct SocketPair {
    SocketPair();
    ~SocketPair();
    SocketPair(const SocketPair&) = delete;
    SocketPair& operator=(const SocketPair&) = delete;

    int ends[2] = {-1, -1};
  };

  /// Returns its status as waitpid does.
  int end();

  SocketPair sockets_;
  pid_t child_;
};

}  // namespace bubblesim
