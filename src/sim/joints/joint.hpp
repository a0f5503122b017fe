// SPDX-License-Identifier: BSD-3-Clause
// What every joint kind has in common: axes with a motor, limits, friction and damping.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "bubblesim/scene.hpp"
#include "ode_handles.hpp"

namespace bubblesim {

/// The two bodies that a joint connects; a null body is the world.
struct JointBodies {
  dBodyID parent = nullptr;
  dBodyID child = nullptr;
};

class Joint {
 public:
  explicit Joint(std::vector<AxisDescription> axes);
  virtual ~Joint() = default;
  Joint(const Joint&) = delete;
  Joint& operator=(const Joint&) = delete;

  int axis_count() const { return static_cast<int>(axes_.size()); }
  const AxisDescription& axis(int index) const { return axes_[static_cast<std::size_t>(index)].description; }

  /// Radians or metres, counted from the pose in which the joint was made; the child moves relative to the parent.
  virtual double position(int axis) const = 0;
  virtual double velocity(int axis) const = 0;

  double target_position(int axis) const { return axes_[static_cast<std::size_t>(axis)].target_position; }
  double target_velocity(int axis) const { return axes_[static_cast<std::size_t>(axis)].target_velocity; }
  void set_motor_mode(int axis, MotorMode mode);
  void set_target_position(int axis, double position);
  void set_target_velocity(int axis, double velocity);
  void set_max_force(int axis, double force);

  /// Sets ODE's motors for the next substep of `step` seconds.
  void drive(double step);

 protected:
  /// Hands limits, friction and damping to ODE; to be called once the ODE joint exists.
  void apply_axes();
  /// Sets one of ODE's parameters (dParam...) of axis 0 or 1, without the group offset: a stop, or one of its motor.
  virtual void set_stop(int axis, int parameter, double value) = 0;
  virtual void set_motor(int axis, int parameter, double value) = 0;
  /// Called before each substep.
  virtual void follow() {}

 private:
  struct Axis {
    AxisDescription description;
    double target_position = 0;
    double target_velocity = 0;
  };
  void apply_motor(int index);
  void drive_axis(int index, double step);

  std::vector<Axis> axes_;
  std::vector<int> busy_;  // axes whose motor is set anew in each substep
};

/// ODE serves the stop and the motor of an axis by one constraint: a motor that pushes on a stop becomes a plain force,
/// infinite when it has no limit. An axis with limits therefore has its motor in a joint of its own; these make it, for
/// the motion of the first body relative to the second. They return null for an axis without limits.
ode::JointHandle separate_turning_motor(dWorldID world, const AxisDescription& axis, const Vector3& direction,
                                        dBodyID first, dBodyID second);
ode::JointHandle separate_sliding_motor(dWorldID world, const AxisDescription& axis, const Vector3& direction,
                                        dBodyID first, dBodyID second);

/// Makes the joint in ODE. `pose` is the joint's frame in the world. Throws InvalidInput for a type that is not known.
std::unique_ptr<Joint> make_joint(dWorldID world, const JointDescription& description, const Pose& pose,
                                  JointBodies bodies);

/// The kinds that make_joint() knows, and how many axes each takes.
struct JointKind {
  const char* type;
  int axes;
  std::unique_ptr<Joint> (*make)(dWorldID, const JointDescription&, const Pose&, JointBodies);
};
const std::vector<JointKind>& joint_kinds();

}  // namespace bubblesim
