// SPDX-License-Identifier: BSD-3-Clause
// Which colour a surface has where a ray meets it: of its material, a checkerboard, or a picture on it.
#pragma once

#include <cstddef>

#include "rays/ray_scene.hpp"

namespace bubblesim {

struct SurfaceColor {
  Color diffuse;
  Color emissive;
};

/// Of what ray `i` of a traced packet hit, at `point` in the world.
SurfaceColor surface_color(const RayScene& scene, const rays::RayPacket& packet, std::size_t i, const Vector3& point);

}  // namespace bubblesim
