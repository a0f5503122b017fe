// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "bubblesim/messages/message_type.hpp"
#include "dds/participant.hpp"
#include "run_diagnosis.hpp"
#include "traffic_diagnosis.hpp"

namespace bubblesim::ros2 {

/// Publishes the state of the simulation and of the node's topics on /diagnostics once a second, on a thread of its
/// own: also while a script does not return. Stamps are wall time.
class Diagnostics {
 public:
  /// `type`: diagnostic_msgs/DiagnosticArray; `node`: the name without a slash.
  Diagnostics(Participant& participant, const messages::MessageType& type, std::string node,
              std::function<RunReport()> take_report, std::function<TrafficReport()> take_traffic);
  ~Diagnostics();
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  /// At once. Thread-safe.
  void publish();

 private:
  void publish_each_second();

  const std::string node_;
  const std::function<RunReport()> take_report_;
  const std::function<TrafficReport()> take_traffic_;
  Writer writer_;
  std::mutex publishing_;  // guards diagnosis_
  RunDiagnosis diagnosis_;
  std::mutex mutex_;  // guards ending_
  std::condition_variable end_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace bubblesim::ros2
