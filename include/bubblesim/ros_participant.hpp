// SPDX-License-Identifier: BSD-3-Clause
// The ROS bridge's place in a pass.
#pragma once

#include "bubblesim/ros_bridge.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Messages come in first, all of them under the pass's time. To be added before the scripts that are to hear them.
class RosParticipant final : public Participant {
 public:
  /// Both must outlive it.
  RosParticipant(RosBridge& bridge, const Simulation& simulation) : bridge_(bridge), simulation_(simulation) {}

  void drain() override {
    bridge_.publish_clock(simulation_.time());
    bridge_.drain();
  }

 private:
  RosBridge& bridge_;
  const Simulation& simulation_;
};

}  // namespace bubblesim
