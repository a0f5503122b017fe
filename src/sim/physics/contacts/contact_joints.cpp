// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_joints.hpp"

#include "physics/contacts/contact_cone.hpp"
#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

/// The resistance to rolling and spinning that ODE applied, by the place of the body after the substep: the torque is
/// used at rest only.
Vector3 torque_about_point(const FoundPair& pair, const FoundContact& point) {
  const Vector3 centre = to_vector(dBodyGetPosition(pair.first->link->body.get()));
  return to_vector(point.feedback.t1) - (to_vector(point.contact.geom.pos) - centre).cross(point.force);
}

}  // namespace

void join(World::State& state, const FoundPair& pair, FoundContact& point) {
  dJointID joint = dJointCreateContact(state.world.get(), state.contacts.get(), &point.contact);
  dJointAttach(joint, pair.first->link->body.get(), pair.second->link->body.get());
  dJointSetFeedback(joint, &point.feedback);
}

void take_force(const FoundPair& pair, FoundContact& point) {
  point.force = to_vector(point.feedback.f1);  // the first shape has a body
  if (point.contact.surface.rho > 0) point.torque = torque_about_point(pair, point);
}

void join_contacts(World::State& state, double step) {
  Recollection recollection(state.memory);
  for (const FoundPair& pair : state.found.pairs) {
    const int island = state.islands.of(pair.first->island);
    if (!state.islands.is_jointed(island)) continue;
    const RememberedPair* remembered = recollection.pair(pair);
    FoundContact* points = &state.found.points[pair.begin];
    limit_friction(pair, remembered, state.memory, step, state.islands.is_beyond_limit(island), points);
    for (int i = 0; i < pair.count; ++i) join(state, pair, points[i]);
  }
}

void gather_contacts(World::State& state) {
  for (const FoundPair& pair : state.found.pairs) {
    if (!state.islands.is_jointed(state.islands.of(pair.first->island))) continue;
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      take_force(pair, state.found.points[i]);
    }
  }
  remember_contacts(state.found, state.memory, state.memory_before);
}

}  // namespace bubblesim
