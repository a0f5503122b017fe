// SPDX-License-Identifier: BSD-3-Clause
// A ROS bridge as a system of a simulation.
#pragma once

#include <utility>

#include "bubblesim/node_bridge.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Delivers messages at the start of a step, and publishes /clock after the physics, before the messages that are
/// stamped with that time. Add it before the systems that receive and publish messages.
class RosSystem final : public System {
 public:
  /// The bridge and the simulation must outlive this object.
  RosSystem(NodeBridge& bridge, const Simulation& simulation) : bridge_(bridge), simulation_(simulation) {}

  void process_input() override {
    if (!std::exchange(published_, false)) bridge_.publish_clock(simulation_.state_time());  // also during a pause
    bridge_.process_input();
  }
  void sense(const World&, double time) override {
    bridge_.publish_clock(time);
    published_ = true;
  }
  void reset() override { bridge_.publish_clock(simulation_.state_time()); }

 private:
  NodeBridge& bridge_;
  const Simulation& simulation_;
  bool published_ = false;  // since the last step
};

}  // namespace bubblesim
