// SPDX-License-Identifier: BSD-3-Clause
// A joint in ODE, with the meters of its sensors and motors.
#pragma once

#include <memory>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene_tree.hpp"
#include "physics/joints/joint.hpp"
#include "physics/joints/motor_meter.hpp"
#include "physics/parts/wrench_meter.hpp"

namespace bubblesim {

/// Some joints can be put elsewhere, see has_loose_frame(): `in_parent` and `in_child` are part of the state then.
struct PlacedJoint {
  std::unique_ptr<Joint> joint;  // null in a static model
  ObjectId object = kNoObject;
  ObjectId parent = kNoObject;  // links; kNoObject is the world
  ObjectId child = kNoObject;
  Pose in_parent;
  Pose in_child;
  Pose built_in_parent;  // before it was put elsewhere
  Pose built_in_child;
  std::unique_ptr<WrenchMeter> meter;                     // null without a sensor
  std::vector<std::unique_ptr<MotorMeter>> motor_meters;  // by axis; null without a motor

  bool is_elsewhere() const { return in_parent != built_in_parent || in_child != built_in_child; }
};

}  // namespace bubblesim
