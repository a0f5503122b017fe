// SPDX-License-Identifier: BSD-3-Clause
// A surface as ODE collides it.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <string>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "physics/ode_handles.hpp"

namespace bubblesim {

/// ODE reads the arrays as long as it lives.
struct CollisionMesh {
  std::vector<double> coordinates;  // of the corners
  std::vector<dTriIndex> indices;
  ode::TriMeshDataHandle data;
  std::string remark;  // on what was changed beyond what rounding does; or empty
};

/// Each mesh is prepared once and shared as long as anybody uses it. One that is convex is simplified: corners amid its
/// faces would only yield contacts that hold nothing. One with very many triangles is simplified, with a remark.
std::shared_ptr<const CollisionMesh> collision_mesh(const std::shared_ptr<const TriangleMesh>& mesh);

}  // namespace bubblesim
