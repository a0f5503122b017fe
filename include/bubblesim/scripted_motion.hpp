// SPDX-License-Identifier: BSD-3-Clause
// Moves a static model along the trajectories of its description, such as a person who walks.
#pragma once

#include "bubblesim/device.hpp"

namespace bubblesim {

/// At the end of each substep the model is where its script has it at that simulation time: it hinders others like
/// anything static, and nothing hinders it. Its trajectories follow each other; with `loop`, the script begins anew
/// after each cycle, behind its delay. Without, the model stays where it ends. Between two waypoints, the position is a
/// cubic Hermite spline of the part of the time that has passed, whose tangent at a waypoint is (1 - tension) / 2 times
/// the difference of its neighbours, as Gazebo's; a trajectory that ends where it begins is closed. The orientation
/// turns the shorter way at a constant rate. Add it to a world without a rate.
class ScriptedMotion final : public Device {
 public:
  /// A static model whose description has a script with a waypoint. Throws WrongObject for others.
  ScriptedMotion(const World& world, ObjectId model);

  /// Where a script has its model at a time in s.
  static Pose pose_at(const MotionScript& script, double time);

  void update(World& world, double time, double duration) override;

 private:
  ObjectId model_;
};

}  // namespace bubblesim
