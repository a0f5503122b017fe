// SPDX-License-Identifier: BSD-3-Clause
// Who may read and change a simulation when several threads do.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace bubblesim {

/// Held by one thread at a time, given to waiting threads in the order in which they came: one that steps without end
/// keeps nobody out.
class AccessLock {
 public:
  /// Takes the lock while it lives, unless this thread has it already.
  class Hold {
   public:
    explicit Hold(AccessLock& lock) : lock_(lock.is_mine() ? nullptr : &lock) {
      if (lock_ != nullptr) lock_->take();
    }
    ~Hold() {
      if (lock_ != nullptr) lock_->release();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    AccessLock* lock_;
  };

  /// Lets others have the lock while it lives, if this thread has it.
  class Pause {
   public:
    explicit Pause(AccessLock& lock) : lock_(lock.is_mine() ? &lock : nullptr) {
      if (lock_ != nullptr) lock_->release();
    }
    ~Pause() {
      if (lock_ != nullptr) lock_->take();
    }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    AccessLock* lock_;
  };

  bool is_mine() const { return owner_ == std::this_thread::get_id(); }
  void take();
  /// Takes it if nobody has it or waits for it.
  bool try_take();
  void release();

 private:
  // Each thread draws a number, and has the lock when that number is served.
  std::atomic<std::uint64_t> next_{0};
  std::atomic<std::uint64_t> served_{0};
  std::atomic<std::thread::id> owner_{};
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace bubblesim
