// SPDX-License-Identifier: BSD-3-Clause
#include "request_queue.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace bubblesim {
namespace {

constexpr std::chrono::milliseconds kAskInterval{20};

}  // namespace

void RequestQueue::add(std::function<void()> answer, std::uint64_t owner) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back({std::move(answer), owner});
  }
  changed_.notify_all();
  if (on_arrival_) on_arrival_();
}

void RequestQueue::remove(std::uint64_t owner) {
  std::deque<Request> removed;  // destroyed after the lock is released
  const std::lock_guard lock(mutex_);
  const auto kept = std::stable_partition(requests_.begin(), requests_.end(),
                                          [owner](const Request& request) { return request.owner != owner; });
  std::move(kept, requests_.end(), std::back_inserter(removed));
  requests_.erase(kept, requests_.end());
}

void RequestQueue::serve() {
  std::unique_lock lock(mutex_);
  for (std::size_t left = requests_.size(); left > 0 && !requests_.empty(); --left) {
    const Request request = std::move(requests_.front());
    requests_.pop_front();
    lock.unlock();
    request.answer();
    lock.lock();
  }
}

bool RequestQueue::serve_until(const std::function<bool()>& done, Clock::time_point deadline) {
  for (;;) {
    int seen = 0;
    {
      const std::lock_guard lock(mutex_);
      seen = wakes_;
    }
    serve();
    if (done()) return true;
    const auto now = Clock::now();
    if (now >= deadline) return false;
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, std::min(deadline, now + kAskInterval),
                        [&] { return wakes_ != seen || !requests_.empty(); });
  }
}

void RequestQueue::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

}  // namespace bubblesim
