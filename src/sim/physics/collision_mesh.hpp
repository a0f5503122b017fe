// SPDX-License-Identifier: BSD-3-Clause
// A collision mesh for ODE.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <string>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "physics/ode_handles.hpp"

namespace bubblesim {

/// Must live as long as ODE's mesh, which reads the arrays.
struct CollisionMesh {
  std::vector<double> coordinates;  // of the corners
  std::vector<dTriIndex> indices;
  ode::TriMeshDataHandle data;
  std::string remark;  // warning about simplification beyond rounding; or empty
};

/// Each mesh is prepared once and shared by its users. A convex mesh is simplified: corners inside its faces would only
/// add useless contacts. A mesh with very many triangles is simplified, with a remark.
std::shared_ptr<const CollisionMesh> collision_mesh(const std::shared_ptr<const TriangleMesh>& mesh);

}  // namespace bubblesim
