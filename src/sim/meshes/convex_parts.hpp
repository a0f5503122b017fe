// SPDX-License-Identifier: BSD-3-Clause
// Divides a concave mesh into convex parts.
#pragma once

#include <vector>

#include "meshes/convex_hull.hpp"

namespace bubblesim {

/// Hulls that together fill the mesh, and the volume that they add to it.
struct ConvexParts {
  std::vector<Hull> hulls;
  double excess = 0;  ///< volume of the hulls less that of the mesh, as a fraction of the latter
};

/// Cuts the mesh by planes across its axes until the hulls of the pieces add little volume, or there are `most` of
/// them. The surface must be closed; otherwise the excess is infinite.
ConvexParts convex_parts(const TriangleMesh& mesh, std::size_t most);

}  // namespace bubblesim
