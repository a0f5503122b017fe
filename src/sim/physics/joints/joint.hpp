// SPDX-License-Identifier: BSD-3-Clause
// Common parts of all joint kinds: axes with a motor, limits, friction, damping and a spring.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/state_archive.hpp"
#include "physics/joints/motor.hpp"
#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

/// Where a joint is created: the bodies that it connects (null: the world) and its frame in the world.
struct JointSite {
  Pose pose;
  dBodyID parent = nullptr;
  dBodyID child = nullptr;
  /// Of a gearbox: the reference body of its shafts, and a point of the parent's and of the child's axis, in the world.
  dBodyID reference = nullptr;
  Vector3 parent_shaft;
  Vector3 child_shaft;
};

/// What acts along an axis in a substep, beside its stops; null: nothing. Valid while the joint lives.
struct AxisForces {
  const MotorForce* motor = nullptr;
  const MotorForce* friction = nullptr;
  const MotorForce* damper = nullptr;
};

/// Shafts of a gearbox: the child turns by -ratio times the angle of the parent, both in the reference body.
struct ShaftCoupling {
  Vector3 parent_axis;  ///< unit vectors in the world
  Vector3 child_axis;
  double ratio = 1;
};

class Joint {
 public:
  explicit Joint(std::vector<AxisDescription> axes);
  virtual ~Joint() = default;
  Joint(const Joint&) = delete;
  Joint& operator=(const Joint&) = delete;

  int axis_count() const { return static_cast<int>(axes_.size()); }
  const AxisDescription& axis(int index) const { return axes_[static_cast<std::size_t>(index)].description; }

  /// Radians or metres, relative to the pose in which the joint was created; of the child relative to the parent.
  virtual double position(int axis) const = 0;
  virtual double velocity(int axis) const = 0;

  double target_position(int axis) const { return axes_[static_cast<std::size_t>(axis)].target_position; }
  double target_velocity(int axis) const { return axes_[static_cast<std::size_t>(axis)].target_velocity; }
  double target_effort(int axis) const { return axes_[static_cast<std::size_t>(axis)].target_effort; }
  double motor_gain(int axis) const { return axes_[static_cast<std::size_t>(axis)].gain; }
  /// Whether the axis has a motor and a command for it.
  bool is_driven(int axis) const {
    const Axis& asked = axes_[static_cast<std::size_t>(axis)];
    return asked.motor != nullptr && (asked.description.motor != MotorMode::kNone || asked.description.mimic);
  }
  void set_motor_mode(int axis, MotorMode mode);
  void set_target_position(int axis, double position);
  void set_target_velocity(int axis, double velocity);
  void set_target_effort(int axis, double effort);
  void set_max_force(int axis, double force);
  void set_motor_gain(int axis, double gain);

  /// ODE's joint with the motor of an axis; null when it has none.
  dJointID motor_joint(int axis) const;

  /// Makes an axis with a MimicDescription follow another joint, which must live as long as this one.
  void mimic(int axis, const Joint& leader);

  /// Sets ODE's motors for the next substep of `step` seconds.
  void drive(double step);
  /// The position of an axis with limits when drive() was called: position() computes it each time.
  double position_when_driven(int axis) const { return axes_[static_cast<std::size_t>(axis)].here; }

  /// What drive() has set for an axis.
  AxisForces forces(int axis) const {
    const Axis& asked = axes_[static_cast<std::size_t>(axis)];
    AxisForces made;
    if (asked.motor != nullptr) made.motor = &asked.motor->force();
    if (asked.friction != nullptr) made.friction = &asked.friction->force();
    if (asked.damper != nullptr) made.damper = &asked.damper->force();
    return made;
  }

  /// Of a gearbox; other joints have none.
  virtual std::optional<ShaftCoupling> coupling() const { return std::nullopt; }

  /// Puts the joint elsewhere between its bodies: its frame in the world, while their poses are those of position 0. Of
  /// fixed joints and hinges; others do nothing.
  virtual void place(const Pose& frame);

  /// Saves or restores commands, and what the joint remembers of the last substep.
  void transfer(StateArchive& archive);

 protected:
  enum class Motion { kTurns, kSlides };
  /// Call for each axis in order, after the ODE joint is created. `rows` are the joint's rows of the axis.
  void add_rows(dWorldID world, Motor rows, Motion motion, const AxisLine& line);
  /// Call when the axis of a joint has got another direction, in the world.
  void turn_motors(const Vector3& direction);
  /// Shifts the limits for ODE, which measures a position that is less by `shift`.
  void shift_limits(int axis, double shift) { axes_[static_cast<std::size_t>(axis)].shift = shift; }
  /// Called before each substep.
  virtual void follow(double step);
  /// Saves or restores the state that a kind of joint has itself.
  virtual void transfer_own(StateArchive& archive);

 private:
  /// What the row of an axis's stop does in a substep.
  enum class Stop {
    kNone,
    kLower,  // it ends the motion at the limit
    kUpper,
    kBeyond  // the axis is beyond a limit and returns, as ODE has it
  };
  /// Where an axis is on its way from a stop to rows without one. It is not saved: without an effect on the motion.
  enum class Leaving { kNot, kBegins, kEnds };
  struct Axis {
    AxisDescription description;
    double target_position = 0;
    double target_velocity = 0;
    double target_effort = 0;
    double gain = 1;     // of the motor: factor of its targets, of position control of its speed
    double here = 0;     // position at the last drive(), of a measured axis
    bool turns = false;  // an angle, of which position() may drop full turns
    const Joint* leader = nullptr;
    double followed = 0;         // own position in the last substep, counting full turns; only with a leader
    double leader_followed = 0;  // the leader's, likewise
    // ODE handles the stop and the motor of an axis in one constraint: a motor that pushes against a stop becomes a
    // plain force, infinite without a limit. Therefore an axis with limits does not use the motor of its rows.
    std::optional<Motor> rows;
    double shift = 0;  // rad or m, of ODE's positions
    Stop stop = Stop::kNone;
    Leaving leaving = Leaving::kNot;
    std::optional<Motor> own_motor, own_friction, own_damper;
    Motor* motor = nullptr;     // points to one of the above; null in a gearbox
    Motor* friction = nullptr;  // null when there is none
    Motor* damper = nullptr;
  };
  void list_measured();
  void apply_motor(Axis& axis);
  void drive_motor(int index, double step);
  void follow_leader(int index, double step);
  void drive_spring(int index, double step);
  void set_stops(int index, double step);
  static void leave_stop(Axis& axis, double here);
  void restore_stop(Axis& axis);

  std::vector<Axis> axes_;
  std::vector<int> driven_;  // axes whose motor is set in each substep
  std::vector<int> sprung_;
  std::vector<int> stopped_;   // axes with a range
  std::vector<int> measured_;  // axes of which drive() needs the position, or that have limits
};

/// The unit direction of an axis in the world, at the joint's site.
Vector3 axis_direction(const JointDescription& description, int axis, const JointSite& site);

/// Creates the joint in ODE. Throws InvalidInput for an unknown type.
std::unique_ptr<Joint> make_joint(dWorldID world, const JointDescription& description, const JointSite& site);

}  // namespace bubblesim
