// SPDX-License-Identifier: BSD-3-Clause
#include "physics/joints/joint.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/ode/constraint_defaults.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

/// rad/s^2 or m/s^2. A stop takes part in a substep if the axis can reach it with this acceleration or twice its speed.
constexpr double kReachOfStop = 1000;

/// The rotation from `from` to `to` of at most half a turn.
double shortest_turn(double from, double to) { return std::remainder(to - from, 2 * M_PI); }

/// The angle that equals `position` but for full turns, next to the angle `before`.
double counted(double position, double before) { return before + shortest_turn(before, position); }

bool has_limits(const AxisDescription& axis) { return std::isfinite(axis.lower) || std::isfinite(axis.upper); }

bool needs_driving(const AxisDescription& axis) {
  return axis.motor == MotorMode::kPosition || axis.mimic || (axis.motor == MotorMode::kVelocity && has_limits(axis));
}

void set_range(const Motor& rows, double lower, double upper) {
  rows.set(dParamLoStop, std::max(lower, -dInfinity));
  rows.set(dParamHiStop, std::min(upper, dInfinity));
}

double target_speed(const AxisDescription& axis, double target) {
  return std::clamp(target, -axis.max_velocity, axis.max_velocity);
}

}  // namespace

Joint::Joint(std::vector<AxisDescription> axes) {
  for (AxisDescription& description : axes) {
    if (needs_driving(description)) driven_.push_back(static_cast<int>(axes_.size()));
    if (description.spring_stiffness > 0) sprung_.push_back(static_cast<int>(axes_.size()));
    if (has_limits(description) && description.lower < description.upper) {
      stopped_.push_back(static_cast<int>(axes_.size()));
    }
    Axis& axis = axes_.emplace_back();
    if (description.motor == MotorMode::kPosition || description.by_callback) axis.target_position = description.target;
    if (description.motor == MotorMode::kVelocity) axis.target_velocity = description.target;
    if (description.motor == MotorMode::kEffort) axis.target_effort = description.target;
    axis.description = std::move(description);
  }
  list_measured();
}

void Joint::list_measured() {
  measured_.clear();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const AxisDescription& axis = axes_[i].description;
    if (has_limits(axis) || axis.spring_stiffness > 0 || needs_driving(axis)) measured_.push_back(static_cast<int>(i));
  }
}

void Joint::follow(double) {}

void Joint::place(const Pose&) {}

void Joint::turn_motors(const Vector3& direction) {
  for (const Axis& axis : axes_) {
    for (const std::optional<Motor>* motor : {&axis.own_motor, &axis.own_friction, &axis.own_damper}) {
      if (*motor) (*motor)->turn(direction);
    }
  }
}

void Joint::add_rows(dWorldID world, Motor rows, Motion motion, const AxisLine& line) {
  std::size_t index = 0;
  while (axes_[index].rows) ++index;
  Axis& axis = axes_[index];
  const AxisDescription& description = axis.description;
  axis.rows = std::move(rows);
  axis.turns = motion == Motion::kTurns;
  axis.rows->set(dParamStopERP, kErrorReduction);
  if (description.lower == description.upper) set_range(*axis.rows, description.lower, description.upper);

  Motor* free_rows = has_limits(description) ? nullptr : &*axis.rows;
  const auto take = [&](std::optional<Motor>& own) -> Motor* {
    if (free_rows != nullptr) return std::exchange(free_rows, nullptr);
    own = motion == Motion::kTurns ? Motor::turning(world, line) : Motor::sliding(world, line);
    return &*own;
  };
  axis.motor = take(axis.own_motor);  // also without a command; it costs nothing then
  if (description.friction > 0) {
    // A motor with velocity 0 and a force limit.
    axis.friction = take(axis.own_friction);
    axis.friction->hold(0, description.friction);
  }
  if (description.damping > 0 || description.spring_stiffness > 0) {
    axis.damper = take(axis.own_damper);
    if (description.damping > 0) axis.damper->damp(0, description.damping);
  }
  apply_motor(axis);
}

