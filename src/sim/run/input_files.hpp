// SPDX-License-Identifier: BSD-3-Clause
// The file descriptors that a loop serves, and its wait for them and for its inbox.
#pragma once

#include <poll.h>

#include <memory>
#include <vector>

#include "bubblesim/file_watch.hpp"
#include "run/inbox.hpp"

namespace bubblesim {

/// For the thread of the loop.
class InputFiles {
 public:
  using Clock = Inbox::Clock;
  enum class Event { kTime, kInbox, kFile };

  void add(std::shared_ptr<WatchedFile> file) { files_.push_back(std::move(file)); }
  void remove(const WatchedFile& file);

  /// Waits until `end`, until the inbox has something, or until a file is readable. The inbox comes first: what files
  /// want cannot keep a command waiting.
  Event wait(Inbox& inbox, Inbox::WaitFor what, Clock::time_point end);
  /// Serves the files that are readable now. In a loop that does not wait, it looks at most every 0.1 ms, because the
  /// system call would take a noticeable part of a short step.
  void serve_without_wait();
  /// Serves the files that the last wait has found.
  void serve();

 private:
  bool look_for_the_next(Inbox& inbox, const Inbox::Wait& waiting, Clock::time_point end);
  bool poll_files(int inbox, Clock::duration timeout);

  std::vector<std::shared_ptr<WatchedFile>> files_;
  std::vector<pollfd> polled_;  // kept for its memory; the inbox first
  Clock::time_point last_look_;
  Clock::time_point last_served_;
};

}  // namespace bubblesim
