// SPDX-License-Identifier: BSD-3-Clause
#include "status/diagnostics.hpp"

#include <diagnostic_updater/diagnostic_updater.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace bubblesim {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

constexpr std::chrono::seconds kPeriod{1};
constexpr double kSlow = 0.9;      // share of the requested speed
constexpr double kStanding = 2.0;  // s without a completed step that count as a stall

std::string two_digits(double number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", number);
  return text;
}

/// Of the steps in the report; NaN if there are none.
double real_time_factor(const RunReport& report) {
  return report.wall_time > 0 ? report.simulated_time / report.wall_time : std::nan("");
}

}  // namespace

Diagnostics::Diagnostics(std::function<RunReport()> take_report) : take_report_(std::move(take_report)) {}

Diagnostics::~Diagnostics() = default;

void Diagnostics::publish_when_due() {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now - next_ < kPeriod ? next_ + kPeriod : now + kPeriod;  // at the fixed period, unless it is far behind
  publish();
}

void Diagnostics::publish() {
  if (!updater_) {
    updater_ = std::make_unique<diagnostic_updater::Updater>();
    updater_->setHardwareID("bubblesim");
    updater_->add("Simulation", [this](Status& status) { report_simulation(status); });
    updater_->add("Topics", [this](Status& status) { report_topics(status); });
  }
  updater_->force_update();
}

void Diagnostics::report_simulation(Status& status) {
  const RunReport report = take_report_();
  const double factor = real_time_factor(report);
  const bool paced = std::isfinite(report.wanted_speed);
  const int new_errors = report.script_errors - std::exchange(script_errors_, report.script_errors);
  status.summary(Level::OK,
                 std::isnan(factor) ? report.state : report.state + " at real-time factor " + two_digits(factor));
  if (paced && factor < kSlow * report.wanted_speed) {
    status.mergeSummary(Level::WARN,
                        "real-time factor " + two_digits(factor) + ", wanted " + two_digits(report.wanted_speed));
  }
  if (report.since_last_step > kStanding) {
    status.mergeSummary(Level::WARN, "no step has completed for " + two_digits(report.since_last_step) + " s");
  }
  if (report.disabled_scripts > 0) {
    status.mergeSummary(Level::ERROR,
                        "child scripts disabled after an error: " + std::to_string(report.disabled_scripts));
  } else if (new_errors > 0) {
    status.mergeSummary(Level::WARN, "errors of child scripts: " + std::to_string(new_errors));
  }
  if (!report.failure.empty()) status.mergeSummary(Level::ERROR, report.failure);
  status.add("State", report.state);
  status.add("Simulation time (s)", report.simulation_time);
  status.add("Real-time factor", std::isnan(factor) ? "" : two_digits(factor));
  status.add("Wanted real-time factor", paced ? two_digits(report.wanted_speed) : "max");
  status.add("Steps", report.steps);
  status.add("Step time, mean (ms)",
             report.steps == 0 ? 0.0 : 1e3 * report.step_time / static_cast<double>(report.steps));
  status.add("Step time, longest (ms)", 1e3 * report.longest_step);
  status.add("Script errors", report.script_errors);
  status.add("Measurements of sensors", report.measurements);
}

void Diagnostics::report_topics(Status& status) {
  traffic_.count();
  status.summary(Level::OK, "nothing dropped");
  for (const auto& [topic, count] : traffic_.just_dropped()) {
    status.mergeSummary(Level::WARN,
                        topic + ": " + std::to_string(count) + " messages dropped, the subscriber's queue is full");
  }
  status.add("Messages sent", traffic_.sent().messages);
  status.add("Bytes sent", traffic_.sent().bytes);
  status.add("Messages received", traffic_.received().messages);
  status.add("Bytes received", traffic_.received().bytes);
  status.add("Messages dropped", traffic_.dropped());
}

}  // namespace bubblesim
