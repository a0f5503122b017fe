// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/tree_model.hpp"

#include <algorithm>
#include <cmath>

#include "physics/ode/body_state.hpp"
#include "physics/ode/ode_math.hpp"
#include "scene/simd.hpp"

namespace bubblesim {
namespace {

constexpr double kMostTurn = 0.5;        // rad in a substep, of a link that swings
constexpr double kMostTurnInSeries = 3;  // rad in a substep, of all links in series if they turned as fast

bool closes_loops(const std::string& type) {
  const TreeMotion motion = motion_of(type);
  return motion != TreeMotion::kScrews && motion != TreeMotion::kTwoAxes;
}

bool is_gearbox(const PlacedModel& model, std::size_t joint) {
  return model.description.joints[joint].type == "gearbox";
}

bool is_child_of_joint(const PlacedModel& model, ObjectId link) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (model.joints[i].child == link && !is_gearbox(model, i)) return true;
  }
  return false;
}

Pose in_body(const Link& link, const Pose& in_link) {
  return {in_link.position - link.centre_of_mass, in_link.orientation};
}

}  // namespace

TreeMotion motion_of(const std::string& type) {
  if (type == "prismatic") return TreeMotion::kSlides;
  if (type == "screw") return TreeMotion::kScrews;
  if (type == "fixed") return TreeMotion::kFixed;
  if (type == "ball") return TreeMotion::kBall;
  if (type == "universal" || type == "revolute2") return TreeMotion::kTwoAxes;
  return TreeMotion::kTurns;
}

std::size_t TreeModel::place_of(ObjectId link) const {
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    if (model_.links[i].object == link) return i;
  }
  return model_.links.size();
}

const Link& TreeModel::link_of(ObjectId link) const { return model_.links[place_of(link)]; }

TreeBody TreeModel::body_of(ObjectId link) {
  if (link == kNoObject) return {};
  return {&tree_, numbers_[place_of(link)]};
}

/// Of a link; of the world for "world".
TreeBody TreeModel::body_named(const std::string& name) {
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    if (model_.description.links[i].name == name) return {&tree_, numbers_[i]};
  }
  return {};
}

TreeBody TreeModel::body(const Link& link) {
  const int place = link.number - model_.links.front().number;
  return {&tree_, numbers_[static_cast<std::size_t>(place)]};
}

TreeModel::TreeModel(const PlacedModel& model) : model_(model), numbers_(model.links.size(), -1) {
  std::vector<bool> used(model.joints.size(), false);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (!is_gearbox(model, i)) continue;
    used[i] = true;
    gearboxes_.push_back(i);
  }
  const auto is_placed = [&](ObjectId link) { return link == kNoObject || numbers_[place_of(link)] >= 0; };
  const auto grow = [&] {
    bool any = false;
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      const PlacedJoint& joint = model.joints[i];
      if (used[i] || !is_placed(joint.parent) || is_placed(joint.child)) continue;
      used[i] = any = true;
      add_link(i, joint.parent == kNoObject ? -1 : numbers_[place_of(joint.parent)]);
    }
    return any;
  };
  for (;;) {
    while (grow()) {
    }
    // A root: a link that is not the child of a joint, or else the first one left.
    std::size_t root = model.links.size();
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      if (numbers_[i] >= 0) continue;
      const bool is_child = is_child_of_joint(model, model.links[i].object);
      if (!is_child || root == model.links.size()) root = i;
      if (!is_child) break;
    }
    if (root == model.links.size()) break;
    TreeLink link;
    link.motion = TreeMotion::kFree;
    numbers_[root] = tree_.add(link);
    parts_.push_back(&model.links[root]);
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) take_inertia(i);
  note_what_swings();
  keeps_momenta_ =
      std::any_of(model.joints.begin(), model.joints.end(), [](const auto& joint) { return joint.meter != nullptr; });
  for (int i = 0; i < tree_.links(); ++i) floats_ = floats_ || tree_.free_root(i) >= 0;
  keeps_momenta_ = keeps_momenta_ || floats_;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (used[i]) continue;
    loops_.push_back(i);
    for (int k = 0; k < model.joints[i].joint->axis_count(); ++k) axes_.push_back({i, k, -1, {}});
  }
}

