// SPDX-License-Identifier: BSD-3-Clause
// Mass, friction, slip, belts and gravity, which may differ from those of the description until the world is reset.
#pragma once

#include "bubblesim/math.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

class WorldProperties : public WorldPart {
 public:
  using WorldPart::WorldPart;

  Vector3 gravity() const;
  /// Sets the gravity, m/s^2, until the world is reset. All bodies wake.
  void set_gravity(const Vector3& gravity);
  /// Mass of a link, or of all links of a model, kg. Throws WrongObject for other objects.
  double mass(ObjectId object) const;
  /// Sets the mass of a link, or scales those of all links of a model to this sum, until the world is reset. The
  /// moments of inertia are scaled likewise, the centres of mass stay. Throws WrongObject for static models.
  void set_mass(ObjectId object, double mass);
  /// Coulomb friction coefficient mu of the first collision of a link, or of a model's links. Throws WrongObject for
  /// objects without collisions.
  double friction(ObjectId object) const;
  /// Sets the friction coefficient, in all directions, of all collisions of a link or of a model's links, until the
  /// world is reset. A contact has the lower one of its two collisions.
  void set_friction(ObjectId object, double mu);
  /// Lets the contacts of all collisions of a link slip at a velocity that is proportional to the friction, m/s per N:
  /// `along` a direction in the link's frame, and `across` it, until the world is reset. 0 does not slip. The values of
  /// two surfaces that touch add up. Throws WrongObject for other objects and links without collisions; InvalidInput
  /// unless both are finite and not negative, and the direction has a length.
  void set_slip(ObjectId link, const Vector3& direction, double along, double across);
  /// Lets the surfaces of all collisions of a link run about an axis in the link's frame like a belt or a rim, until
  /// the world is reset: where its outward normal is n, a surface moves relative to the link at speed * axis x n, m/s,
  /// the axis being of length 1, and friction drives what touches it. So a track about y with a positive speed drives
  /// its vehicle along x. 0 stops it. Throws as set_slip() does; speeds may be negative.
  void set_belt(ObjectId link, const Vector3& axis, double speed);
};

}  // namespace bubblesim
