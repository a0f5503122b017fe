// SPDX-License-Identifier: BSD-3-Clause
// The rows of a model's joints: motors, friction, dampers, stops, closed loops, gearboxes; and of its planar motor.
#include <array>
#include <cmath>
#include <limits>

#include "physics/contacts/tree_model.hpp"
#include "physics/ode/constraint_defaults.hpp"
#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kReachOfStop = 1000;  // rad/s^2 or m/s^2, with which an axis may reach a stop in a substep

/// Lets a row reach a velocity, in m/s or rad/s, with a force or torque of at most `most`.
void drive(ConstraintRows& rows, int row, double velocity, double most, double step) {
  rows.set(row, velocity, kConstraintSoftness / step, 0);
  rows.bound(row, -most * step, most * step);
}

/// Of a point of one body beside another one that turns, m/s^2, while the rates are constant.
Vector3 relative_acceleration(const TreeBody& body, const TreeBody& beside, const Vector3& point) {
  const auto velocity = [&](const TreeBody& of) {
    const Twist twist = of.tree->velocity(of.link);
    return Vector3(twist.linear + twist.angular.cross(point - of.tree->pose(of.link).position));
  };
  Vector3 made;
  if (body.tree != nullptr) made += body.tree->acceleration(body.link, point);
  if (beside.tree == nullptr) return made;
  made -= beside.tree->acceleration(beside.link, point);
  const Vector3 passing = (body.tree == nullptr ? Vector3() : velocity(body)) - velocity(beside);
  return made - 2 * beside.tree->velocity(beside.link).angular.cross(passing);
}

}  // namespace

void TreeModel::add_rows(ConstraintRows& rows, double step) {
  motors_.clear();
  for (const std::size_t joint : loops_) close_loop(joint, rows, step);
  for (const std::size_t gearbox : gearboxes_) couple(gearbox, rows, step);
  for (const Axis& axis : axes_) add_axis_rows(axis, rows, step);
  if (model_.planar_motor.exists()) add_planar_motor(rows, step);
}

int TreeModel::add_axis_row(const Axis& axis, ConstraintRows& rows) {
  if (axis.dof >= 0) return rows.add_dof(tree_, axis.dof);
  const PlacedJoint& joint = model_.joints[axis.joint];
  const JointDescription& description = model_.description.joints[axis.joint];
  const Pose frame = link_pose(link_of(joint.child)) * joint.in_child;
  const Vector3 direction = frame.orientation * description.axes[0].direction;
  if (description.type == "prismatic") {
    return rows.add_force(body_of(joint.child), body_of(joint.parent), frame.position, direction);
  }
  return rows.add_torque(body_of(joint.child), body_of(joint.parent), direction);
}

void TreeModel::add_axis_rows(const Axis& axis, ConstraintRows& rows, double step) {
  const PlacedJoint& joint = model_.joints[axis.joint];
  const AxisForces& forces = axis.forces;
  const auto hold = [&](const MotorForce& force) {
    const int row = add_axis_row(axis, rows);
    drive(rows, row, force.velocity, force.max_force, step);
    return row;
  };
  if (forces.motor && forces.motor->max_force > 0) {
    const int row = hold(*forces.motor);
    MotorMeter* meter = joint.motor_meters[static_cast<std::size_t>(axis.number)].get();
    if (meter != nullptr) motors_.push_back({meter, row});
  }
  if (forces.friction) hold(*forces.friction);
  if (axis.dof < 0 && forces.damper && forces.damper->softness > 0) {
    const int row = add_axis_row(axis, rows);
    rows.set(row, forces.damper->velocity, forces.damper->softness / step, 0);
    rows.bound(row, -kInfinity, kInfinity);
  }
  add_stops(axis, rows, step);
}

