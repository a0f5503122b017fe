// SPDX-License-Identifier: BSD-3-Clause
// The ROS bridge as a system of a simulation.
#pragma once

#include "bubblesim/ros_bridge.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Delivers messages at the start of a step, all with the step's time stamp. Add it before the scripts that receive the
/// messages.
class RosSystem final : public System {
 public:
  /// The bridge and the simulation must outlive this object.
  RosSystem(RosBridge& bridge, const Simulation& simulation) : bridge_(bridge), simulation_(simulation) {}

  void process_input() override {
    bridge_.publish_clock(simulation_.time());
    bridge_.process_input();
  }

 private:
  RosBridge& bridge_;
  const Simulation& simulation_;
};

}  // namespace bubblesim
