// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <utility>

namespace bubblesim {

/// Runs callbacks so that what they throw does not unwind through roscpp, and hands out the first of it later.
class CallbackGuard {
 public:
  template <class Function>
  void run(Function&& function) {
    try {
      std::forward<Function>(function)();
    } catch (...) {
      if (!first_) first_ = std::current_exception();
    }
  }
  void rethrow() {
    if (first_) std::rethrow_exception(std::exchange(first_, nullptr));
  }

 private:
  std::exception_ptr first_;
};

}  // namespace bubblesim
