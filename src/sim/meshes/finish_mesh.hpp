// SPDX-License-Identifier: BSD-3-Clause
// What each surface goes through before it is used: ODE and Embree take neither NaN nor triangles without an area.
#pragma once

#include <memory>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {

/// Leaves out triangles without an area and notes the box around the others. Throws MeshError when nothing is left, and
/// when a number is not finite or an index names no vertex.
std::shared_ptr<const TriangleMesh> finish_mesh(TriangleMesh mesh);

}  // namespace bubblesim
