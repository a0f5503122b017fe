// SPDX-License-Identifier: BSD-3-Clause
// Checks and cleans each surface before it is used: ODE and Embree accept neither NaN nor triangles without an area.
#pragma once

#include <memory>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {

/// Removes triangles without an area and computes the bounding box. Throws MeshError when nothing is left, a number is
/// not finite or an index is out of range.
std::shared_ptr<const TriangleMesh> finish_mesh(TriangleMesh mesh);

}  // namespace bubblesim
