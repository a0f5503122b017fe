// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "bubblesim/run_report.hpp"
#include "run_diagnosis.hpp"
#include "status/topic_traffic.hpp"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
class Updater;
}  // namespace diagnostic_updater

namespace bubblesim {

/// Publishes the state of the simulation and of the node's topics on /diagnostics, once a second. Used by the master
/// thread only.
class Diagnostics {
 public:
  explicit Diagnostics(std::function<RunReport()> take_report);
  ~Diagnostics();

  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  /// Call it regularly while roscpp is started and there is a master.
  void publish_when_due();
  void publish();

 private:
  using Clock = std::chrono::steady_clock;
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  const std::function<RunReport()> take_report_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;  // made late: its constructor calls the master
  TopicTraffic traffic_;
  RunDiagnosis diagnosis_;
  Clock::time_point next_{};
};

}  // namespace bubblesim
