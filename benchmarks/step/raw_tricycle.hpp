// SPDX-License-Identifier: BSD-3-Clause
// The scene `tricycle` by hand on ODE, with nothing around it: the limit that a simulator on ODE can reach.
#pragma once

#include <memory>

namespace bubblesim::benchmarks {

class RawTricycle {
 public:
  RawTricycle();
  ~RawTricycle();
  /// One step of 10 substeps of 5 ms.
  void step();
  void drive(double steering, double speed);
  double x() const;
  double y() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bubblesim::benchmarks
