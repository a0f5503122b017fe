// SPDX-License-Identifier: BSD-3-Clause
// The joints of a world: positions, motors and their targets.
#pragma once

#include <utility>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

class WorldJoints : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// `axis` is 0, or 1 for the second axis of a revolute2 joint. Radians or metres. Angles are between -pi and pi,
  /// unless the limits of the joint reach beyond; then full turns are counted.
  double position(ObjectId joint, int axis = 0) const;
  double velocity(ObjectId joint, int axis = 0) const;
  /// Force or torque of an axis's motor on the child, N along the axis or N m about it, mean over the last advance();
  /// 0 for an axis without a motor.
  double motor_effort(ObjectId joint, int axis = 0) const;
  /// The links that a joint connects, the parent first; kNoObject is the world.
  std::pair<ObjectId, ObjectId> links(ObjectId joint) const;
  /// Pose of the joint in the world, as attached to its child; World::pose() has that of its parent.
  Pose child_pose(ObjectId joint) const;
  /// Number of axes; 0 for a fixed or ball joint and for joints of a static model.
  int axes(ObjectId joint) const;
  double target_position(ObjectId joint, int axis = 0) const;
  double target_velocity(ObjectId joint, int axis = 0) const;
  double target_effort(ObjectId joint, int axis = 0) const;
  double max_force(ObjectId joint, int axis = 0) const;
  MotorMode motor_mode(ObjectId joint, int axis = 0) const;
  /// Sets the motor mode until the world is reset. The targets are kept. Throws WrongObject for a gearbox, which has no
  /// motor.
  void set_motor_mode(ObjectId joint, MotorMode mode, int axis = 0);
  /// Targets apply in the motor's mode: a position in a position-controlled joint, a velocity in a velocity-controlled
  /// one, and a force or torque on the child in an effort-controlled one, where the force limit applies and the
  /// velocity limit does not.
  void set_target_position(ObjectId joint, double position, int axis = 0);
  void set_target_velocity(ObjectId joint, double velocity, int axis = 0);
  void set_target_effort(ObjectId joint, double effort, int axis = 0);
  void set_max_force(ObjectId joint, double force, int axis = 0);
  /// Factor between a target and what the motor does, 1 at first and after a reset: of its velocity, its effort, and in
  /// position control the speed with which it approaches. Throws InvalidInput for numbers below 0 and above 1000.
  void set_motor_gain(ObjectId joint, double gain, int axis = 0);
  double motor_gain(ObjectId joint, int axis = 0) const;
  /// Moves the links below a revolute, continuous or prismatic joint so that the joint has this position; the joint
  /// velocity is kept. Throws InvalidInput for other joint types and for a joint in a closed chain of links.
  void set_position(ObjectId joint, double position);
  /// Whether it is a joint without physics, a frame: setting its position, or its targets, moves what is below it in
  /// the tree at once. It has no motor: its mode is kNone, its forces are 0.
  bool is_kinematic(ObjectId joint) const;
  /// The joint's description in the scene.
  const JointDescription& description(ObjectId joint) const;
};

}  // namespace bubblesim
