// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/tree.hpp"

#include <algorithm>
#include <cmath>

#include "physics/solver/turns.hpp"
#include "scene/simd.hpp"

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
  const LinkDofs own{link.parent,
                     dofs(),
                     count_of(link.motion),
                     link.motion == TreeMotion::kFree,
                     link.motion == TreeMotion::kBall,
                     link.motion == TreeMotion::kFree && number == 0};
  placed.last_dof = link.parent < 0 ? -1 : last_dof(link.parent);
  placed.free_root = link.motion == TreeMotion::kFree ? number : link.parent < 0 ? -1 : free_root(link.parent);
  placed.axis = lanes_of(link.in_parent.orientation * link.axis);
  placed.in_parent = lanes_of(link.in_parent.position);
  placed.in_child = lanes_of(link.in_child.position);
  const Quaternion back = link.in_child.orientation.conjugate();
  placed.straight = lanes_of(link.in_parent.orientation * back);
  placed.turned = lanes_of(link.in_parent.orientation * turn_about(link.axis, M_PI) * back);
  numbers_.push_back(own);
  for (int i = 0; i < own.count; ++i) {
    placed.last_dof = factors_.add(placed.last_dof);
    dofs_.emplace_back();
    directions_.add();
    const int first = std::max(factors_.first_of_run(placed.last_dof), numbers_.front().is_base ? 6 : 0);
    has_long_runs_ = has_long_runs_ || placed.last_dof - first >= kShortRun;
  }
  rates_ = Eigen::VectorXd::Zero(dofs());
  links_.push_back(placed);
  inertias_.emplace_back();
  joints_.emplace_back();
  bodies_.emplace_back();
  set_inertia(number, link.mass, link.inertia);
  return number;
}

void Tree::set_inertia(int link, double mass, const Matrix3& inertia) {
  Body& body = bodies_[index(link)];
  links_[index(link)].link.mass = body.mass = mass;
  links_[index(link)].link.inertia = inertia;
  body.inertia = turned_inertia(inertia, body.axes);
}

BUBBLESIM_INLINE void Tree::turn(int link, const Four& orientation) {
  Body& body = bodies_[index(link)];
  body.orientation = orientation;
  body.axes.set_turn(orientation);
  body.inertia = turned_inertia(links_[index(link)].link.inertia, body.axes);
}

BUBBLESIM_INLINE void Tree::set_origin(const Four& origin) {
  origin_ = vector_of(origin);
  world_.centre = -origin;
}

BUBBLESIM_SIMD void Tree::read(const std::vector<TreeLinkState>& states) {
  set_origin(states[0].place);
  for (int i = 0; i < links(); ++i) {
    Body& body = bodies_[index(i)];
    // Bodies that the tree itself has placed are turned already.
    const TreeLinkState& state = states[index(i)];
    if (!has_same_bits(body.orientation, state.turn)) turn(i, state.turn);
    body.centre = state.place - states[0].place;
    read_joint(i, states);
    place_joint(i);
  }
  set_velocities(rates_);
}

/// Takes coordinate and rates of a joint; the links are placed.
BUBBLESIM_INLINE void Tree::read_joint(int number, const std::vector<TreeLinkState>& states) {
  const Placed& placed = links_[index(number)];
  const TreeLink& link = placed.link;
  TreeJointState& state = joints_[index(number)];
  const Body& body = bodies_[index(number)];
  const SpatialLanes& now = states[index(number)].velocity;
  double* const rates = rates_.data() + first_dof(number);
  if (link.motion == TreeMotion::kFree) {
    state.place = origin_ + vector_of(body.centre);
    state.turn = quaternion_of(body);
    for (int k = 0; k < 3; ++k) rates[k] = now.angular[k];
    for (int k = 0; k < 3; ++k) rates[k + 3] = now.linear[k];
    return;
  }
  const Body& parent = parent_of(link);
  const SpatialLanes carried = link.parent < 0 ? SpatialLanes() : states[index(link.parent)].velocity;
  const Four spin = now.angular - carried.angular;
  const Four axis = parent.axes * placed.axis;
  if (turns(link.motion)) {
    const Four turn = turn_product(turn_back(parent.orientation), body.orientation);
    state.turn = turn_of_parts(link.axis, turn_dot(placed.straight, turn), turn_dot(placed.turned, turn));
    rates[0] = lanes_dot(axis, spin);
  }
  if (slides(link.motion)) {
    const Four anchor = body.centre + body.axes * placed.in_child;
    state.slide = lanes_dot(axis, anchor - parent.centre - parent.axes * placed.in_parent);
  }
  if (link.motion == TreeMotion::kSlides) {
    rates[0] = lanes_dot(axis, now.linear - carried.at(body.centre - parent.centre));
  }
  if (link.motion != TreeMotion::kBall && link.motion != TreeMotion::kTwoAxes) return;
  const Quaternion joint = quaternion_of(parent) * link.in_parent.orientation;
  const Quaternion turn = joint.conjugate() * (quaternion_of(body) * link.in_child.orientation);
  if (link.motion == TreeMotion::kBall) {
    state.turn = turn;
    for (int k = 0; k < 3; ++k) rates[k] = spin[k];
    return;
  }
  state.turn = turn_about(link.axis, angle_about(link.axis, link.axis2, turn * link.axis2));
  state.turn2 = turn_about(link.axis2, -angle_about(link.axis2, link.axis, turn.conjugate() * link.axis));
  const Four axis2 = lanes_of(joint * (state.turn * link.axis2));
  // The part of the spin in the plane of the axes, which need not be at right angles.
  const double mixed = lanes_dot(axis, axis2);
  const double a = lanes_dot(axis, spin);
  const double b = lanes_dot(axis2, spin);
  rates[0] = (a - mixed * b) / (1 - mixed * mixed);
  rates[1] = (b - mixed * a) / (1 - mixed * mixed);
}

