// SPDX-License-Identifier: BSD-3-Clause
#include "status/diagnostics.hpp"

#include <diagnostic_updater/diagnostic_updater.h>

#include <string>
#include <utility>

namespace bubblesim {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

constexpr std::chrono::seconds kPeriod{1};

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
  const Diagnosis found = diagnosis_.judge(take_report_());
  status.summary(static_cast<unsigned char>(found.level), found.message);
  for (const auto& [name, value] : found.values) status.add(name, value);
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
