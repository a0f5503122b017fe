// SPDX-License-Identifier: BSD-3-Clause
// Divides a concave mesh into convex parts.
#pragma once

#include <cstddef>
#include <vector>

#include "meshes/convex_hull.hpp"

namespace bubblesim {

/// Hulls that together fill the mesh, and the volume that they add to it.
struct ConvexParts {
  std::vector<Hull> hulls;
  double excess = 0;  ///< volume of the hulls less that of the mesh, as a fraction of the latter
};

struct PartLimits {
  std::size_t usual = 16;  ///< number of parts
  double excess = 0.05;    ///< with which the parts fit the mesh
  std::size_t most = 64;   ///< number of parts where the usual number does not fit
};

/// Cuts the mesh by planes across its axes until the hulls of the pieces add little volume, or there are as many as the
/// limits allow. The surface must be closed; otherwise the excess is infinite.
ConvexParts convex_parts(const TriangleMesh& mesh, const PartLimits& limits = {});

}  // namespace bubblesim
