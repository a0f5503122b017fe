// SPDX-License-Identifier: BSD-3-Clause
// The ROS bridge's place in a step.
#pragma once

#include "bubblesim/ros_bridge.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Messages come in first, all of them under the step's time. To be added before the scripts that are to hear them.
class RosSystem final : public System {
 public:
  /// Both must outlive it.
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
