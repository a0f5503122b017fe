// SPDX-License-Identifier: BSD-3-Clause
#include "status/diagnostics.hpp"

#include <diagnostic_updater/diagnostic_updater.h>

#include <string>
#include <utility>

namespace bubblesim {
namespace {

constexpr std::chrono::seconds kPeriod{1};

void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const Diagnosis& found) {
  status.summary(static_cast<unsigned char>(found.level), found.message);
  for (const auto& [name, value] : found.values) status.add(name, value);
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
    updater_->add("Simulation", [this](Status& status) { fill(status, diagnosis_.judge(take_report_())); });
    updater_->add("Topics", [this](Status& status) { fill(status, judge(traffic_.take_report())); });
  }
  updater_->force_update();
}

}  // namespace bubblesim
