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
  for (int i = 0; i < placed.dof_count; ++i) {
    before_.push_back(placed.last_dof);
    depth_.push_back(placed.last_dof < 0 ? 0 : depth_[index(placed.last_dof)] + 1);
    row_.push_back(matrix_.size());
    matrix_.resize(matrix_.size() + depth_.back() + 1);
    placed.last_dof = dofs();
    columns_.emplace_back();
  }
  inverse_diagonal_.resize(columns_.size());
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

Pose Tree::pose_of_parent(int link) const {
  const int parent = links_[index(link)].link.parent;
  return parent < 0 ? Pose() : pose(parent);
}

void Tree::read(const std::vector<Pose>& poses, const std::vector<Twist>& velocities) {
  for (int i = 0; i < links(); ++i) {
    const TreeLink& link = links_[index(i)].link;
    TreeJointState& state = joints_[index(i)];
    const int dof = first_dof(i);
    const Pose& here = poses[index(i)];
    const Twist& now = velocities[index(i)];
    if (link.motion == TreeMotion::kFree) {
      state.place = here.position;
      state.turn = here.orientation;
      rates_.segment<3>(dof) = now.angular;
      rates_.segment<3>(dof + 3) = now.linear;
      continue;
    }
    const Pose parent = link.parent < 0 ? Pose() : poses[index(link.parent)];
    const Twist carried = link.parent < 0 ? Twist() : velocities[index(link.parent)];
    const Pose joint = parent * link.in_parent;
    const Pose moved = here * link.in_child;
    const Quaternion turn = joint.orientation.conjugate() * moved.orientation;
    const Vector3 spin = now.angular - carried.angular;
    const Vector3 axis = joint.orientation * link.axis;
    if (turns(link.motion)) {
      state.turn = turn_about(link.axis, turn);
      rates_[dof] = axis.dot(spin);
    }
    if (slides(link.motion)) state.slide = axis.dot(moved.position - joint.position);
    if (link.motion == TreeMotion::kSlides) {
      const Vector3 at_parent = carried.linear + carried.angular.cross(here.position - parent.position);
      rates_[dof] = axis.dot(now.linear - at_parent);
    }
    if (link.motion == TreeMotion::kBall) {
      state.turn = turn;
      rates_.segment<3>(dof) = spin;
    }
    if (link.motion == TreeMotion::kTwoAxes) {
      state.turn = turn_about(link.axis, angle_about(link.axis, link.axis2, turn * link.axis2));
      state.turn2 = turn_about(link.axis2, -angle_about(link.axis2, link.axis, turn.conjugate() * link.axis));
      const Vector3 axis2 = joint.orientation * (state.turn * link.axis2);
      // The part of the spin in the plane of the axes, which need not be at right angles.
      const double mixed = axis.dot(axis2);
      const double a = axis.dot(spin);
      const double b = axis2.dot(spin);
      rates_[dof] = (a - mixed * b) / (1 - mixed * mixed);
      rates_[dof + 1] = (b - mixed * a) / (1 - mixed * mixed);
    }
  }
}

void Tree::place() {
  for (int i = 0; i < links(); ++i) {
    const TreeLink& link = links_[index(i)].link;
    const TreeJointState& state = joints_[index(i)];
    Body& body = bodies_[index(i)];
    Pose joint;
    if (link.motion == TreeMotion::kFree) {
      joint = {state.place, state.turn};
      body.orientation = state.turn;
      if (i == 0) origin_ = state.place;
      body.centre = body.anchor = state.place - origin_;
    } else {
      joint = pose_of_parent(i) * link.in_parent;
      Quaternion turned = joint.orientation * state.turn;
      if (link.motion == TreeMotion::kTwoAxes) turned = turned * state.turn2;
      body.orientation = (turned * link.in_child.orientation.conjugate()).normalized();
      const Vector3 anchor = joint.position + joint.orientation * (link.axis * state.slide);
      const Vector3 centre = anchor - body.orientation * link.in_child.position;
      if (i == 0) origin_ = centre;
      body.anchor = anchor - origin_;
      body.centre = centre - origin_;
    }
    body.axes = body.orientation.toRotationMatrix();
    body.inertia = body.axes * link.inertia * body.axes.transpose();
    place_columns(i, joint);
  }
}

void Tree::place_columns(int number, const Pose& joint) {
  const Placed& placed = links_[index(number)];
  const TreeLink& link = placed.link;
  const Vector3& anchor = bodies_[index(number)].anchor;
  TreeColumn* column = columns_.data() + placed.first_dof;
  const auto turning = [&](const Vector3& axis) { *column++ = {axis, anchor.cross(axis)}; };
  if (link.motion == TreeMotion::kFree || link.motion == TreeMotion::kBall) {
    for (int k = 0; k < 3; ++k) turning(Vector3::Unit(k));
  }
  if (link.motion == TreeMotion::kFree) {
    for (int k = 0; k < 3; ++k) *column++ = {Vector3(), Vector3::Unit(k)};
  }
  const Vector3 axis = joint.orientation * link.axis;
  if (link.motion == TreeMotion::kSlides) *column++ = {Vector3(), axis};
  if (link.motion == TreeMotion::kScrews) *column++ = {axis, anchor.cross(axis) + axis * link.lead};
  if (link.motion == TreeMotion::kTurns || link.motion == TreeMotion::kTwoAxes) turning(axis);
  if (link.motion == TreeMotion::kTwoAxes) turning(joint.orientation * (joints_[index(number)].turn * link.axis2));
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
        const Quaternion joint = pose_of_parent(i).orientation * link.in_parent.orientation;
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
