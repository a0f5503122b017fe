// SPDX-License-Identifier: BSD-3-Clause
// The links of static models: they have no body, but may be moved, and may move with a link that carries them.
#include <variant>
#include <vector>

#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

bool equal(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
}

/// The link with a body that moves a link: itself, or what carries it.
ObjectId mover_of(const WorldState& state, ObjectId link) {
  while (link != kNoObject && state.link(link).body == nullptr) link = state.link(link).carrier;
  return link;
}

/// Its own model does not collide with what it carries.
void note_carrier(WorldState& state, const Link& link) {
  const ObjectId model = link.carrier == kNoObject ? kNoObject : state.tree().outermost_model_of(link.carrier);
  for (Collider& collider : state.model_of(link.object).colliders) {
    if (collider.link == &link) collider.carrier = model;
  }
}

/// The link of a moving model with a name; kNoObject if there is none.
ObjectId moving_link(const WorldState& state, const std::string& name) {
  for (const auto& model : state.models) {
    if (model->description.is_static) continue;
    for (std::size_t i = 0; i < model->links.size(); ++i) {
      if (model->description.links[i].name == name) return model->links[i].object;
    }
  }
  return kNoObject;
}

}  // namespace

void place_static(WorldState& state, ObjectId id, const Pose& pose) {
  Link& link = state.link(id);
  link.pose = pose;
  for (const Collider& collider : state.model_of(id).colliders) {
    if (collider.link != &link || std::holds_alternative<Plane>(collider.geometry)) continue;
    const Pose placed = pose * collider.in_link;
    dGeomSetPosition(collider.geom.get(), placed.position.x(), placed.position.y(), placed.position.z());
    dGeomSetQuaternion(collider.geom.get(), to_ode(placed.orientation).data());
  }
  ++state.spaces.changes;
  // Viewers leave out what never moved.
  if (state.moved_statics.insert(id).second) ++state.revision;
}

void carry_statics(WorldState& state) {
  for (const ObjectId id : state.moved_statics) {
    if (!state.tree().contains(id)) continue;
    Link& link = state.link(id);
    if (link.carrier == kNoObject) continue;
    if (!state.tree().contains(link.carrier)) {
      link.carrier = kNoObject;
      note_carrier(state, link);
      continue;
    }
    const Pose pose = link_pose(state.link(link.carrier)) * link.in_carrier;
    if (equal(pose, link.pose)) continue;
    constexpr double kNoticed = 1e-6;  // m
    if ((pose.position - link.pose.position).norm() > kNoticed) wake_all(state);
    place_static(state, id, pose);
  }
}

void attach_static(WorldState& state, ObjectId id, ObjectId carrier) {
  Link& link = state.link(id);
  link.carrier = mover_of(state, carrier);
  if (link.carrier != kNoObject) {
    link.in_carrier = link_pose(state.link(link.carrier)).inverse() * link.pose;
    place_static(state, id, link.pose);
  }
  note_carrier(state, link);
}

void attach_statics(WorldState& state, const PlacedModel& model) {
  if (!model.description.is_static) return;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const std::string& carrier = model.description.links[i].carrier;
    if (!carrier.empty()) attach_static(state, model.links[i].object, moving_link(state, carrier));
  }
}

void transfer_places(StateArchive& archive, WorldState& state) {
  for (const auto& model : state.models) {
    for (Pose& sensor : model->sensors) archive(sensor);
    if (!model->description.is_static) continue;
    for (Link& link : model->links) {
      Pose pose = link.pose;
      ObjectId carrier = link.carrier;
      archive(pose, carrier, link.in_carrier);
      if (!archive.restores()) continue;
      if (!equal(pose, link.pose)) place_static(state, link.object, pose);
      if (carrier == link.carrier) continue;
      link.carrier = carrier;
      note_carrier(state, link);
    }
  }
}

void add_places(Fnv1a& hash, const WorldState& state) {
  for (const auto& model : state.models) {
    for (std::size_t i = 0; i < model->sensors.size(); ++i) {
      const Pose& pose = model->sensors[i];
      if (!equal(pose, model->described_sensors[i]->pose)) add_pose(hash, pose);
    }
  }
  for (const ObjectId id : state.moved_statics) {
    if (!state.tree().contains(id)) continue;
    const PlacedModel& model = state.model_of(id);
    const LinkDescription& described = model.description.links[state.tree().at(id).index];
    const Pose& pose = state.link(id).pose;
    if (!equal(pose, model.description.pose * described.pose)) add_pose(hash, pose);
  }
}

}  // namespace bubblesim
