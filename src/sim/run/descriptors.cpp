// SPDX-License-Identifier: BSD-3-Clause
#include "run/descriptors.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <thread>

namespace bubblesim {
namespace {

constexpr std::chrono::microseconds kBetweenPolls{100};
constexpr std::chrono::microseconds kAwakeAfterServing{100};  // who calls in a row calls again within it

timespec to_timespec(std::chrono::nanoseconds duration) {
  duration = std::max(duration, std::chrono::nanoseconds::zero());
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(duration);
  return {static_cast<time_t>(whole.count()), static_cast<long>((duration - whole).count())};
}

bool has_more(const std::shared_ptr<WatchedDescriptor>& each) { return each->has_more; }

}  // namespace

void Descriptors::remove(const WatchedDescriptor& descriptor) {
  const auto found = std::find_if(descriptors_.begin(), descriptors_.end(),
                                  [&](const auto& each) { return each.get() == &descriptor; });
  if (found != descriptors_.end()) descriptors_.erase(found);
}

Descriptors::Event Descriptors::wait(Inbox& inbox, Inbox::WaitFor what, Clock::time_point end) {
  const Inbox::Wait waiting(inbox, what);
  if (waiting.is_over()) return Event::kInbox;
  const bool is_readable = busy_poll(inbox, waiting, end) || poll_all(inbox.descriptor(), end - Clock::now());
  if (waiting.is_over()) return Event::kInbox;
  return is_readable ? Event::kReadable : Event::kTime;
}

void Descriptors::serve_without_wait() {
  if (descriptors_.empty()) return;
  const Clock::time_point now = Clock::now();
  const bool due = now - last_poll_ >= kBetweenPolls;
  if (!due && std::none_of(descriptors_.begin(), descriptors_.end(), has_more)) return;
  if (due) poll_all(-1, Clock::duration::zero());
  serve();
}

/// Stays awake for a moment after serving a descriptor, because a sleeping thread takes as long to wake up as a call
/// takes. Yields to the threads that bring the next call. Returns whether a descriptor is readable.
bool Descriptors::busy_poll(Inbox& inbox, const Inbox::Wait& waiting, Clock::time_point end) {
  const Clock::time_point asleep_from = std::min(end, last_served_ + kAwakeAfterServing);
  while (Clock::now() < asleep_from && !waiting.is_over()) {
    if (poll_all(inbox.descriptor(), Clock::duration::zero())) return true;
    std::this_thread::yield();
  }
  return false;
}

/// Notes which descriptors are readable; a negative one is left out. Returns whether there are any.
bool Descriptors::poll_all(int inbox, Clock::duration timeout) {
  polled_.assign(1, {inbox, POLLIN, 0});
  for (const auto& each : descriptors_) polled_.push_back({each->descriptor, POLLIN, 0});
  bool found = std::any_of(descriptors_.begin(), descriptors_.end(), has_more);
  const timespec longest = to_timespec(found ? Clock::duration::zero() : timeout);
  if (ppoll(polled_.data(), polled_.size(), &longest, nullptr) > 0) {
    for (std::size_t i = 0; i < descriptors_.size(); ++i) {
      if (polled_[i + 1].revents != 0) found = descriptors_[i]->has_more = true;
    }
  }
  last_poll_ = Clock::now();
  return found;
}

void Descriptors::serve() {
  const std::vector<std::shared_ptr<WatchedDescriptor>> all = descriptors_;  // serving one may add or remove some
  for (const auto& each : all) {
    if (!each->has_more || std::find(descriptors_.begin(), descriptors_.end(), each) == descriptors_.end()) continue;
    each->has_more = false;  // serve_again() in the function sets it again
    try {
      if (each->serve()) each->has_more = true;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "error: a socket is not served any more: %s\n", error.what());
      remove(*each);
    }
    last_served_ = Clock::now();
  }
}

}  // namespace bubblesim
