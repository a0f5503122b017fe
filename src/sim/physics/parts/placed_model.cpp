// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/placed_model.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "physics/ode/body_state.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/parts/put_for_a_moment.hpp"
#include "scene/joint_kind.hpp"

namespace bubblesim {
namespace {

const Link& link_of(const PlacedModel& model, ObjectId id) {
  return *std::find_if(model.links.begin(), model.links.end(), [&](const Link& link) { return link.object == id; });
}

}  // namespace

double total_mass(const PlacedModel& model) {
  if (model.space == nullptr) return std::numeric_limits<double>::infinity();
  double mass = 0;
  for (const Link& link : model.links) mass += link.mass;
  return mass;
}

void apply_mass(PlacedModel& model, Link& link, double mass) {
  std::size_t index = 0;
  while (&model.links[index] != &link) ++index;
  const double factor = mass / link.mass;
  link.mass = mass;
  set_inertia(link.body.get(), model.description.links[index], mass);
  for (Rotation& rotation : model.rotations) {
    if (rotation.body() == link.body.get()) rotation.scale(factor);
  }
  for (Collider& collider : model.colliders) collider.model_mass = total_mass(model);
  if (model.planar_motor.exists()) model.planar_motor.limit(total_mass(model));
}

bool is_anchor(const PlacedModel& model, std::size_t joint) {
  return model.joints[joint].parent == kNoObject && model.joints[joint].joint != nullptr &&
         model.description.joints[joint].type == "fixed";
}

bool is_hinge(const PlacedModel& model, std::size_t joint) {
  return model.joints[joint].joint != nullptr && find_joint_kind(model.description.joints[joint].type)->is_hinge;
}

bool has_loose_frame(const PlacedModel& model, std::size_t joint) {
  return is_anchor(model, joint) || is_hinge(model, joint);
}

void place_joint(PlacedModel& model, std::size_t joint, const Pose& in_parent, const Pose& in_child) {
  PlacedJoint& placed = model.joints[joint];
  placed.in_parent = in_parent;
  placed.in_child = in_child;
  model.trees.reset();
  if (placed.meter != nullptr) placed.meter->place(in_child);
  // ODE takes the frame from the poses of the bodies, which are those of position 0 then. They depend on nothing else,
  // so that a restored joint has the same bits.
  std::optional<PutForAMoment> parent;
  if (placed.parent != kNoObject) parent.emplace(link_of(model, placed.parent), Pose());
  const PutForAMoment child(link_of(model, placed.child), in_parent * in_child.inverse());
  placed.joint->place(in_parent);
  for (std::size_t i = 0; i < placed.motor_meters.size(); ++i) {
    if (placed.motor_meters[i] == nullptr) continue;
    const Vector3 direction = in_parent.orientation * placed.joint->axis(static_cast<int>(i)).direction;
    placed.motor_meters[i]->place(direction, in_parent.position);
  }
}

PlanarMotor make_planar_motor(dWorldID world, const PlacedModel& model) {
  const auto link = std::find_if(model.links.begin(), model.links.end(),
                                 [&](const Link& each) { return each.object == model.frame.canonical_link; });
  PlanarMotor motor(world, link->body.get());
  motor.limit(total_mass(model));
  return motor;
}

}  // namespace bubblesim
