// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/collision.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "physics/contacts/contact_points.hpp"
#include "physics/contacts/contact_thinning.hpp"
#include "physics/contacts/round_contacts.hpp"
#include "physics/contacts/surface_pair.hpp"
#include "physics/ode/constraint_defaults.hpp"
#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

static_assert(Islands::kNone == Collider::kNoModel);

Vector3 turned(dGeomID geom, const Vector3& direction) {
  if (dGeomGetClass(geom) == dPlaneClass) {  // it has no quaternion
    const Collider& plane = collider_of(geom);
    return link_pose(*plane.link).orientation * (plane.in_link.orientation * direction);
  }
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  return to_quaternion(q) * direction;
}

/// Sets the friction direction, projected on the contact plane; does nothing when it is normal to the plane.
void direct(const Vector3& wanted, dContact& contact) {
  const dReal* n = contact.geom.normal;
  const Vector3 normal(n[0], n[1], n[2]);
  Vector3 along = wanted - normal * wanted.dot(normal);
  if (along.norm() < 1e-3 * wanted.norm()) return;
  along.normalize();
  contact.surface.mode |= dContactFDir1;
  for (unsigned i = 0; i < 3; ++i) contact.fdir1[i] = along[i];
}

/// Makes rigid shapes sink to their rest depth, with a speed that decreases near it.
void sink(double depth, const SurfacePair& pair, double step, dContact& contact) {
  const double left = pair.sink - kSurfaceLayer - depth;
  if (pair.sink_speed == 0 || left <= 0) return;
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = -std::min(pair.sink_speed, kErrorReduction * left / step);
}

/// Lets friction drive a contact to the velocity at which the surfaces run on their shapes. The normal points into the
/// first shape.
void run_belts(const Vector3& first_belt, const Vector3& second_belt, dContact& contact) {
  const Vector3 normal = to_vector(contact.geom.normal);
  const Vector3 wanted = first_belt.cross(normal) + second_belt.cross(normal);  // of the first body to the second one
  if (wanted == Vector3::Zero()) return;
  if ((contact.surface.mode & dContactFDir1) == 0) direct(wanted, contact);
  const Vector3 first = to_vector(contact.fdir1);
  contact.surface.mode |= dContactMotion1 | dContactMotion2;
  contact.surface.motion1 = wanted.dot(first);
  contact.surface.motion2 = wanted.dot(normal.cross(first));
}

/// Whether joints or a motor act on the links of a model.
bool is_jointed(const PlacedModel& model) { return !model.joints.empty() || model.planar_motor.exists(); }

void touch(void* data, dGeomID first, dGeomID second) {
  auto& substep = *static_cast<Substep*>(data);
  Contacts& contacts = substep.contacts;
  const double step = substep.duration;
  if (collider_of(second).number < collider_of(first).number) std::swap(first, second);
  const Collider& a = collider_of(first);
  const Collider& b = collider_of(second);
  if (a.link == b.link || !share_bits(a, b)) return;
  // Static shapes come second: those that move with a model do not collide with it.
  if (b.carrier != kNoObject && a.model != Collider::kNoModel && substep.moving.at(a.model).object == b.carrier) {
    return;
  }
  dBodyID body_a = dGeomGetBody(first);
  dBodyID body_b = dGeomGetBody(second);
  if (body_a != nullptr && body_b != nullptr && dAreConnectedExcluding(body_a, body_b, dJointTypeContact) != 0) return;
  if (are_held(substep.holds, *a.link, *b.link)) return;

  ContactPoints points;
  const Surface& surface_a = a.surface();
  const Surface& surface_b = b.surface();
  const int most = std::max(std::min(surface_a.max_contacts, surface_b.max_contacts), 1);
  const int count = std::min(find_contact_points(first, second, points), most);
  if (count == 0) return;
  place_on_round_shape(first, second, count, points.data());
  contacts.islands.touch(a.model, b.model, count);
  const bool has_belt = surface_a.belt != Vector3::Zero() || surface_b.belt != Vector3::Zero();
  if (has_belt) contacts.islands.join(a.model, b.model);  // only the solvers of joints know belts
  contacts.found.pairs.push_back({&a, &b, contacts.found.points.size(), count});
  SurfacePair pair = combine(surface_a, surface_b, step);
  share_load(1 / a.model_mass + 1 / b.model_mass, step, pair);
  for (int i = 0; i < count; ++i) {
    const dContactGeom& place = points[static_cast<std::size_t>(i)];
    dContact& contact = contacts.found.points.emplace_back(pair.ode, place, pair.has_own_correction).contact;
    if (pair.torsion_by_depth > 0) {
      const double patch = pair.torsion_by_depth * std::sqrt(std::max(contact.geom.depth, 0.0));
      contact.surface.rhoN = std::max(contact.surface.rhoN, patch);
    }
    sink(contact.geom.depth, pair, step, contact);
    contact.geom.depth = kSurfaceLayer + std::min(contact.geom.depth - pair.sink, pair.max_depth);
    if (pair.directed != nullptr) {
      direct(turned(pair.directed == &surface_a ? first : second, pair.directed->fdir1), contact);
    }
    if (has_belt) run_belts(turned(first, surface_a.belt), turned(second, surface_b.belt), contact);
  }
}