void Joint::apply_motor(Axis& axis) {
  if (axis.motor == nullptr) return;
  const AxisDescription& description = axis.description;
  if (description.motor == MotorMode::kEffort && !description.mimic) {
    // A motor that cannot reach its speed exerts its limit.
    const double wanted = axis.gain * axis.target_effort;
    axis.motor->hold(std::copysign(kMaxSpeed, wanted), std::min(std::abs(wanted), description.max_force));
    return;
  }
  const bool driven = description.motor != MotorMode::kNone || description.mimic;
  const bool by_velocity = description.motor == MotorMode::kVelocity && !description.mimic;
  axis.motor->hold(by_velocity ? target_speed(description, axis.gain * axis.target_velocity) : 0,
                   driven ? description.max_force : 0);
}

void Joint::set_motor_mode(int axis, MotorMode mode) {
  Axis& set = axes_[static_cast<std::size_t>(axis)];
  set.description.motor = mode;
  driven_.erase(std::remove(driven_.begin(), driven_.end(), axis), driven_.end());
  if (set.motor != nullptr && needs_driving(set.description)) driven_.push_back(axis);
  list_measured();
  apply_motor(set);
}

void Joint::set_target_position(int axis, double position) {
  axes_[static_cast<std::size_t>(axis)].target_position = position;
}

void Joint::set_target_velocity(int axis, double velocity) {
  Axis& set = axes_[static_cast<std::size_t>(axis)];
  set.target_velocity = velocity;
  apply_motor(set);
}

void Joint::set_target_effort(int axis, double effort) {
  Axis& set = axes_[static_cast<std::size_t>(axis)];
  set.target_effort = effort;
  apply_motor(set);
}

void Joint::set_max_force(int axis, double force) {
  Axis& set = axes_[static_cast<std::size_t>(axis)];
  set.description.max_force = force;
  apply_motor(set);
}

void Joint::set_motor_gain(int axis, double gain) {
  Axis& set = axes_[static_cast<std::size_t>(axis)];
  set.gain = gain;
  apply_motor(set);
}

dJointID Joint::motor_joint(int axis) const {
  const Motor* motor = axes_[static_cast<std::size_t>(axis)].motor;
  return motor == nullptr ? nullptr : motor->joint();
}

void Joint::mimic(int axis, const Joint& leader) { axes_[static_cast<std::size_t>(axis)].leader = &leader; }

void Joint::drive(double step) {
  follow(step);
  for (const int index : measured_) axes_[static_cast<std::size_t>(index)].here = position(index);
  for (const int index : driven_) drive_motor(index, step);
  for (const int index : sprung_) drive_spring(index, step);
  for (const int index : stopped_) set_stops(index, step);
}

void Joint::drive_motor(int index, double step) {
  const Axis& axis = axes_[static_cast<std::size_t>(index)];
  const AxisDescription& description = axis.description;
  if (axis.leader != nullptr) return follow_leader(index, step);
  const double here = axis.here;
  if (description.motor == MotorMode::kVelocity) {
    // Stop at the limit: a motor and a stop with unlimited forces would settle somewhere behind it.
    const double speed = target_speed(description, axis.gain * axis.target_velocity);
    const double room = speed > 0 ? description.upper - here : here - description.lower;
    axis.motor->aim(std::copysign(std::min(std::abs(speed), std::max(room, 0.0) / step), speed));
    return;
  }
  const double gap = has_limits(description)
                         ? std::clamp(axis.target_position, description.lower, description.upper) - here
                         : shortest_turn(here, axis.target_position);
  const double time = 1 / (axis.gain * description.position_gain);
  axis.motor->aim(target_speed(description, gap / std::max(time, step)));
}

void Joint::follow_leader(int index, double step) {
  Axis& axis = axes_[static_cast<std::size_t>(index)];
  const AxisDescription& description = axis.description;
  const MimicDescription& mimic = *description.mimic;
  // Angles are from -pi to pi: where the leader passes half a turn, the follower must not turn back.
  const bool leader_turns = axis.leader->axes_[static_cast<std::size_t>(mimic.axis)].turns;
  const double here = axis.here;
  const double there = axis.leader->position(mimic.axis);
  axis.followed = axis.turns ? counted(here, axis.followed) : here;
  axis.leader_followed = leader_turns ? counted(there, axis.leader_followed) : there;
  const double wanted = mimic.multiplier * (axis.leader_followed - mimic.reference) + mimic.offset;
  const double reachable = std::clamp(wanted, description.lower, description.upper);
  const double along = reachable == wanted ? mimic.multiplier * axis.leader->velocity(mimic.axis) : 0;
  const double speed = along + kErrorReduction * (reachable - axis.followed) / step;
  axis.motor->aim(target_speed(description, speed));
}