void TreeModel::add_link(std::size_t number, int parent) {
  const PlacedJoint& joint = model_.joints[number];
  const JointDescription& description = model_.description.joints[number];
  const std::size_t place = place_of(joint.child);
  TreeLink link;
  link.parent = parent;
  link.motion = motion_of(description.type);
  if (!description.axes.empty()) link.axis = description.axes[0].direction;
  if (description.axes.size() > 1) link.axis2 = description.axes[1].direction;
  link.lead = link.motion == TreeMotion::kScrews ? description.screw_lead / (2 * M_PI) : 0;
  link.in_parent = joint.parent == kNoObject ? joint.in_parent : in_body(link_of(joint.parent), joint.in_parent);
  link.in_child = in_body(model_.links[place], joint.in_child);
  numbers_[place] = tree_.add(link);
  parts_.push_back(&model_.links[place]);
  tree_joints_.push_back({number, numbers_[place]});
  for (int k = 0; k < joint.joint->axis_count(); ++k) {
    axes_.push_back({number, k, tree_.first_dof(numbers_[place]) + k, {}});
  }
}

bool TreeModel::knows_joints_of(const PlacedModel& model) {
  std::vector<ObjectId> children;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (is_gearbox(model, i)) continue;
    const ObjectId child = model.joints[i].child;
    const bool again = std::find(children.begin(), children.end(), child) != children.end();
    if (again && !closes_loops(model.description.joints[i].type)) return false;
    children.push_back(child);
  }
  return true;
}

bool TreeModel::knows_parts() const {
  return std::all_of(model_.joints.begin(), model_.joints.end(),
                     [](const auto& joint) { return joint.joint != nullptr; }) &&
         std::all_of(loops_.begin(), loops_.end(),
                     [&](std::size_t joint) { return model_.joints[joint].meter == nullptr; });
}

void TreeModel::take_inertia(std::size_t number) {
  const Link& link = *parts_[number];
  tree_.set_inertia(static_cast<int>(number), link.mass, inertia_of(link.body.get()));
}

void TreeModel::note_what_swings() {
  std::vector<bool> swings(parts_.size(), false);
  for (int i = 0; i < tree_.links(); ++i) {
    if (tree_.dof_count(i) > 1) swings[static_cast<std::size_t>(i)] = true;
    if (tree_.parent(i) >= 0) swings[static_cast<std::size_t>(tree_.parent(i))] = true;
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (swings[i]) swinging_.push_back(static_cast<int>(i));
  }
  std::vector<int> in_series(parts_.size(), 0);
  int most = 1;
  for (int i = 0; i < tree_.links(); ++i) {
    const int before = tree_.parent(i) < 0 ? 0 : in_series[static_cast<std::size_t>(tree_.parent(i))];
    most = std::max(most, in_series[static_cast<std::size_t>(i)] = before + (tree_.dof_count(i) > 0 ? 1 : 0));
  }
  most_turn_ = std::min(kMostTurn, kMostTurnInSeries / most);
}

template <class RateOf>
bool TreeModel::any_turns_too_far(double step, const RateOf& rate_of) const {
  const double most = most_turn_ / step;
  return std::any_of(swinging_.begin(), swinging_.end(),
                     [&](int link) { return rate_of(link).squaredNorm() > most * most; });
}

bool TreeModel::turns_too_far(double step) const {
  return any_turns_too_far(step, [&](int link) {
    return to_vector(dBodyGetAngularVel(parts_[static_cast<std::size_t>(link)]->body.get()));
  });
}

bool TreeModel::would_turn_too_far(double step) {
  if (tree_.rates().lpNorm<1>() * step < most_turn_) return false;
  tree_.set_velocities(tree_.rates());
  return any_turns_too_far(step, [&](int link) { return tree_.velocity(link).angular; });
}

/// Takes states and wrenches from ODE's bodies.
BUBBLESIM_SIMD void TreeModel::take_states(const Vector3& gravity) {
  states_.resize(parts_.size());
  wrenches_.resize(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Link& link = *parts_[i];
    dBodyID body = link.body.get();
    const dReal* turn = dBodyGetQuaternion(body);
    const bool is_heavy = dBodyGetGravityMode(body) != 0;
    TreeLinkState& state = states_[i];
    state.place = lanes_of(dBodyGetPosition(body));
    state.turn = Four{turn[1], turn[2], turn[3], turn[0]};
    state.velocity = {lanes_of(dBodyGetAngularVel(body)), lanes_of(dBodyGetLinearVel(body))};
    wrenches_[i] = {lanes_of(dBodyGetTorque(body)), lanes_of(dBodyGetForce(body))};
    if (is_heavy) wrenches_[i].linear += lanes_of(gravity) * link.mass;
    if (tree_.mass(static_cast<int>(i)) != link.mass) take_inertia(i);
  }
}

