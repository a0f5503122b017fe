// SPDX-License-Identifier: BSD-3-Clause
// Lets a runner serve a socket between its steps.
#pragma once

#include <functional>
#include <memory>

#include "bubblesim/runner.hpp"

namespace bubblesim {

/// A file descriptor that the loop of a runner polls.
struct WatchedDescriptor {
  int descriptor;
  std::function<bool()> serve;
  /// It is served without a poll: there is more, or there was some before the first poll.
  bool has_more = true;
};

/// Has a runner call a function between two steps, on its thread, when a file descriptor is readable; a runner that
/// waits for input or for real time is woken by it. After a call that returned true (there is more) the function is
/// called again without a poll, after commands and after a step that is due. An exception of the
/// function ends the watch.
///
/// Use this class before the run of the runner, after it, or on the runner's thread: elsewhere its constructor and
/// close() throw std::logic_error, and its destructor leaves the end of the watch to the runner's thread.
class DescriptorWatch {
 public:
  /// The runner and the descriptor must outlive this object.
  DescriptorWatch(Runner& runner, int descriptor, std::function<bool()> serve);
  ~DescriptorWatch();
  DescriptorWatch(const DescriptorWatch&) = delete;
  DescriptorWatch& operator=(const DescriptorWatch&) = delete;

  /// Has the function called even if the descriptor is not readable: for edge-triggered descriptors.
  void serve_again() {
    if (watched_) watched_->has_more = true;
  }
  /// After it has returned, the function is not called any more.
  void close();

 private:
  Runner& runner_;
  std::shared_ptr<WatchedDescriptor> watched_;
};

}  // namespace bubblesim
