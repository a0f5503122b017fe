// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_joints.hpp"

#include "physics/contacts/contact_cone.hpp"
#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

/// The resistance to rolling and spinning that ODE applied, by the place of the body after the substep: the torque is
/// used at rest only.
Vector3 torque_about_point(const FoundPair& pair, const FoundContact& point) {
  const Vector3 centre = to_vector(dBodyGetPosition(pair.first->link->body.get()));
  return to_vector(point.feedback.t1) - (to_vector(point.contact.geom.pos) - centre).cross(point.force);
}

}  // namespace

void join(OdeWorld& ode, const FoundPair& pair, FoundContact& point) {
  dJointID joint = dJointCreateContact(ode.id(), ode.contact_joints.get(), &point.contact);
  dJointAttach(joint, pair.first->link->body.get(), pair.second->link->body.get());
  dJointSetFeedback(joint, &point.feedback);
}

void take_force(const FoundPair& pair, FoundContact& point) {
  point.force = to_vector(point.feedback.f1);  // the first shape has a body
  if (point.contact.surface.rho > 0) point.torque = torque_about_point(pair, point);
}

void join_holds(Substep& substep) {
  Islands& islands = substep.contacts.islands;
  for (const Hold& hold : substep.holds) {
    if (!hold.model->rest.is_awake() || islands.is_by_trees(islands.of(hold.model->number))) continue;
    join(substep.ode.id(), substep.ode.contact_joints.get(), hold);
  }
}

void join_contacts(Substep& substep) {
  Contacts& contacts = substep.contacts;
  join_holds(substep);
  ContactLookup lookup(contacts.memory);
  for (const FoundPair& pair : contacts.found.pairs) {
    const int island = contacts.islands.of(pair.first->model);
    if (!contacts.islands.is_jointed(island) || contacts.islands.is_by_trees(island)) continue;
    const RememberedPair* remembered = lookup.pair(pair);
    FoundContact* points = &contacts.found.points[pair.begin];
    limit_friction(pair, remembered, contacts.memory, substep.duration, contacts.islands.is_beyond_limit(island),
                   points);
    for (int i = 0; i < pair.count; ++i) join(substep.ode, pair, points[i]);
  }
}

void gather_contacts(Contacts& contacts) {
  for (const FoundPair& pair : contacts.found.pairs) {
    const int island = contacts.islands.of(pair.first->model);
    if (!contacts.islands.is_jointed(island) || contacts.islands.is_by_trees(island)) continue;
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      take_force(pair, contacts.found.points[i]);
    }
  }
  remember_contacts(contacts.found, contacts.memory, contacts.memory_before);
}

}  // namespace bubblesim
