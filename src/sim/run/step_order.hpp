// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "bubblesim/runner.hpp"

namespace bubblesim {

/// A request for steps of a paused simulation. On the runner's thread only.
class StepOrder {
 public:
  using Clock = std::chrono::steady_clock;
  using Answer = std::shared_ptr<std::promise<double>>;

  /// Whether steps are left.
  explicit operator bool() const { return answer_ != nullptr; }

  void begin(std::uint64_t steps, Answer answer) {
    left_ = steps;
    done_ = 0;
    answer_ = std::move(answer);
    since_ = Clock::now();
  }
  void step_done(double time) {
    ++done_;
    since_ = Clock::now();
    if (--left_ == 0) std::exchange(answer_, nullptr)->set_value(time);
  }
  /// Whether the next step has waited for so long.
  bool has_waited(Clock::duration time) const { return answer_ && Clock::now() - since_ > time; }

  void fail(const std::string& why) {
    if (answer_) std::exchange(answer_, nullptr)->set_exception(std::make_exception_ptr(NotCarriedOut(why)));
  }
  void interrupt() {
    fail("interrupted after " + std::to_string(done_) + " steps by a request to start, pause or stop");
  }

 private:
  std::uint64_t left_ = 0;
  std::uint64_t done_ = 0;
  Answer answer_;
  Clock::time_point since_;  // the last step, or the begin
};

}  // namespace bubblesim
