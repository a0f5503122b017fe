// SPDX-License-Identifier: BSD-3-Clause
#include "run_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace bubblesim {
namespace {

constexpr double kSlow = 0.9;      // share of the requested speed
constexpr double kStanding = 2.0;  // s without a completed step that count as a stall

std::string formatted(const char* format, double number) {
  char text[32];
  std::snprintf(text, sizeof(text), format, number);
  return text;
}

std::string two_digits(double number) { return formatted("%.2f", number); }
std::string six_digits(double number) { return formatted("%g", number); }

/// Of the steps in the report; NaN if there are none.
double real_time_factor(const RunReport& report) {
  return report.wall_time > 0 ? report.simulated_time / report.wall_time : std::nan("");
}

}  // namespace

Diagnosis RunDiagnosis::judge(const RunReport& report) {
  const double factor = real_time_factor(report);
  const bool paced = std::isfinite(report.wanted_speed);
  const int new_errors = report.script_errors - std::exchange(script_errors_, report.script_errors);
  Diagnosis found;
  found.message = std::isnan(factor) ? report.state : report.state + " at real-time factor " + two_digits(factor);
  if (paced && factor < kSlow * report.wanted_speed) {
    found.merge(Diagnosis::kWarn,
                "real-time factor " + two_digits(factor) + ", wanted " + two_digits(report.wanted_speed));
  }
  if (report.since_last_step > kStanding) {
    found.merge(Diagnosis::kWarn, "no step has completed for " + two_digits(report.since_last_step) + " s");
  }
  if (report.disabled_scripts > 0) {
    found.merge(Diagnosis::kError, "child scripts disabled after an error: " + std::to_string(report.disabled_scripts));
  } else if (new_errors > 0) {
    found.merge(Diagnosis::kWarn, "errors of child scripts: " + std::to_string(new_errors));
  }
  if (!report.failure.empty()) found.merge(Diagnosis::kError, report.failure);
  const double steps = std::max(1.0, static_cast<double>(report.steps));
  found.values = {
      {"State", report.state},
      {"Simulation time (s)", six_digits(report.simulation_time)},
      {"Real-time factor", std::isnan(factor) ? "" : two_digits(factor)},
      {"Wanted real-time factor", paced ? two_digits(report.wanted_speed) : "max"},
      {"Steps", std::to_string(report.steps)},
      {"Step time, mean (ms)", six_digits(1e3 * report.step_time / steps)},
      {"Step time, longest (ms)", six_digits(1e3 * report.longest_step)},
      {"Script errors", std::to_string(report.script_errors)},
      {"Measurements of sensors", std::to_string(report.measurements)},
  };
  return found;
}

}  // namespace bubblesim
