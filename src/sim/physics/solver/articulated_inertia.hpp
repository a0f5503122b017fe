// SPDX-License-Identifier: BSD-3-Clause
// The inertia of a link with all that hangs on it by free joints: what it resists if its joint is accelerated while the
// joints behind it give way (R. Featherstone, "Rigid Body Dynamics Algorithms", 2008, chapter 7).
//
// All links have the same axes and the same origin, so that inertias are added as they are. Eliminating the degrees of
// freedom from the last to the first yields the factors L^T D L of the mass matrix: D is their inertia, and the element
// of L of one of them and of another one before it is what the force that it passes on does along the other.
#pragma once

#include "physics/solver/spatial_lanes.hpp"

namespace bubblesim {

/// The moment about the origin and the force that turning and sliding accelerations along the axes need, by column.
struct ArticulatedInertia {
  SpatialLanes columns[6];
};

/// A degree of freedom.
struct TreeDof {
  SpatialLanes direction;      ///< in which it moves the links behind it, per rate
  SpatialLanes passes;         ///< what its link passes on to the parent of a force along it, per N or N m; of the
                               ///< base only along the degrees of freedom before it
  double inverse_inertia = 0;  ///< 1/kg or 1/(kg m^2), against acceleration along it
};

/// A link with the numbers of its degrees of freedom.
struct LinkDofs {
  int parent = -1;
  int first = 0;
  int count = 0;
  bool is_free = false;  ///< it has all degrees of freedom, with axes of the world through its centre of mass
  bool is_ball = false;  ///< it turns about axes of the world
  bool is_base = false;  ///< it is free, and its centre of mass is the origin: its directions are those of the axes
};

/// Computes what the degrees of freedom pass on and their inertias from their directions, and changes the inertias from
/// those of single links to articulated ones, as they act on the parents; that of the base to the negative inverse of
/// its articulated one. `added`: kg or kg m^2, by degree of freedom.
void eliminate(const LinkDofs* links, int count, const double* added, ArticulatedInertia* inertias, TreeDof* dofs);

}  // namespace bubblesim
