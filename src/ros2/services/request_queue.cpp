// SPDX-License-Identifier: BSD-3-Clause
#include "services/request_queue.hpp"

#include <algorithm>
#include <utility>

namespace bubblesim::ros2 {
namespace {

constexpr std::chrono::milliseconds kAskInterval{20};

}  // namespace

void RequestQueue::add(std::function<void()> answer) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(std::move(answer));
  }
  changed_.notify_all();
  if (arrivals_ != nullptr) arrivals_->note();
}

void RequestQueue::serve() {
  std::unique_lock lock(mutex_);
  for (std::size_t left = requests_.size(); left > 0 && !requests_.empty(); --left) {
    const std::function<void()> answer = std::move(requests_.front());
    requests_.pop_front();
    lock.unlock();
    answer();
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

}  // namespace bubblesim::ros2
