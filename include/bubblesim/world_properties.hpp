// SPDX-License-Identifier: BSD-3-Clause
// Mass, friction and gravity, which may differ from those of the description until the world is reset.
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
};

}  // namespace bubblesim