void Joint::drive_spring(int index, double step) {
  const Axis& axis = axes_[static_cast<std::size_t>(index)];
  const AxisDescription& description = axis.description;
  // The spring's force at the end of the step, k (reference - x - h v), equals damping towards a velocity: stable for
  // any k.
  const double coefficient = description.damping + step * description.spring_stiffness;
  const double force = description.spring_stiffness * (description.spring_reference - axis.here);
  axis.damper->damp(force / coefficient, coefficient);
}

void Joint::set_stops(int index, double step) {
  Axis& axis = axes_[static_cast<std::size_t>(index)];
  const double here = axis.here - axis.shift;
  const double lower = axis.description.lower - axis.shift;
  const double upper = axis.description.upper - axis.shift;
  if (here < lower || here > upper) {
    if (std::exchange(axis.stop, Stop::kBeyond) != Stop::kBeyond) axis.rows->set(dParamStopERP, kErrorReduction);
    set_range(*axis.rows, lower, upper);
    return;
  }
  // ODE's stop acts when the axis is beyond it; its error correction would then throw the axis back. In the substep
  // that would pass the limit, the stop must hold v >= (lower - x) / h instead, with which the axis lands on the limit.
  // ODE holds v >= -ERP (x - stop) / h if x <= stop: that is the same for ERP = -1 and the limit mirrored at x.
  const double speed = velocity(index);
  const double reach = kReachOfStop * step * step;
  const double to_lower = here - lower - reach - 2 * step * std::max(-speed, 0.0);
  const double to_upper = upper - here - reach - 2 * step * std::max(speed, 0.0);
  const Stop stop = std::min(to_lower, to_upper) > 0 ? Stop::kNone : to_lower < to_upper ? Stop::kLower : Stop::kUpper;
  if (stop == Stop::kNone) {
    leave_stop(axis, here);
    return;
  }
  if (axis.stop == Stop::kNone || axis.stop == Stop::kBeyond) axis.rows->set(dParamStopERP, -1);
  axis.stop = stop;
  axis.leaving = Leaving::kNot;
  set_range(*axis.rows, stop == Stop::kLower ? 2 * here - lower : -dInfinity,
            stop == Stop::kUpper ? 2 * here - upper : dInfinity);
}

/// With an unlimited range ODE does not look at the position, and keeps what it has found before: it would write the
/// row of a stop for which it has made no room. So there is a substep with a range in which the axis surely is.
void Joint::leave_stop(Axis& axis, double here) {
  if (std::exchange(axis.stop, Stop::kNone) != Stop::kNone) axis.leaving = Leaving::kBegins;
  if (axis.leaving == Leaving::kNot) return;
  const bool begins = axis.leaving == Leaving::kBegins;
  axis.leaving = begins ? Leaving::kEnds : Leaving::kNot;
  set_range(*axis.rows, begins && here >= 0 ? here - 1 : -dInfinity, begins && here < 0 ? here + 1 : dInfinity);
}

void Joint::transfer_own(StateArchive&) {}

void Joint::transfer(StateArchive& archive) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    MotorMode mode = axis.description.motor;
    archive(axis.target_position, axis.target_velocity, axis.target_effort, mode, axis.description.max_force, axis.gain,
            axis.stop, axis.followed, axis.leader_followed);
    if (!archive.restores()) continue;
    if (axis.motor != nullptr) set_motor_mode(static_cast<int>(i), mode);
  }
  if (archive.restores()) {
    for (const int index : stopped_) restore_stop(axes_[static_cast<std::size_t>(index)]);
  }
  transfer_own(archive);
}

/// Sets ODE's rows so that the next set_stops() continues from `axis.stop`.
void Joint::restore_stop(Axis& axis) {
  if (axis.stop == Stop::kNone) {
    axis.leaving = Leaving::kBegins;  // the rows may be those of a stop
  } else {
    axis.rows->set(dParamStopERP, axis.stop == Stop::kBeyond ? kErrorReduction : -1);
  }
}

Vector3 axis_direction(const JointDescription& description, int axis, const JointSite& site) {
  return site.pose.orientation * description.axes[static_cast<std::size_t>(axis)].direction;
}

}  // namespace bubblesim
