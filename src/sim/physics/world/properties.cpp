// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/world_properties.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kMaxMass = 1e6;  // kg, as in descriptions

/// The link itself, or those of the model.
std::vector<ObjectId> links_of(const WorldState& state, ObjectId id, const char* what) {
  const Object& object = state.tree().at(id);
  if (object.kind == ObjectKind::kLink) return {id};
  if (object.kind == ObjectKind::kModel) return state.tree().parts(id, ObjectKind::kLink);
  throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) + ": it has no " + what +
                    "; links and models have it");
}

/// Calls `use` with the collisions of an object.
template <class State, class Use>
void with_colliders(State& state, ObjectId id, const Use& use) {
  for (const ObjectId link : links_of(state, id, "friction")) {
    for (auto& collider : state.model_of(id).colliders) {
      if (collider.link->object == link) use(collider);
    }
  }
}

struct ChangedFriction {
  std::uint32_t shape = 0;  // Collider::number
  double mu = 0;

  void transfer(StateArchive& archive) { archive(shape, mu); }
};

void apply_friction(Collider& collider, double mu) {
  auto own = std::make_unique<Surface>(collider.given_surface);
  own->mu = mu;
  own->mu2.reset();
  collider.own_surface = std::move(own);
}

}  // namespace

void apply_gravity(WorldState& state, const Vector3& gravity) {
  state.gravity = gravity;
  dWorldSetGravity(state.ode.id(), gravity.x(), gravity.y(), gravity.z());
  for (PlacedModel* model : state.moving.all) {
    model->rest.may_sleep = model->prepared->is_prop && gravity != Vector3::Zero();
  }
}

void transfer_masses(StateArchive& archive, PlacedModel& model) {
  for (Link& link : model.links) {
    double mass = link.mass;
    archive(mass);
    if (mass == link.mass) continue;
    if (!(mass > 0 && mass <= kMaxMass)) throw InvalidInput("the saved state has a mass that is not usable");
    apply_mass(model, link, mass);
  }
}

void transfer_frictions(StateArchive& archive, WorldState& state) {
  std::vector<ChangedFriction> changes;
  for (Collider* collider : state.colliders) {
    if (collider->own_surface == nullptr) continue;
    if (archive.restores()) {
      collider->own_surface.reset();
    } else {
      changes.push_back({static_cast<std::uint32_t>(collider->number), collider->own_surface->mu});
    }
  }
  archive(changes);
  if (!archive.restores()) return;
  for (const ChangedFriction& change : changes) {
    if (change.shape >= state.colliders.size() || !(change.mu >= 0)) {
      throw InvalidInput("the saved state has a friction that is not usable");
    }
    apply_friction(*state.colliders[change.shape], change.mu);
  }
}

Vector3 WorldProperties::gravity() const { return state().gravity; }

void WorldProperties::set_gravity(const Vector3& gravity) {
  if (!within(gravity, kMaxGravity)) {
    throw InvalidInput("the gravity " + text(gravity) + " is not usable: it must be finite and at most 1e4 m/s^2");
  }
  const Vector3 before = state().gravity.normalized();
  wake_all(state());
  apply_gravity(state(), gravity);
  for (PlacedModel* model : state().moving.all) {
    for (Link& link : model->links) link.rest_pose = body_pose(link.body.get());
  }
  if (gravity.normalized().dot(before) > 1 - 1e-9) return;
  state().bottom = 0;
  lower_bottom(state());
}

double WorldProperties::mass(ObjectId object) const {
  double mass = 0;
  const ModelDescription& model = state().model_of(object).description;
  for (const ObjectId id : links_of(state(), object, "mass")) {
    mass += model.is_static ? model.links[state().tree().at(id).index].mass : state().link(id).mass;
  }
  return mass;
}

void WorldProperties::set_mass(ObjectId object, double mass) {
  const std::vector<ObjectId> links = links_of(state(), object, "mass");
  PlacedModel& model = state().model_of(object);
  if (model.description.is_static) {
    throw WrongObject(state().shown(object) + " is static: its mass has no effect");
  }
  if (!(mass > 0 && mass <= kMaxMass)) {
    throw InvalidInput(state().shown(object) + ": the mass " + text(mass) +
                       " kg is not usable: it must be more than 0 and at most 1e6 kg");
  }
  const double before = this->mass(object);
  for (const ObjectId id : links) {
    Link& link = model.links[state().tree().at(id).index];
    apply_mass(model, link, links.size() == 1 ? mass : link.mass * (mass / before));
    command(state().moving, link.body.get());
  }
}

double WorldProperties::friction(ObjectId object) const {
  const Collider* first = nullptr;
  with_colliders(state(), object, [&](const Collider& collider) { first = first == nullptr ? &collider : first; });
  if (first == nullptr) throw WrongObject(state().shown(object) + " has no collisions, and therefore no friction");
  return first->surface().mu;
}

void WorldProperties::set_friction(ObjectId object, double mu) {
  friction(object);
  if (!(mu >= 0)) {
    throw InvalidInput(state().shown(object) + ": the friction " + text(mu) + " is not usable: it must be 0 or more");
  }
  with_colliders(state(), object, [&](Collider& collider) {
    apply_friction(collider, mu);
    dBodyID body = collider.link->body.get();
    if (body != nullptr) command(state().moving, body);
  });
  if (state().model_of(object).description.is_static) wake_all(state());
}

}  // namespace bubblesim
