// SPDX-License-Identifier: BSD-3-Clause
// The commands that threads give to the thread that runs a simulation.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"

namespace bubblesim {

struct Command {
  enum class Kind { kStart, kPause, kStop, kOther };
  Kind kind = Kind::kOther;
  /// Carries it out, calls `before_answer`, and answers.
  std::function<void(const std::function<void()>& before_answer)> run;
  /// Answers that it is not carried out.
  std::function<void(const std::exception_ptr&)> refuse;
};

/// Thread-safe.
class Inbox {
 public:
  using Clock = std::chrono::steady_clock;

  /// Refuses the command if the inbox is closed.
  void put(Command command) {
    {
      const std::lock_guard lock(mutex_);
      if (!closed_) {
        commands_.push_back(std::move(command));
        changed_.notify_all();
        return;
      }
    }
    command.refuse(has_ended());
  }

  void open() {
    const std::lock_guard lock(mutex_);
    closed_ = false;
  }
  /// Refuses all commands from here on, also those that are there.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    for (const Command& command : take()) command.refuse(has_ended());
  }

  static std::exception_ptr has_ended() { return std::make_exception_ptr(NotCarriedOut("the simulation has ended")); }

  /// All commands so far, in order.
  std::vector<Command> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }

  bool empty() const {
    const std::lock_guard lock(mutex_);
    return commands_.empty();
  }
  bool has(Command::Kind kind) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(commands_.begin(), commands_.end(), [kind](const Command& each) { return each.kind == kind; });
  }

  /// Ends wait_for_input().
  void wake() {
    {
      const std::lock_guard lock(mutex_);
      woken_ = true;
    }
    changed_.notify_all();
  }

  /// Waits until `end`, or until there are commands. Returns whether `end` was reached without commands.
  bool wait_for_command(Clock::time_point end) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_until(lock, end, [this] { return !commands_.empty(); });
  }

  /// Waits until `end`, until there are commands, or until wake() has been called since the last wait.
  void wait_for_input(Clock::time_point end) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, end, [this] { return woken_ || !commands_.empty(); });
    woken_ = false;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Command> commands_;
  bool woken_ = false;
  bool closed_ = false;
};

}  // namespace bubblesim
