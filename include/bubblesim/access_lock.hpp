// SPDX-License-Identifier: BSD-3-Clause
// A fair lock for a simulation that several threads read and change.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace bubblesim {

/// A lock that one thread holds at a time. Waiting threads get it in the order in which they asked, so a thread that
/// steps in a loop does not keep the others out.
class AccessLock {
 public:
  /// Holds the lock during its lifetime. Does nothing if this thread already holds it.
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

  /// Releases the lock during its lifetime, if this thread holds it.
  class Pause {
   public:
    explicit Pause(AccessLock& lock) : lock_(lock.is_mine() ? &lock : nullptr) {
      if (lock_ != nullptr) lock_->release();
    }
    ~Pause() {
      if (lock_ != nullptr) lock_->wait_for_turn();  // also when another thread has claimed the lock meanwhile
    }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    AccessLock* lock_;
  };

  /// Holds the lock during its lifetime and refuses it to other threads: they get std::logic_error instead of waiting.
  class Claim {
   public:
    /// Throws InvalidInput when the lock is claimed already.
    explicit Claim(AccessLock& lock) : lock_(lock) {
      lock_.claim();  // first, so that only threads that wait already are let through
      lock_.wait_for_turn();
    }
    ~Claim() {
      lock_.claimed_by_ = std::thread::id();
      lock_.release();
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    AccessLock& lock_;
  };

  bool is_mine() const { return owner_ == std::this_thread::get_id(); }
  /// Throws std::logic_error while another thread has claimed the lock.
  void take();
  /// Throws like take().
  void check_not_claimed() const;
  /// Throws InvalidInput while any thread has claimed the lock.
  void check_can_be_claimed() const;
  /// Takes the lock if no thread holds it or waits for it. Throws like take().
  bool try_take();
  void release() noexcept;

 private:
  void claim();
  void wait_for_turn() noexcept;

  // Each thread draws a number and gets the lock when that number is served.
  std::atomic<std::uint64_t> next_{0};
  std::atomic<std::uint64_t> served_{0};
  std::atomic<std::thread::id> owner_{};
  std::atomic<std::thread::id> claimed_by_{};
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace bubblesim
