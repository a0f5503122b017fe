// SPDX-License-Identifier: BSD-3-Clause
// The scene `tricycle` implemented directly with ODE: the upper limit for a simulator based on ODE.
#pragma once

#include <memory>

namespace bubblesim::benchmarks {

class RawTricycle {
 public:
  RawTricycle();
  ~RawTricycle();
  /// One simulation step: 10 physics substeps of 5 ms.
  void step();
  void drive(double steering, double speed);
  double x() const;
  double y() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bubblesim::benchmarks