void TreeModel::add_stops(const Axis& axis, ConstraintRows& rows, double step) {
  const Joint& joint = *model_.joints[axis.joint].joint;
  const AxisDescription& limits = joint.axis(axis.number);
  if (!std::isfinite(limits.lower) && !std::isfinite(limits.upper)) return;
  const double here = joint.position_when_driven(axis.number);
  const double speed = joint.velocity(axis.number);
  const double reach = step * (2 * std::abs(speed) + step * kReachOfStop);
  const auto stop = [&](double gap, double lower, double upper) {
    const int row = add_axis_row(axis, rows);
    const bool beyond = lower == 0 ? gap > 0 : gap < 0;
    rows.set(row, (beyond ? kErrorReduction : 1) * gap / step, kConstraintSoftness / step, 0);
    rows.bound(row, lower, upper);
  };
  if (limits.lower == limits.upper) return stop(limits.lower - here, -kInfinity, kInfinity);
  if (here - limits.lower < reach) stop(limits.lower - here, 0, kInfinity);
  if (limits.upper - here < reach) stop(limits.upper - here, -kInfinity, 0);
}

void TreeModel::close_loop(std::size_t number, ConstraintRows& rows, double step) {
  const PlacedJoint& joint = model_.joints[number];
  const JointDescription& description = model_.description.joints[number];
  const TreeMotion motion = motion_of(description.type);
  const Pose child = link_pose(link_of(joint.child)) * joint.in_child;
  const Pose parent = joint.parent == kNoObject ? joint.in_parent : link_pose(link_of(joint.parent)) * joint.in_parent;
  const TreeBody first = body_of(joint.child);
  const TreeBody second = body_of(joint.parent);
  const Vector3 axis = description.axes.empty() ? Vector3(Vector3::UnitX())
                                                : Vector3(parent.orientation * description.axes[0].direction);
  const Vector3 across = axis.unitOrthogonal();
  const std::array<Vector3, 3> directions = {axis, across, axis.cross(across)};
  const Vector3 apart = child.position - parent.position;
  const Quaternion turn = child.orientation * parent.orientation.conjugate();
  const Vector3 turned = Vector3(turn.vec()) * (turn.w() < 0 ? -2 : 2);  // rad, while it is small
  const Vector3 tilt =
      description.axes.empty() ? Vector3() : axis.cross(child.orientation * description.axes[0].direction);
  // Both parts move on curves: without this part, the joint would stay open by five times what a substep opens it.
  const Vector3 drift = relative_acceleration(first, second, child.position) * (step * step / 2);
  for (std::size_t i = motion == TreeMotion::kSlides ? 1 : 0; i < 3; ++i) {
    const int row = rows.add_force(first, second, child.position, directions[i]);
    rows.hold(row, directions[i].dot(apart), step, directions[i].dot(drift));
  }
  if (motion == TreeMotion::kBall) return;
  for (std::size_t i = motion == TreeMotion::kTurns ? 1 : 0; i < 3; ++i) {
    const Vector3& error = motion == TreeMotion::kTurns ? tilt : turned;
    rows.hold(rows.add_torque(first, second, directions[i]), directions[i].dot(error), step);
  }
}

void TreeModel::couple(std::size_t number, ConstraintRows& rows, double step) {
  const PlacedJoint& gearbox = model_.joints[number];
  const ShaftCoupling shafts = *gearbox.joint->coupling();
  const TreeBody reference = body_named(model_.description.joints[number].gearbox_reference);
  const int row = rows.add_torque(body_of(gearbox.child), reference, shafts.child_axis);
  rows.add_torque_to_last(body_of(gearbox.parent), reference, shafts.parent_axis * shafts.ratio);
  const double error = gearbox.joint->position(1) + shafts.ratio * gearbox.joint->position(0);
  rows.hold(row, error, step);
}

void TreeModel::add_planar_motor(ConstraintRows& rows, double step) {
  const ObjectId link = model_.frame.canonical_link;
  const TreeBody body = body_of(link);
  const Vector3 centre = to_vector(dBodyGetPosition(link_of(link).body.get()));
  const std::array<double, 3> velocity = model_.planar_motor.velocity();
  const std::array<double, 3> most = model_.planar_motor.most();
  drive(rows, rows.add_force(body, {}, centre, Vector3::UnitX()), velocity[0], most[0], step);
  drive(rows, rows.add_force(body, {}, centre, Vector3::UnitY()), velocity[1], most[1], step);
  drive(rows, rows.add_torque(body, {}, Vector3::UnitZ()), velocity[2], most[2], step);
}

}  // namespace bubblesim