/// Pairs come in an order that depends on the state only, not on what the search went through before.
void sort(std::vector<FoundPair>& pairs) {
  const auto before = [](const FoundPair& a, const FoundPair& b) {
    return std::make_pair(a.first->number, a.second->number) < std::make_pair(b.first->number, b.second->number);
  };
  if (!std::is_sorted(pairs.begin(), pairs.end(), before)) std::sort(pairs.begin(), pairs.end(), before);
}

void set_friction(double coefficient, const FoundPair& pair, std::vector<FoundContact>& points) {
  for (int i = 0; i < pair.count; ++i) {
    dSurfaceParameters& surface = points[pair.begin + static_cast<std::size_t>(i)].contact.surface;
    surface.mu = surface.mu2 = bounded_friction(coefficient);
  }
}

/// Drops the pairs that the filter does not let resist, and gives others the friction that it answers. It may move
/// bodies, so it is asked after the search.
void apply_filter(Contacts& contacts) {
  const auto is_refused = [&](const FoundPair& pair) {
    const ContactAnswer answer = contacts.filter(pair.first->link->object, pair.second->link->object);
    if (answer.resist && answer.friction) set_friction(*answer.friction, pair, contacts.found.points);
    return !answer.resist;
  };
  std::vector<FoundPair>& pairs = contacts.found.pairs;
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_refused), pairs.end());
}

void touch_spaces(void* data, dGeomID first, dGeomID second) { dSpaceCollide2(first, second, data, touch); }

dGeomID as_geom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

}  // namespace

void search_contacts(Substep& substep) {
  const MovingModels& moving = substep.moving;
  Islands& islands = substep.contacts.islands;
  const Spaces& spaces = substep.spaces;
  dJointGroupEmpty(substep.ode.contact_joints.get());
  substep.contacts.found.clear();
  islands.clear(moving.all.size());
  for (const PlacedModel* model : moving.awake) islands.add(model->number, is_jointed(*model));
  for (const Hold& hold : substep.holds) {  // of models that sleep or are awake together
    if (!hold.model->rest.is_awake()) continue;
    islands.join(hold.model->number, hold.holder_model == nullptr ? Islands::kNone : hold.holder_model->number);
  }
  // Collide models with each other; shapes of one model collide only with self_collide.
  if (moving.awake.size() > 1) dSpaceCollide(spaces.movers.get(), &substep, touch_spaces);
  std::vector<NearShapes>& near = substep.contacts.near;
  near.resize(moving.all.size());
  for (const PlacedModel* model : moving.awake) {
    dSpaceID space = model->space.get();
    if (model->description.self_collide) dSpaceCollide(space, &substep, touch);
    dSpaceCollide2(as_geom(space), as_geom(spaces.planes.get()), &substep, touch);
    const Eigen::AlignedBox3d box = box_of(as_geom(space));
    for (const NearShapes::Shape& shape : near[static_cast<std::size_t>(model->number)].around(box, spaces)) {
      if (shape.box.intersects(box)) dSpaceCollide2(as_geom(space), shape.geom, &substep, touch);
    }
  }
}

void order_contacts(Contacts& contacts) {
  sort(contacts.found.pairs);
  if (contacts.filter) apply_filter(contacts);
  if (contacts.islands.may_be_beyond_limit()) thin_out(contacts.found, contacts.islands);
}

}  // namespace bubblesim
