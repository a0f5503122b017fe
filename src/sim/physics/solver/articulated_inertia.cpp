// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/articulated_inertia.hpp"

#include "scene/simd.hpp"

namespace bubblesim {

namespace {

/// Four numbers, one of them replaced.
template <int lane>
BUBBLESIM_INLINE Four with(const Four& four, double number) {
  return Four{lane == 0 ? number : four[0], lane == 1 ? number : four[1], lane == 2 ? number : four[2], four[3]};
}

/// One sweep of Gauss and Jordan.
template <int k>
BUBBLESIM_INLINE void sweep(const double* added, SpatialLanes* columns, TreeDof* dofs) {
  constexpr int lane = k % 3;
  const auto set = [](SpatialLanes& of, double number) {
    Four& half = k < 3 ? of.angular : of.linear;
    half = with<lane>(half, number);
  };
  SpatialLanes own = columns[k];
  const double inverse = 1 / ((k < 3 ? own.angular : own.linear)[lane] + added[k]);
  const SpatialLanes passes{own.angular * inverse, own.linear * inverse};
  dofs[k].passes = passes;
  dofs[k].inverse_inertia = inverse;
  set(own, -1);
  for (int j = 0; j < 6; ++j) {
    if (j == k) continue;
    const double factor = j < 3 ? passes.angular[j] : passes.linear[j - 3];
    set(columns[j], 0);
    columns[j].add(-factor, own);
  }
  columns[k] = {own.angular * inverse, own.linear * inverse};
}

/// From the last to the first, sweeps find the same as the elimination of one degree of freedom after the other, and at
/// the end the negative inverse.
BUBBLESIM_SIMD void eliminate_base(const double* added, SpatialLanes* inertia, TreeDof* dofs) {
  SpatialLanes columns[6];
  for (int j = 0; j < 6; ++j) columns[j] = inertia[j];
  sweep<5>(added, columns, dofs);
  sweep<4>(added, columns, dofs);
  sweep<3>(added, columns, dofs);
  sweep<2>(added, columns, dofs);
  sweep<1>(added, columns, dofs);
  sweep<0>(added, columns, dofs);
  for (int j = 0; j < 6; ++j) inertia[j] = columns[j];
}

}  // namespace

BUBBLESIM_SIMD void eliminate(const LinkDofs* links, int count, const double* added, ArticulatedInertia* inertias,
                              TreeDof* dofs) {
  for (int i = count - 1; i >= 0; --i) {
    const LinkDofs& link = links[i];
    SpatialLanes* const columns = inertias[i].columns;
    if (link.is_base) return eliminate_base(added, columns, dofs);  // the first link
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
