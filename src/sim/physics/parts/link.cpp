// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/link.hpp"

#include "physics/ode/ode_math.hpp"

namespace bubblesim {

Pose link_pose(const Link& link) {
  if (link.body == nullptr) return link.pose;
  Pose pose = body_pose(link.body.get());
  pose.position -= pose.orientation * link.centre_of_mass;
  return pose;
}

void set_inertia(dBodyID body, const LinkDescription& link, double mass) {
  const double factor = mass / link.mass;
  const Vector3 diagonal = link.inertia_diagonal * factor;
  const Vector3 products = link.inertia_products * factor;
  dMass made;
  dMassSetParameters(&made, mass, 0, 0, 0, diagonal.x(), diagonal.y(), diagonal.z(), products.x(), products.y(),
                     products.z());
  dBodySetMass(body, &made);
}

}  // namespace bubblesim
