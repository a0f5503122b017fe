// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_geometry.hpp"

#include <sdf/Box.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

namespace bubblesim {

std::optional<Geometry> read_geometry(const sdf::Geometry& geometry) {
  if (const auto* box = geometry.BoxShape()) return Box{box->Size()};
  if (const auto* sphere = geometry.SphereShape()) return Sphere{sphere->Radius()};
  if (const auto* cylinder = geometry.CylinderShape()) return Cylinder{cylinder->Radius(), cylinder->Length()};
  if (const auto* plane = geometry.PlaneShape()) return Plane{plane->Normal()};
  return std::nullopt;
}

}  // namespace bubblesim
