// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/tree.hpp"

#include <cmath>

#include "physics/solver/turns.hpp"

namespace bubblesim {
namespace {

int count_of(TreeMotion motion) {
  switch (motion) {
    case TreeMotion::kFree:
      return 6;
    case TreeMotion::kBall:
      return 3;
    case TreeMotion::kTwoAxes:
      return 2;
    case TreeMotion::kFixed:
      return 0;
    default:
      return 1;
  }
}

bool turns(TreeMotion motion) { return motion == TreeMotion::kTurns || motion == TreeMotion::kScrews; }
bool slides(TreeMotion motion) { return motion == TreeMotion::kSlides || motion == TreeMotion::kScrews; }

}  // namespace

int Tree::add(const TreeLink& link) {
  const int number = links();
  Placed placed;
  placed.link = link;
  placed.first_dof = dofs();
  placed.dof_count = count_of(link.motion);
  placed.last_dof = link.parent < 0 ? -1 : last_dof(link.parent);
  placed.free_root = link.motion == TreeMotion::kFree ? number : link.parent < 0 ? -1 : free_root(link.parent);
  placed.axis = link.in_parent.orientation * link.axis;
  for (int i = 0; i < placed.dof_count; ++i) {
    placed.last_dof = mass_matrix_.add(placed.last_dof);
    columns_.emplace_back();
    directions_.add();
  }
  rates_ = Eigen::VectorXd::Zero(dofs());
  links_.push_back(placed);
  joints_.emplace_back();
  bodies_.emplace_back();
  return number;
}

void Tree::set_inertia(int link, double mass, const Matrix3& inertia) {
  links_[index(link)].link.mass = mass;
  links_[index(link)].link.inertia = inertia;
}

Pose Tree::pose(int link) const {
  const Body& body = bodies_[index(link)];
  return {origin_ + body.centre, body.orientation};
}

void Tree::set_origin(const Vector3& origin) {
  origin_ = origin;
  world_.centre = -origin;
}

void Tree::read(const std::vector<Pose>& poses, const std::vector<Twist>& velocities) {
  set_origin(poses[0].position);
  for (int i = 0; i < links(); ++i) {
    const Placed& placed = links_[index(i)];
    const TreeLink& link = placed.link;
    TreeJointState& state = joints_[index(i)];
    Body& body = bodies_[index(i)];
    const int dof = placed.first_dof;
    const Pose& here = poses[index(i)];
    const Twist& now = velocities[index(i)];
    body.orientation = here.orientation;
    body.axes = here.orientation.toRotationMatrix();
    body.centre = here.position - origin_;
    if (link.motion == TreeMotion::kFree) {
      state.place = here.position;
      state.turn = here.orientation;
      rates_.segment<3>(dof) = now.angular;
      rates_.segment<3>(dof + 3) = now.linear;
      place_joint(i);
      continue;
    }
    const Body& parent = parent_of(link);
    const Twist carried = link.parent < 0 ? Twist() : velocities[index(link.parent)];
    const Quaternion joint = parent.orientation * link.in_parent.orientation;
    const Quaternion turn = joint.conjugate() * (here.orientation * link.in_child.orientation);
    const Vector3 spin = now.angular - carried.angular;
    const Vector3 axis = parent.axes * placed.axis;
    if (turns(link.motion)) {
      state.turn = turn_about(link.axis, turn);
      rates_[dof] = axis.dot(spin);
    }
    if (slides(link.motion)) {
      const Vector3 anchor = body.centre + body.axes * link.in_child.position;
      state.slide = axis.dot(anchor - parent.centre - parent.axes * link.in_parent.position);
    }
    if (link.motion == TreeMotion::kSlides) {
      const Vector3 at_parent = carried.linear + carried.angular.cross(body.centre - parent.centre);
      rates_[dof] = axis.dot(now.linear - at_parent);
    }
    if (link.motion == TreeMotion::kBall) {
      state.turn = turn;
      rates_.segment<3>(dof) = spin;
    }
    if (link.motion == TreeMotion::kTwoAxes) {
      state.turn = turn_about(link.axis, angle_about(link.axis, link.axis2, turn * link.axis2));
      state.turn2 = turn_about(link.axis2, -angle_about(link.axis2, link.axis, turn.conjugate() * link.axis));
      const Vector3 axis2 = joint * (state.turn * link.axis2);
      // The part of the spin in the plane of the axes, which need not be at right angles.
      const double mixed = axis.dot(axis2);
      const double a = axis.dot(spin);
      const double b = axis2.dot(spin);
      rates_[dof] = (a - mixed * b) / (1 - mixed * mixed);
      rates_[dof + 1] = (b - mixed * a) / (1 - mixed * mixed);
    }
    place_joint(i);
  }
}

void Tree::place() {
  for (int i = 0; i < links(); ++i) {
    const TreeLink& link = links_[index(i)].link;
    const TreeJointState& state = joints_[index(i)];
    Body& body = bodies_[index(i)];
    if (link.motion == TreeMotion::kFree) {
      body.orientation = state.turn;
      body.axes = body.orientation.toRotationMatrix();
      if (i == 0) set_origin(state.place);
      body.centre = state.place - origin_;
      place_joint(i);
      continue;
    }
    Quaternion turned = parent_of(link).orientation * link.in_parent.orientation * state.turn;
    if (link.motion == TreeMotion::kTwoAxes) turned = turned * state.turn2;
    body.orientation = (turned * link.in_child.orientation.conjugate()).normalized();
    body.axes = body.orientation.toRotationMatrix();
    if (i == 0) set_origin(Vector3());
    place_joint(i);
    body.centre = body.anchor - body.axes * link.in_child.position;
    if (i > 0) continue;
    set_origin(body.centre);
    body.centre = Vector3();
    place_joint(i);
  }
}

/// Computes anchor and directions of motion; the parent is placed, and the link of kFree.
void Tree::place_joint(int number) {
  const Placed& placed = links_[index(number)];
  const TreeLink& link = placed.link;
  const Body& parent = parent_of(link);
  Body& body = bodies_[index(number)];
  int dof = placed.first_dof;
  const auto turning = [&](const Vector3& axis) { set_column(dof++, {axis, body.anchor.cross(axis)}); };
  if (link.motion == TreeMotion::kFree) {
    body.anchor = body.centre;
    for (int k = 0; k < 3; ++k) turning(Vector3::Unit(k));
    for (int k = 0; k < 3; ++k) set_column(dof++, {Vector3(), Vector3::Unit(k)});
    return;
  }
  const Vector3 axis = parent.axes * placed.axis;
  body.anchor = parent.centre + parent.axes * link.in_parent.position;
  if (slides(link.motion)) body.anchor += axis * joints_[index(number)].slide;
  switch (link.motion) {
    case TreeMotion::kBall:
      for (int k = 0; k < 3; ++k) turning(Vector3::Unit(k));
      break;
    case TreeMotion::kSlides:
      set_column(dof, {Vector3(), axis});
      break;
    case TreeMotion::kScrews:
      set_column(dof, {axis, body.anchor.cross(axis) + axis * link.lead});
      break;
    case TreeMotion::kTwoAxes:
      turning(axis);
      turning(parent.axes * (link.in_parent.orientation * (joints_[index(number)].turn * link.axis2)));
      break;
    case TreeMotion::kTurns:
      turning(axis);
      break;
    default:
      break;
  }
}

void Tree::set_column(int dof, const RigidMotion& column) {
  columns_[index(dof)] = column;
  directions_.set(dof, column);
}

void Tree::move(double step) {
  for (int i = 0; i < links(); ++i) {
    const TreeLink& link = links_[index(i)].link;
    TreeJointState& state = joints_[index(i)];
    const int dof = first_dof(i);
    switch (link.motion) {
      case TreeMotion::kFree:
        state.turn = (turn_by(rates_.segment<3>(dof) * step) * state.turn).normalized();
        state.place += rates_.segment<3>(dof + 3) * step;
        break;
      case TreeMotion::kBall: {
        const Quaternion joint = parent_of(link).orientation * link.in_parent.orientation;
        state.turn = (turn_by(joint.conjugate() * (rates_.segment<3>(dof) * step)) * state.turn).normalized();
        break;
      }
      case TreeMotion::kTwoAxes:
        state.turn = (turn_about(link.axis, rates_[dof] * step) * state.turn).normalized();
        state.turn2 = (turn_about(link.axis2, rates_[dof + 1] * step) * state.turn2).normalized();
        break;
      case TreeMotion::kSlides:
        state.slide += rates_[dof] * step;
        break;
      case TreeMotion::kTurns:
      case TreeMotion::kScrews:
        state.turn = (turn_about(link.axis, rates_[dof] * step) * state.turn).normalized();
        state.slide += link.lead * rates_[dof] * step;
        break;
      case TreeMotion::kFixed:
        break;
    }
  }
}

}  // namespace bubblesim
