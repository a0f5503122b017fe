// SPDX-License-Identifier: BSD-3-Clause
#include "run/input_files.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <thread>

namespace bubblesim {
namespace {

constexpr std::chrono::microseconds kBetweenLooks{100};
constexpr std::chrono::microseconds kAwakeAfterServing{100};  // who calls in a row calls again within it

timespec to_timespec(std::chrono::nanoseconds duration) {
  duration = std::max(duration, std::chrono::nanoseconds::zero());
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(duration);
  return {static_cast<time_t>(whole.count()), static_cast<long>((duration - whole).count())};
}

bool has_more(const std::shared_ptr<WatchedFile>& file) { return file->has_more; }

}  // namespace

void InputFiles::remove(const WatchedFile& file) {
  const auto found = std::find_if(files_.begin(), files_.end(), [&](const auto& each) { return each.get() == &file; });
  if (found != files_.end()) files_.erase(found);
}

InputFiles::Event InputFiles::wait(Inbox& inbox, Inbox::WaitFor what, Clock::time_point end) {
  const Inbox::Wait waiting(inbox, what);
  if (waiting.is_over()) return Event::kInbox;
  const bool is_readable = look_for_the_next(inbox, waiting, end) || poll_files(inbox.descriptor(), end - Clock::now());
  if (waiting.is_over()) return Event::kInbox;
  return is_readable ? Event::kFile : Event::kTime;
}

void InputFiles::serve_without_wait() {
  if (files_.empty()) return;
  const Clock::time_point now = Clock::now();
  const bool due = now - last_look_ >= kBetweenLooks;
  if (!due && std::none_of(files_.begin(), files_.end(), has_more)) return;
  if (due) poll_files(-1, Clock::duration::zero());
  serve();
}

/// Stays awake for a moment after serving a file, because a sleeping thread takes as long to wake up as a call takes.
/// Gives way to the threads that bring the next call. Returns whether a file is readable.
bool InputFiles::look_for_the_next(Inbox& inbox, const Inbox::Wait& waiting, Clock::time_point end) {
  const Clock::time_point asleep_from = std::min(end, last_served_ + kAwakeAfterServing);
  while (Clock::now() < asleep_from && !waiting.is_over()) {
    if (poll_files(inbox.descriptor(), Clock::duration::zero())) return true;
    std::this_thread::yield();
  }
  return false;
}

/// Notes which files are readable; a negative descriptor is left out. Returns whether there are any.
bool InputFiles::poll_files(int inbox, Clock::duration timeout) {
  polled_.assign(1, {inbox, POLLIN, 0});
  for (const auto& file : files_) polled_.push_back({file->descriptor, POLLIN, 0});
  bool found = std::any_of(files_.begin(), files_.end(), has_more);
  const timespec longest = to_timespec(found ? Clock::duration::zero() : timeout);
  if (ppoll(polled_.data(), polled_.size(), &longest, nullptr) > 0) {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (polled_[i + 1].revents != 0) found = files_[i]->has_more = true;
    }
  }
  last_look_ = Clock::now();
  return found;
}

void InputFiles::serve() {
  const std::vector<std::shared_ptr<WatchedFile>> files = files_;  // serving one may add or remove some
  for (const auto& file : files) {
    if (!file->has_more || std::find(files_.begin(), files_.end(), file) == files_.end()) continue;
    file->has_more = false;  // look_again() in the function sets it again
    try {
      if (file->serve()) file->has_more = true;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "error: a socket is not served any more: %s\n", error.what());
      remove(*file);
    }
    last_served_ = Clock::now();
  }
}

}  // namespace bubblesim
