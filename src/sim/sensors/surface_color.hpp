// SPDX-License-Identifier: BSD-3-Clause
// The colour of a surface where a ray hits it: from its material, checkerboard or texture.
#pragma once

#include <cstddef>

#include "rays/ray_scene.hpp"

namespace bubblesim {

struct SurfaceColor {
  Color diffuse;
  Color emissive;
};

/// The colour of the surface that ray `i` of a traced packet hit, at `point` in the world.
SurfaceColor surface_color(const RayScene& scene, const rays::RayPacket& packet, std::size_t i, const Vector3& point);

}  // namespace bubblesim
