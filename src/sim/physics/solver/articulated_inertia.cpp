// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/articulated_inertia.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

BUBBLESIM_SIMD void eliminate(const LinkDofs* links, int count, const double* added, ArticulatedInertia* inertias,
                              TreeDof* dofs) {
  for (int i = count - 1; i >= 0; --i) {
    const LinkDofs& link = links[i];
    SpatialLanes* const columns = inertias[i].columns;
    for (int k = link.first + link.count - 1; k >= link.first; --k) {
      const SpatialLanes direction = dofs[k].direction;
      SpatialLanes resists;
      SpatialLanes by_slide;
      for (int j = 0; j < 3; ++j) {
        resists.add(direction.angular[j], columns[j]);
        by_slide.add(direction.linear[j], columns[j + 3]);
      }
      resists.add(by_slide);
      const double inverse = 1 / (resists.along(direction) + added[k]);
      const SpatialLanes passes{resists.angular * inverse, resists.linear * inverse};
      dofs[k].passes = passes;
      dofs[k].inverse_inertia = inverse;
      if (link.parent < 0 && k == link.first) break;  // nothing is before it
      for (int j = 0; j < 3; ++j) {
        columns[j].add(-resists.angular[j], passes);
        columns[j + 3].add(-resists.linear[j], passes);
      }
    }
    if (link.parent < 0) continue;
    for (int j = 0; j < 6; ++j) inertias[link.parent].columns[j].add(columns[j]);
  }
}

}  // namespace bubblesim
