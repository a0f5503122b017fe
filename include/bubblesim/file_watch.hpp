// SPDX-License-Identifier: BSD-3-Clause
// Lets a runner serve a socket: its requests are commands of the runner.
#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "bubblesim/runner.hpp"

namespace bubblesim {

/// Waits on a thread of its own until a file descriptor is readable, and then has the runner call a function between
/// two steps; a runner that waits is woken at once. The thread looks at the descriptor again after the function has
/// returned, and without looking when it returned true: there is more.
class FileWatch {
 public:
  /// The runner and the descriptor must outlive this object. Throws std::system_error.
  FileWatch(Runner& runner, int descriptor, std::function<bool()> serve);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// After it has returned, the function is not called any more. Call it on the runner's thread, or after its run.
  void close();

 private:
  struct State;

  std::shared_ptr<State> state_;  // also of a call that the runner has not made yet
  std::thread thread_;
};

}  // namespace bubblesim
