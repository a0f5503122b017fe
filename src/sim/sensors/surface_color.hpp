// SPDX-License-Identifier: BSD-3-Clause
// The colours and normals of surfaces where rays hit them: from materials, checkerboards, textures and smooth meshes.
#pragma once

#include "rays/hit_groups.hpp"
#include "rays/ray_scene.hpp"
#include "sensors/shade_lanes.hpp"

namespace bubblesim {

/// The surfaces at the ends of a packet's rays; undefined for rays without a hit.
struct Surfaces {
  lanes::Places places;    // world
  lanes::Normals normals;  // world
  lanes::Colors diffuse;
  lanes::Colors emissive;
};

void find_surfaces(const RayScene& scene, const rays::RayPacket& packet, const rays::HitGroups& groups,
                   Surfaces& surfaces);

}  // namespace bubblesim