void TreeModel::begin(const Vector3& gravity, double step) {
  take_states(gravity);
  tree_.read(states_);
  forces_.setZero(tree_.dofs());
  added_.setZero(tree_.dofs());
  for (Axis& axis : axes_) {
    axis.forces = model_.joints[axis.joint].joint->forces(axis.number);
    const MotorForce* damper = axis.forces.damper;
    if (axis.dof < 0 || damper == nullptr || !(damper->softness > 0)) continue;
    // A force at the velocity after the substep: stable for any coefficient.
    const double coefficient = 1 / damper->softness;
    added_[axis.dof] = step * coefficient;
    forces_[axis.dof] = coefficient * (damper->velocity - tree_.rates()[axis.dof]);
  }
  tree_.weigh(added_);
  if (keeps_momenta_) {
    loose_.resize(parts_.size());
    tree_.release(states_, wrenches_, step, loose_);
  }
  // A velocity that the joints do not allow, such as one that was set, acts as an impulse.
  tree_.add_impulses(states_, step, wrenches_);
  tree_.push(step, wrenches_, forces_);
}

void TreeModel::move(const ConstraintRows& rows, double step) {
  const Vector3 before = tree_.origin();
  if (keeps_momenta_) rows.add_impulses(tree_, loose_);
  const bool is_free = floats_ && rows.count() == 0;
  if (is_free) {
    tree_.set_velocities(tree_.rates());
    coast(-step / 2);
  }
  tree_.move(step);
  tree_.place();
  if (is_free) {
    tree_.weigh(added_);
    coast(step / 2);
    tree_.set_velocities(tree_.rates());
  }
  if (keeps_momenta_) keep_momenta(before);
}

/// Changes the rates as the inertia of the links does alone, in a part of a substep. Where nothing else holds a
/// floating robot, half of it acts at the place before and half at that after: else its joints would lose energy.
void TreeModel::coast(double step) {
  std::fill(wrenches_.begin(), wrenches_.end(), SpatialLanes());
  forces_.setZero();
  tree_.push(step, wrenches_, forces_);
}

/// Only what acts on a floating robot from outside changes its momentum: the efforts of its joints do not.
BUBBLESIM_SIMD void TreeModel::keep_momenta(const Vector3& origin_before) {
  const Four moved = lanes_of(origin_before - tree_.origin());
  for (SpatialLanes& momentum : loose_) momentum.angular += cross(moved, momentum.linear);
  tree_.set_momenta(loose_);
}

/// What a joint transmits is what the links behind it have got beside what acts on them from outside.
void TreeModel::report_reactions() {
  std::vector<bool> is_behind;
  for (const TreeJoint& joint : tree_joints_) {
    WrenchMeter* meter = model_.joints[joint.joint].meter.get();
    if (meter == nullptr) continue;
    SpatialLanes sum;
    is_behind.assign(parts_.size(), false);
    for (int i = joint.child; i < tree_.links(); ++i) {
      const int parent = tree_.parent(i);
      if (i != joint.child && (parent < 0 || !is_behind[static_cast<std::size_t>(parent)])) continue;
      is_behind[static_cast<std::size_t>(i)] = true;
      sum.add(tree_.momentum(i));
      sum.add(-1, loose_[static_cast<std::size_t>(i)]);
    }
    meter->report({vector_of(sum.linear), vector_of(sum.angular)}, tree_.origin());
  }
}

void TreeModel::end(const ConstraintRows& rows, double step) {
  for (const MotorRow& motor : motors_) motor.meter->add(rows.impulse(motor.row));
  move(rows, step);
  report_reactions();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    dBodyID body = parts_[i]->body.get();
    const Pose pose = tree_.pose(static_cast<int>(i));
    const Twist velocity = tree_.velocity(static_cast<int>(i));
    set_body_pose(body, pose);
    dBodySetLinearVel(body, velocity.linear.x(), velocity.linear.y(), velocity.linear.z());
    dBodySetAngularVel(body, velocity.angular.x(), velocity.angular.y(), velocity.angular.z());
    dBodySetForce(body, 0, 0, 0);
    dBodySetTorque(body, 0, 0, 0);
  }
}

}  // namespace bubblesim
