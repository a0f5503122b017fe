// SPDX-License-Identifier: BSD-3-Clause
// Collision detection and contact joints.
#include <algorithm>

#include "physics/contact_defaults.hpp"
#include "physics/contact_points.hpp"
#include "physics/surface_pair.hpp"
#include "physics/world_state.hpp"

namespace bubblesim {
namespace {

struct Search {
  World::State& state;
  double step;  // s
};

Vector3 turned(dGeomID geom, const Vector3& direction) {
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  return Quaternion(q[0], q[1], q[2], q[3]).RotateVector(direction);
}

/// Sets the friction direction, projected on the contact plane; does nothing when it is normal to the plane.
void direct(const Vector3& wanted, dContact& contact) {
  const dReal* n = contact.geom.normal;
  const Vector3 normal(n[0], n[1], n[2]);
  Vector3 along = wanted - normal * wanted.Dot(normal);
  if (along.Length() < 1e-3 * wanted.Length()) return;
  along.Normalize();
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

/// Whether a body sleeps. Null is the static world.
bool sleeps(dBodyID body) { return body == nullptr || dBodyIsEnabled(body) == 0; }

bool sleeps(const PlacedModel& model) {
  return std::all_of(model.links.begin(), model.links.end(), [](const Link& link) { return sleeps(link.body.get()); });
}

void touch(void* data, dGeomID first, dGeomID second) {
  auto& [state, step] = *static_cast<Search*>(data);
  const auto& a = *static_cast<const Collider*>(dGeomGetData(first));
  const auto& b = *static_cast<const Collider*>(dGeomGetData(second));
  if (a.link == b.link) return;
  dBodyID body_a = dGeomGetBody(first);
  dBodyID body_b = dGeomGetBody(second);
  if (sleeps(body_a) && sleeps(body_b)) return;
  if (body_a != nullptr && body_b != nullptr && dAreConnectedExcluding(body_a, body_b, dJointTypeContact) != 0) return;

  ContactPoints found;
  const int most = std::max(std::min(a.surface.max_contacts, b.surface.max_contacts), 1);
  const int count = std::min(find_contact_points(first, second, found), most);
  if (count == 0) return;
  state.islands.touch(a.island, b.island, count);
  const SurfacePair pair = combine(a.surface, b.surface, step);
  dContact contact;  // fdir1 is used only with its bit of the mode
  for (int i = 0; i < count; ++i) {
    contact.surface = pair.ode;
    contact.geom = found[static_cast<std::size_t>(i)];
    sink(contact.geom.depth, pair, step, contact);
    contact.geom.depth = kSurfaceLayer + std::min(contact.geom.depth - pair.sink, pair.max_depth);
    if (pair.directed != nullptr) {
      direct(turned(pair.directed == &a.surface ? first : second, pair.directed->fdir1), contact);
    }
    state.found.push_back({&a, &b, contact});
  }
}

void join(World::State& state, const FoundContact& found) {
  const Collider& a = *found.first;
  const Collider& b = *found.second;
  dJointID joint = dJointCreateContact(state.world.get(), state.contacts.get(), &found.contact);
  dJointAttach(joint, a.link->body.get(), b.link->body.get());
  if (a.watched || b.watched) watch_contact(state, joint, a, b, found.contact.geom);
}

void touch_spaces(void* data, dGeomID first, dGeomID second) { dSpaceCollide2(first, second, data, touch); }

dGeomID as_geom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

}  // namespace

void find_contacts(World::State& state, double step) {
  dJointGroupEmpty(state.contacts.get());
  state.found.clear();
  state.islands.clear(state.moving.size());
  Search search{state, step};
  // Collide models with each other; shapes of one model collide only with self_collide.
  if (state.moving.size() > 1) dSpaceCollide(state.movers.get(), &search, touch_spaces);
  for (const PlacedModel* model : state.moving) {
    dSpaceID space = model->space.get();
    if (sleeps(*model)) continue;
    if (model->description.self_collide) dSpaceCollide(space, &search, touch);
    dSpaceCollide2(as_geom(space), as_geom(state.statics.get()), &search, touch);
    dSpaceCollide2(as_geom(space), as_geom(state.planes.get()), &search, touch);
  }
  if (state.islands.most_contacts() > Islands::kFew) thin_out(state.found, state.islands);
  for (const FoundContact& found : state.found) join(state, found);
}

}  // namespace bubblesim
