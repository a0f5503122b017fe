// SPDX-License-Identifier: BSD-3-Clause
// A PID controller with a limited integral, as control_toolbox has.
#pragma once

#include "bubblesim/state_archive.hpp"

namespace bubblesim::control {

struct PidGains {
  double p = 0;
  double i = 0;
  double d = 0;
  double i_max = 0;  ///< limits of the integral's part of the command
  double i_min = 0;
  bool antiwindup = false;  ///< the integral itself is limited, not only its part of the command
};

class Pid {
 public:
  explicit Pid(const PidGains& gains) : gains_(gains) {}

  const PidGains& gains() const { return gains_; }
  /// `rate`: of the error per s. Zero when an input is not finite or `period` is not above 0.
  double command(double error, double rate, double period);
  /// The rate is that since the last call.
  double command(double error, double period);
  void reset();
  void transfer(StateArchive& archive);

 private:
  PidGains gains_;
  double integral_ = 0;
  double last_error_ = 0;
};

}  // namespace bubblesim::control
