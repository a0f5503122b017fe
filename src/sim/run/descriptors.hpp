// SPDX-License-Identifier: BSD-3-Clause
// The file descriptors that a loop serves, and its wait for them and for its inbox.
#pragma once

#include <poll.h>

#include <memory>
#include <vector>

#include "bubblesim/descriptor_watch.hpp"
#include "run/inbox.hpp"

namespace bubblesim {

/// For the thread of the loop.
class Descriptors {
 public:
  using Clock = Inbox::Clock;
  enum class Event { kTime, kInbox, kReadable };

  void add(std::shared_ptr<WatchedDescriptor> descriptor) { descriptors_.push_back(std::move(descriptor)); }
  void remove(const WatchedDescriptor& descriptor);

  /// Waits until `end`, until the inbox has something, or until a descriptor is readable. The inbox comes first:
  /// what descriptors want cannot keep a command waiting.
  Event wait(Inbox& inbox, Inbox::WaitFor what, Clock::time_point end);
  /// Serves the descriptors that are readable now. In a loop that does not wait, it polls at most every 0.1 ms, because
  /// the system call would take a noticeable part of a short step.
  void serve_without_wait();
  /// Serves the descriptors that the last wait has found.
  void serve();

 private:
  bool busy_poll(Inbox& inbox, const Inbox::Wait& waiting, Clock::time_point end);
  bool poll_all(int inbox, Clock::duration timeout);

  std::vector<std::shared_ptr<WatchedDescriptor>> descriptors_;
  std::vector<pollfd> polled_;  // kept for its memory; the inbox first
  Clock::time_point last_poll_;
  Clock::time_point last_served_;
};

}  // namespace bubblesim
