// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/round_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

constexpr double kSide = 0.5;  // cosine between a cylinder's axis and the normal, above which it is not its side

/// The point on the axis of a round shape beside `position`.
Vector3 on_axis(dGeomID geom, double length, const Vector3& position) {
  const Vector3 centre = to_vector(dGeomGetPosition(geom));
  const dReal* r = dGeomGetRotation(geom);
  const Vector3 axis(r[2], r[6], r[10]);
  return centre + axis * std::clamp(axis.dot(position - centre), -length / 2, length / 2);
}

/// The height along `outwards` of the surface of a shape beside a position; none if it is not round there.
std::optional<double> surface_height(dGeomID geom, const Vector3& outwards, const Vector3& position) {
  dReal radius = 0;
  dReal length = 0;
  switch (dGeomGetClass(geom)) {
    case dSphereClass:
      return outwards.dot(to_vector(dGeomGetPosition(geom))) + dGeomSphereGetRadius(geom);
    case dCapsuleClass:
      dGeomCapsuleGetParams(geom, &radius, &length);
      return outwards.dot(on_axis(geom, length, position)) + radius;
    case dCylinderClass: {
      dGeomCylinderGetParams(geom, &radius, &length);
      const dReal* r = dGeomGetRotation(geom);
      const double along = outwards.dot(Vector3(r[2], r[6], r[10]));
      if (std::abs(along) > kSide) return std::nullopt;
      return outwards.dot(on_axis(geom, length, position)) + radius * std::sqrt(1 - along * along);
    }
    default:
      return std::nullopt;
  }
}

bool is_plane(dGeomID geom) { return dGeomGetClass(geom) == dPlaneClass; }

}  // namespace

void place_on_round_shape(dGeomID first, dGeomID second, int count, dContactGeom* points) {
  if (is_plane(first) || is_plane(second)) return;
  for (dContactGeom* point = points; point != points + count; ++point) {
    const Vector3 normal = to_vector(point->normal);  // into the first shape
    const Vector3 position = to_vector(point->pos);
    const std::optional<double> of_first = surface_height(first, -normal, position);
    const std::optional<double> of_second = surface_height(second, normal, position);
    if (of_first.has_value() == of_second.has_value()) continue;
    const double height = of_first ? -*of_first : *of_second;
    const Vector3 moved = position + normal * (height - normal.dot(position));
    std::copy_n(moved.data(), 3, point->pos);
  }
}

}  // namespace bubblesim
