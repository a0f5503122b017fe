// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/placed_model.hpp"

#include <algorithm>
#include <limits>

namespace bubblesim {

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

void anchor(PlacedModel& model, std::size_t joint, const Pose& pose) {
  model.joints[joint].in_parent = pose;
  model.joints[joint].joint->hold_here();
  model.trees.reset();
}

PlanarMotor make_planar_motor(dWorldID world, const PlacedModel& model) {
  const auto link = std::find_if(model.links.begin(), model.links.end(),
                                 [&](const Link& each) { return each.object == model.frame.canonical_link; });
  PlanarMotor motor(world, link->body.get());
  motor.limit(total_mass(model));
  return motor;
}

}  // namespace bubblesim
