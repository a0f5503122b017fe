// SPDX-License-Identifier: BSD-3-Clause
#include "physics/joints/point_velocity_constraint.hpp"

#include "validation/limits.hpp"

namespace bubblesim {

void PointVelocityConstraint::hold(dBodyID first, dBodyID second, const Vector3& point, const Vector3& direction,
                                   double velocity) {
  // The direction is held by the unlimited friction of a contact. The contact's normal, at right angles to it, is
  // inactive: its target velocity is beyond the speed limit.
  const dVector3 along = {direction.x(), direction.y(), direction.z()};
  dVector3 normal;
  dVector3 unused;
  dPlaneSpace(along, normal, unused);
  dContact contact{};
  contact.surface.mode = dContactFDir1 | dContactMu2 | dContactMotion1 | dContactMotionN;
  contact.surface.mu = dInfinity;
  contact.surface.mu2 = 0;
  contact.surface.motion1 = velocity;
  contact.surface.motionN = -kMaxSpeed;
  for (unsigned i = 0; i < 3; ++i) {
    contact.geom.pos[i] = point[i];
    contact.geom.normal[i] = normal[i];
    contact.fdir1[i] = along[i];
  }
  contact_.reset(dJointCreateContact(world_, nullptr, &contact));
  dJointAttach(contact_.get(), first, second);
}

}  // namespace bubblesim
