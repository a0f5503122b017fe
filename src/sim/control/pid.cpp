// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/pid.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim::control {

double Pid::command(double error, double rate, double period) {
  if (!(period > 0) || !std::isfinite(error) || !std::isfinite(rate)) return 0;
  integral_ += period * error;
  const auto [low, high] = std::minmax(gains_.i_min, gains_.i_max);
  if (gains_.antiwindup && gains_.i != 0) {
    const auto [least, most] = std::minmax({low / gains_.i, high / gains_.i});
    integral_ = std::clamp(integral_, least, most);
  }
  double integral_part = gains_.i * integral_;
  if (!gains_.antiwindup) integral_part = std::clamp(integral_part, low, high);
  return gains_.p * error + integral_part + gains_.d * rate;
}

double Pid::command(double error, double period) {
  const double rate = period > 0 ? (error - last_error_) / period : 0;
  last_error_ = error;
  return command(error, rate, period);
}

void Pid::reset() { integral_ = last_error_ = 0; }

void Pid::transfer(StateArchive& archive) { archive(integral_, last_error_); }

}  // namespace bubblesim::control
