// SPDX-License-Identifier: BSD-3-Clause
// What touches what, and the contact joints that come of it.
#include <algorithm>

#include "contact_points.hpp"
#include "world_state.hpp"

namespace bubblesim {
namespace {

void touch(void* data, dGeomID first, dGeomID second) {
  auto& state = *static_cast<World::State*>(data);
  const auto& a = *static_cast<const Collider*>(dGeomGetData(first));
  const auto& b = *static_cast<const Collider*>(dGeomGetData(second));
  if ((a.surface.collide_bitmask & b.surface.collide_bitmask) == 0 || a.link == b.link) return;
  dBodyID body_a = dGeomGetBody(first);
  dBodyID body_b = dGeomGetBody(second);
  if (body_a != nullptr && body_b != nullptr && dAreConnectedExcluding(body_a, body_b, dJointTypeContact) != 0) return;

  ContactPoints found;
  const int count = find_contact_points(first, second, found);
  dContact contact{};
  // Approximation 1 makes mu a coefficient; without it ODE takes mu as a force and wheels drift outwards.
  contact.surface.mode = dContactApprox1;
  contact.surface.mu = std::min(a.surface.mu, b.surface.mu);
  for (int i = 0; i < count; ++i) {
    contact.geom = found[static_cast<std::size_t>(i)];
    dJointID joint = dJointCreateContact(state.world.get(), state.contacts.get(), &contact);
    dJointAttach(joint, body_a, body_b);
    if (a.watched || b.watched) watch_contact(state, joint, a, b, contact.geom);
  }
}

void touch_spaces(void* data, dGeomID first, dGeomID second) { dSpaceCollide2(first, second, data, touch); }

dGeomID as_geom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

}  // namespace

void find_contacts(World::State& state) {
  dJointGroupEmpty(state.contacts.get());
  // Models against each other; the shapes of one model do not meet, unless it says so.
  dSpaceCollide(state.movers.get(), &state, touch_spaces);
  for (const auto& [id, model] : state.models) {
    dSpaceID space = model.space.get();
    if (space == nullptr) continue;
    if (model.description.self_collide) dSpaceCollide(space, &state, touch);
    dSpaceCollide2(as_geom(space), as_geom(state.statics.get()), &state, touch);
    dSpaceCollide2(as_geom(space), as_geom(state.planes.get()), &state, touch);
  }
}

}  // namespace bubblesim
