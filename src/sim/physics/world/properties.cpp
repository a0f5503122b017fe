// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/world_properties.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "scene/fnv1a.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kMaxMass = 1e6;    // kg, as in descriptions
constexpr double kMostSlip = 1e12;  // m/s per N

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
void with_colliders(State& state, ObjectId id, const char* what, const Use& use) {
  for (const ObjectId link : links_of(state, id, what)) {
    for (auto& collider : state.model_of(id).colliders) {
      if (collider.link->object == link) use(collider);
    }
  }
}

/// Throws unless it is a link with collisions, and the direction has a length.
void check_surface_of_link(const WorldState& state, ObjectId link, const std::string& what, const Vector3& direction) {
  if (state.tree().at(link).kind != ObjectKind::kLink) {
    throw WrongObject(state.shown(link) + " is not a link: the collisions of links have a " + what);
  }
  if (!within(direction, kMaxSize) || !(direction.norm() > 0)) {
    throw InvalidInput(state.shown(link) + ": the direction " + text(direction) + " of the " + what +
                       " is not usable: it must be finite and not zero");
  }
  bool any = false;
  with_colliders(state, link, "surface", [&](const Collider&) { any = true; });
  if (!any) throw WrongObject(state.shown(link) + " has no collisions that could have a " + what);
}

/// What may differ from the description of a surface.
struct ChangedSurface {
  std::uint32_t shape = 0;  // Collider::number
  double mu = 0;
  std::optional<double> mu2;
  Vector3 fdir1;
  double slip1 = 0;
  double slip2 = 0;
  Vector3 belt;

  void transfer(StateArchive& archive) { archive(shape, mu, mu2, fdir1, slip1, slip2, belt); }
  bool is_usable() const {
    const auto is_slip = [](double slip) { return slip >= 0 && slip <= kMostSlip; };
    return mu >= 0 && mu2.value_or(0) >= 0 && within(fdir1, 2) && is_slip(slip1) && is_slip(slip2) &&
           within(belt, kMaxSpeed);
  }
};

ChangedSurface change_of(const Collider& collider) {
  const Surface& own = *collider.own_surface;
  return {static_cast<std::uint32_t>(collider.number), own.mu, own.mu2, own.fdir1, own.slip1, own.slip2, own.belt};
}

void apply(const ChangedSurface& change, Collider& collider) {
  Surface& own = collider.changing_surface();
  own.mu = change.mu;
  own.mu2 = change.mu2;
  own.fdir1 = change.fdir1;
  own.slip1 = change.slip1;
  own.slip2 = change.slip2;
  own.belt = change.belt;
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

void transfer_surfaces(StateArchive& archive, WorldState& state) {
  std::vector<ChangedSurface> changes;
  for (Collider* collider : state.colliders) {
    if (collider->own_surface == nullptr) continue;
    if (archive.restores()) {
      collider->own_surface.reset();
    } else {
      changes.push_back(change_of(*collider));
    }
  }
  archive(changes);
  if (!archive.restores()) return;
  for (const ChangedSurface& change : changes) {
    if (change.shape >= state.colliders.size() || !change.is_usable()) {
      throw InvalidInput("the saved state has a friction that is not usable");
    }
    apply(change, *state.colliders[change.shape]);
  }
}

void add_surfaces(Fnv1a& hash, const WorldState& state) {
  for (const Collider* collider : state.colliders) {
    if (collider->own_surface == nullptr) continue;
    const ChangedSurface change = change_of(*collider);
    hash.add(static_cast<std::uint64_t>(change.shape));
    const Vector3& along = change.fdir1;
    const Vector3& belt = change.belt;
    const double values[] = {change.mu,    change.mu2.value_or(change.mu),
                             along.x(),    along.y(),
                             along.z(),    change.slip1,
                             change.slip2, belt.x(),
                             belt.y(),     belt.z()};
    hash.add(values, 10);
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
  with_colliders(state(), object, "friction",
                 [&](const Collider& collider) { first = first == nullptr ? &collider : first; });
  if (first == nullptr) throw WrongObject(state().shown(object) + " has no collisions, and therefore no friction");
  return first->surface().mu;
}

void WorldProperties::set_friction(ObjectId object, double mu) {
  friction(object);
  if (!(mu >= 0)) {
    throw InvalidInput(state().shown(object) + ": the friction " + text(mu) + " is not usable: it must be 0 or more");
  }
  with_colliders(state(), object, "friction", [&](Collider& collider) {
    collider.changing_surface().mu = mu;
    collider.changing_surface().mu2.reset();
    dBodyID body = collider.link->body.get();
    if (body != nullptr) command(state().moving, body);
  });
  if (state().model_of(object).description.is_static) wake_all(state());
}

void WorldProperties::set_slip(ObjectId link, const Vector3& direction, double along, double across) {
  check_surface_of_link(state(), link, "slip", direction);
  for (const double slip : {along, across}) {
    if (slip >= 0 && slip <= kMostSlip) continue;
    throw InvalidInput(state().shown(link) + ": the slip " + text(slip) +
                       " m/s per N is not usable: it must be from 0 to 1e12");
  }
  with_colliders(state(), link, "slip", [&](Collider& collider) {
    Surface& own = collider.changing_surface();
    own.fdir1 = collider.in_link.orientation.conjugate() * direction.normalized();
    own.slip1 = along;
    own.slip2 = across;
  });
}

void WorldProperties::set_belt(ObjectId link, const Vector3& axis, double speed) {
  check_surface_of_link(state(), link, "belt", axis);
  if (!within(speed, kMaxSpeed)) {
    throw InvalidInput(state().shown(link) + ": the speed " + text(speed) +
                       " m/s of the belt is not usable: it must be finite and at most 1e6");
  }
  with_colliders(state(), link, "belt", [&](Collider& collider) {
    const Vector3 belt = collider.in_link.orientation.conjugate() * axis.normalized() * speed;
    if (belt == collider.surface().belt) return;
    collider.changing_surface().belt = belt;
    dBodyID body = collider.link->body.get();
    if (body != nullptr) command(state().moving, body);
    if (body == nullptr) wake_all(state());  // of what it carries
  });
}

}  // namespace bubblesim
