// SPDX-License-Identifier: BSD-3-Clause
// The commands that threads give to the thread that runs a simulation.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace bubblesim {

struct Command {
  enum class Kind { kStart, kPause, kStop, kOther };
  Kind kind = Kind::kOther;
  /// Carries it out, calls `before_answer`, and answers.
  std::function<void(const std::function<void()>& before_answer)> run;
  /// Answers that it is not carried out.
  std::function<void(const std::exception_ptr&)> refuse;
};

/// Thread-safe, except Wait.
class Inbox {
 public:
  using Clock = std::chrono::steady_clock;
  enum class WaitFor { kCommands, kInput };

  /// Throws std::system_error.
  Inbox();
  ~Inbox();
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  /// Refuses the command if the inbox is closed.
  void put(Command command);
  void open();
  /// Refuses all commands from here on, also those that are there.
  void close();

  static std::exception_ptr has_ended();

  /// All commands so far, in order.
  std::vector<Command> take();
  bool empty() const;
  bool has(Command::Kind kind) const;

  /// Ends a wait for input.
  void wake();

  /// Readable when a Wait is over.
  int descriptor() const { return signal_; }

  /// During its lifetime, descriptor() signals commands, and wake() if the wait is for input; one that came since the
  /// last wait for input counts. There is one at a time.
  class Wait {
   public:
    Wait(Inbox& inbox, WaitFor what);
    ~Wait();
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;

    bool is_over() const;

   private:
    Inbox& inbox_;
    const bool for_input_;
  };

 private:
  void signal();

  mutable std::mutex mutex_;
  const int signal_;  // an eventfd
  std::vector<Command> commands_;
  bool woken_ = false;
  bool closed_ = false;
  bool waits_for_commands_ = false;
  bool waits_for_wake_ = false;
};

}  // namespace bubblesim
