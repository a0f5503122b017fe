// SPDX-License-Identifier: BSD-3-Clause
// A collision shape in ODE.
#pragma once

#include <memory>
#include <string>

#include "bubblesim/scene.hpp"
#include "physics/convex/collision_mesh.hpp"
#include "physics/ode/ode_handles.hpp"
#include "physics/parts/link.hpp"

namespace bubblesim {

/// ODE's geom points back at it, see collider_of().
struct Collider {
  explicit Collider(const CollisionDescription& description)
      : name(description.name),
        geometry(description.geometry),
        given_surface(description.surface),
        in_link(description.pose) {}

  static constexpr int kNoModel = -1;

  ode::GeomHandle geom;
  const CollisionMesh* mesh = nullptr;  // null for shapes that ODE has itself
  const Link* link = nullptr;
  const std::string& name;
  const Geometry& geometry;
  const Surface& given_surface;          // of the description
  std::unique_ptr<Surface> own_surface;  // in its place, after a change
  const Pose& in_link;
  bool watched = false;          // observed by a contact sensor
  int model = kNoModel;          // index of its outermost model among the moving ones; kNoModel when it is static
  int number = 0;                // in the order of the models, moving ones first
  ObjectId carrier = kNoObject;  // the outermost model that carries its static link: they do not collide
  double model_mass = 0;         // kg, of its outermost model; infinite when it is static

  Surface& changing_surface() {
    if (own_surface == nullptr) own_surface = std::make_unique<Surface>(given_surface);
    return *own_surface;
  }
  const Surface& surface() const { return own_surface == nullptr ? given_surface : *own_surface; }
};

/// ODE's: below those for other models, above those for shapes of the same one.
constexpr unsigned kOwnBits = 16;
inline unsigned long collide_bits(const Surface& surface) {
  if (surface.collide_without_contact) return 0;
  const unsigned long own = surface.own_bitmask.value_or(surface.collide_bitmask);
  return surface.collide_bitmask | own << kOwnBits;
}

/// Whether two shapes collide by their bits. ODE skips pairs without any common bit before.
inline bool share_bits(const Collider& a, const Collider& b) {
  const unsigned long shared = dGeomGetCategoryBits(a.geom.get()) & dGeomGetCategoryBits(b.geom.get());
  const bool are_of_one = a.model == b.model && a.model != Collider::kNoModel;
  return (are_of_one ? shared >> kOwnBits : shared & ((1UL << kOwnBits) - 1)) != 0;
}

inline const Collider& collider_of(dGeomID geom) { return *static_cast<const Collider*>(dGeomGetData(geom)); }

}  // namespace bubblesim
