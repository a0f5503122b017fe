// SPDX-License-Identifier: BSD-3-Clause
// A mesh prepared for collisions: convex parts, or triangles for ODE.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "physics/convex/convex_part.hpp"
#include "physics/convex/triangle_tree.hpp"
#include "physics/ode/ode_handles.hpp"

namespace bubblesim {

/// Has either convex parts or triangles. Must live as long as ODE's mesh, which reads the arrays.
struct CollisionMesh {
  std::vector<ConvexPart> parts;
  std::unique_ptr<const ConvexPart> hull;  // of the parts; null when there are not several
  std::vector<double> coordinates;         // of the corners of the triangles
  std::vector<dTriIndex> indices;
  ode::TriMeshDataHandle data;
  std::string remark;  // warning about simplification beyond rounding; or empty

  /// The hull of the parts.
  const ConvexPart& whole() const { return hull == nullptr ? parts.front() : *hull; }
  /// The triangles, for contacts with convex shapes. Made at the first call, which may come from any thread.
  const TriangleTree& tree() const;

 private:
  mutable std::once_flag tree_made_;
  mutable std::unique_ptr<const TriangleTree> tree_;
};

/// What a mesh is prepared as. A flat mesh has no hull and stays triangles.
enum class MeshUse {
  kStatic,     // its hull if it fills it, otherwise triangles
  kMoving,     // likewise, but a concave mesh is divided into convex parts if they fit it
  kHull,       // its hull
  kParts,      // convex parts, also if they do not fit it
  kTriangles,  // as it is
};

/// Each mesh is prepared once for each use and shared by its users. Very many triangles are simplified. `remark`
/// reports concave meshes that move as triangles, and simplifications.
std::shared_ptr<const CollisionMesh> collision_mesh(const std::shared_ptr<const TriangleMesh>& mesh, MeshUse use);

}  // namespace bubblesim
