// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <utility>

namespace bubblesim {

/// Runs callbacks so that their exceptions do not unwind through the middleware, and rethrows the first one later.
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