BUBBLESIM_SIMD void Tree::place() {
  for (int i = 0; i < links(); ++i) {
    const Placed& placed = links_[index(i)];
    const TreeLink& link = placed.link;
    const TreeJointState& state = joints_[index(i)];
    Body& body = bodies_[index(i)];
    if (link.motion == TreeMotion::kFree) {
      turn(i, lanes_of(state.turn));
      if (i == 0) set_origin(lanes_of(state.place));
      body.centre = lanes_of(state.place) - lanes_of(origin_);
      place_joint(i);
      continue;
    }
    Four turned;  // in the parent
    if (turns(link.motion)) {
      turned = placed.straight * state.turn.w() + placed.turned * link.axis.dot(state.turn.vec());
    } else {
      Quaternion inner = state.turn;
      if (link.motion == TreeMotion::kTwoAxes) inner = inner * state.turn2;
      turned = lanes_of(link.in_parent.orientation * inner * link.in_child.orientation.conjugate());
    }
    turned = turn_product(parent_of(link).orientation, turned);
    turn(i, turned * inverse_length(turn_dot(turned, turned)));
    if (i == 0) set_origin(Four{});
    place_joint(i);
    body.centre = body.anchor - body.axes * placed.in_child;
    if (i > 0) continue;
    set_origin(body.centre);
    body.centre = Four{};
    place_joint(i);
  }
  set_velocities(rates_);
}

/// Computes anchor and directions of motion; the parent is placed, and the link of kFree.
BUBBLESIM_INLINE void Tree::place_joint(int number) {
  const Placed& placed = links_[index(number)];
  const TreeLink& link = placed.link;
  const Body& parent = parent_of(link);
  Body& body = bodies_[index(number)];
  TreeDof* const dof = dofs_.data() + first_dof(number);
  const Four units[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  if (link.motion == TreeMotion::kFree) {
    body.anchor = body.centre;
    for (int k = 0; k < 3; ++k) dof[k].direction = {units[k], cross(body.anchor, units[k])};
    for (int k = 0; k < 3; ++k) dof[k + 3].direction = {Four{}, units[k]};
    return;
  }
  const Four axis = parent.axes * placed.axis;
  Four anchor = parent.centre + parent.axes * placed.in_parent;
  if (slides(link.motion)) anchor += axis * joints_[index(number)].slide;
  body.anchor = anchor;
  switch (link.motion) {
    case TreeMotion::kBall:
      for (int k = 0; k < 3; ++k) dof[k].direction = {units[k], cross(anchor, units[k])};
      break;
    case TreeMotion::kSlides:
      dof->direction = {Four{}, axis};
      break;
    case TreeMotion::kScrews:
      dof->direction = {axis, cross(anchor, axis) + axis * link.lead};
      break;
    case TreeMotion::kTwoAxes: {
      const Four in_parent = lanes_of(link.in_parent.orientation * (joints_[index(number)].turn * link.axis2));
      const Four axis2 = parent.axes * in_parent;
      dof[0].direction = {axis, cross(anchor, axis)};
      dof[1].direction = {axis2, cross(anchor, axis2)};
      break;
    }
    case TreeMotion::kTurns:
      dof->direction = {axis, cross(anchor, axis)};
      break;
    default:
      break;
  }
}

void Tree::move(double step) {
  for (int i = 0; i < links(); ++i) {
    const TreeLink& link = links_[index(i)].link;
    TreeJointState& state = joints_[index(i)];
    const int dof = first_dof(i);
    switch (link.motion) {
      case TreeMotion::kFree:
        state.turn = normalized(turn_by(rates_.segment<3>(dof) * step) * state.turn);
        state.place += rates_.segment<3>(dof + 3) * step;
        break;
      case TreeMotion::kBall: {
        const Quaternion joint = quaternion_of(parent_of(link)) * link.in_parent.orientation;
        state.turn = normalized(turn_by(joint.conjugate() * (rates_.segment<3>(dof) * step)) * state.turn);
        break;
      }
      case TreeMotion::kTwoAxes:
        state.turn = normalized(turn_about(link.axis, rates_[dof] * step) * state.turn);
        state.turn2 = normalized(turn_about(link.axis2, rates_[dof + 1] * step) * state.turn2);
        break;
      case TreeMotion::kSlides:
        state.slide += rates_[dof] * step;
        break;
      case TreeMotion::kTurns:
      case TreeMotion::kScrews:
        state.turn = normalized(turn_about(link.axis, rates_[dof] * step) * state.turn);
        state.slide += link.lead * rates_[dof] * step;
        break;
      case TreeMotion::kFixed:
        break;
    }
  }
}

}  // namespace bubblesim
