// SPDX-License-Identifier: BSD-3-Clause
// What every joint kind has in common: axes with a motor, limits, friction, damping and a spring.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <vector>

#include "bubblesim/scene.hpp"
#include "physics/joints/motor.hpp"
#include "physics/ode_handles.hpp"

namespace bubblesim {

/// Where a joint is made: the bodies that it connects, a null one is the world, and its frame in the world.
struct JointSite {
  Pose pose;
  dBodyID parent = nullptr;
  dBodyID child = nullptr;
  /// Of a gearbox: the body that its shafts turn in, and a point of the parent's and of the child's axis, in the world.
  dBodyID reference = nullptr;
  Vector3 parent_shaft;
  Vector3 child_shaft;
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

  /// ODE's joint with the motor of an axis; null when it has none.
  dJointID motor_joint(int axis) const;

  /// Lets an axis that has a MimicDescription follow another joint, which must live as long as this one.
  void mimic(int axis, const Joint& leader);

  /// Sets ODE's motors for the next substep of `step` seconds.
  void drive(double step);

 protected:
  enum class Motion { kTurns, kSlides };
  /// To be called for each axis in its order, once the ODE joint exists. `rows` are those that the joint has for it.
  void add_rows(dWorldID world, Motor rows, Motion motion, const AxisLine& line);
  void set_stops(int axis, double lower, double upper) const;
  /// Called before each substep.
  virtual void follow(double step);

 private:
  struct Axis {
    AxisDescription description;
    double target_position = 0;
    double target_velocity = 0;
    const Joint* leader = nullptr;
    // ODE serves the stop and the motor of an axis by one constraint: a motor that pushes on a stop becomes a plain
    // force, infinite when it has no limit. An axis with limits therefore leaves the motor of its rows alone.
    std::optional<Motor> rows;
    std::optional<Motor> own_motor, own_friction, own_damper;
    const Motor* motor = nullptr;     // into the above; null in a gearbox
    const Motor* friction = nullptr;  // null when there is none
    const Motor* damper = nullptr;
  };
  void apply_motor(Axis& axis);
  void drive_motor(int index, double step);
  void drive_spring(int index, double step);

  std::vector<Axis> axes_;
  std::vector<int> driven_;  // axes whose motor is set anew in each substep
  std::vector<int> sprung_;
};

/// The unit direction of an axis in the world, at the joint's site.
Vector3 axis_direction(const JointDescription& description, int axis, const JointSite& site);

/// Makes the joint in ODE. Throws InvalidInput for a type that is not known.
std::unique_ptr<Joint> make_joint(dWorldID world, const JointDescription& description, const JointSite& site);

/// The kinds that make_joint() knows, and how many axes each takes.
struct JointKind {
  const char* type;
  int axes;
  std::unique_ptr<Joint> (*make)(dWorldID, const JointDescription&, const JointSite&);
};
const std::vector<JointKind>& joint_kinds();

}  // namespace bubblesim
