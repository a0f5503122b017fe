// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/access_lock.hpp"

namespace bubblesim {

void AccessLock::take() {
  const std::uint64_t number = next_++;
  if (served_ != number) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return served_ == number; });
  }
  owner_ = std::this_thread::get_id();
}

bool AccessLock::try_take() {
  std::uint64_t number = served_;
  if (!next_.compare_exchange_strong(number, number + 1)) return false;
  owner_ = std::this_thread::get_id();
  return true;
}

void AccessLock::release() {
  owner_ = std::thread::id();
  const std::uint64_t number = ++served_;
  if (next_ == number) return;
  { const std::lock_guard lock(mutex_); }  // a thread that read the old number waits by now
  changed_.notify_all();
}

}  // namespace bubblesim
