// SPDX-License-Identifier: BSD-3-Clause
// Convex parts as a class of ODE's shapes, and their contacts. ODE does the broad phase only.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "physics/convex/collision_mesh.hpp"
#include "physics/convex/convex_part.hpp"
#include "physics/convex/convex_shape.hpp"

namespace bubblesim {

/// A shape in no space, of the parts of a mesh, which must outlive it.
dGeomID create_convex(const CollisionMesh& mesh);

/// The convex shapes of a geom that is a primitive of ODE or made by create_convex(); none for others.
void shapes_of(dGeomID geom, std::vector<ConvexShape>& shapes);

/// Whether create_convex() made the shape.
bool is_convex_geom(dGeomID geom);

/// The contacts of two shapes, of which one at least is convex, in a fixed order. Locks nothing: worlds on several
/// threads do not wait for each other.
void find_convex_contacts(dGeomID first, dGeomID second, std::vector<dContactGeom>& contacts);

}  // namespace bubblesim
