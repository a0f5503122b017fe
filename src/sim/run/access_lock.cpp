// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/access_lock.hpp"

#include <sstream>
#include <stdexcept>

#include "bubblesim/error.hpp"

namespace bubblesim {
namespace {

[[noreturn]] void refuse_second_claim(std::thread::id owner) {
  std::ostringstream why;
  why << "a Runner runs this simulation already, in thread " << owner
      << ": close that Runner first (in Python by leaving its 'with' statement, in C++ with finish())";
  throw InvalidInput(why.str());
}

}  // namespace

void AccessLock::check_not_claimed() const {
  const std::thread::id claimed_by = claimed_by_;
  if (claimed_by == std::thread::id() || claimed_by == std::this_thread::get_id()) return;
  throw std::logic_error(
      "a Runner runs this simulation in another thread: use the runner's commands, its call() or its frames, or end it "
      "first");
}

void AccessLock::check_can_be_claimed() const {
  const std::thread::id claimed_by = claimed_by_;
  if (claimed_by != std::thread::id()) refuse_second_claim(claimed_by);
}

void AccessLock::claim() {
  std::thread::id claimed_by;
  if (!claimed_by_.compare_exchange_strong(claimed_by, std::this_thread::get_id())) refuse_second_claim(claimed_by);
}

void AccessLock::take() {
  check_not_claimed();
  wait_for_turn();
}

void AccessLock::wait_for_turn() noexcept {
  const std::uint64_t number = next_++;
  if (served_ != number) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return served_ == number; });
  }
  owner_ = std::this_thread::get_id();
}

bool AccessLock::try_take() {
  check_not_claimed();
  std::uint64_t number = served_;
  if (!next_.compare_exchange_strong(number, number + 1)) return false;
  owner_ = std::this_thread::get_id();
  return true;
}

void AccessLock::release() noexcept {
  owner_ = std::thread::id();
  const std::uint64_t number = ++served_;
  if (next_ == number) return;
  { const std::lock_guard lock(mutex_); }  // a thread that read the old number waits by now
  changed_.notify_all();
}

}  // namespace bubblesim
