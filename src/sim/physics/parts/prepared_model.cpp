// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/prepared_model.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "meshes/made_meshes.hpp"
#include "physics/ode/ode_handles.hpp"

namespace bubblesim {
namespace {

bool is_prop(const ModelDescription& model) {
  const auto quiet = [](const NestedModelDescription& nested) {
    return nested.child_script.empty() && nested.plugins.empty();
  };
  return model.child_script.empty() && model.plugins.empty() && model.joints.empty() &&
         std::all_of(model.nested.begin(), model.nested.end(), quiet) &&
         std::all_of(model.links.begin(), model.links.end(),
                     [](const LinkDescription& link) { return link.sensors.empty(); });
}

MeshUse use_of(MeshCollision wanted, bool moves) {
  switch (wanted) {
    case MeshCollision::kHull:
      return MeshUse::kHull;
    case MeshCollision::kParts:
      return MeshUse::kParts;
    case MeshCollision::kTriangles:
      return MeshUse::kTriangles;
    case MeshCollision::kAuto:
      break;
  }
  return moves ? MeshUse::kMoving : MeshUse::kStatic;
}

std::shared_ptr<const CollisionMesh> mesh_of(const CollisionDescription& collision, bool moves) {
  if (const auto* mesh = std::get_if<Mesh>(&collision.geometry)) {
    return collision_mesh(mesh->triangles, use_of(collision.mesh_collision, moves));
  }
  const auto* ellipsoid = std::get_if<Ellipsoid>(&collision.geometry);
  if (ellipsoid == nullptr || is_ball(*ellipsoid)) return nullptr;
  return collision_mesh(tessellate(*ellipsoid), MeshUse::kHull);  // ODE has no ellipsoids
}

}  // namespace

bool is_ball(const Ellipsoid& ellipsoid) {
  const Vector3& radii = ellipsoid.radii;
  return radii.x() == radii.y() && radii.y() == radii.z();
}

std::shared_ptr<PreparedModel> prepare_model(std::shared_ptr<const ModelDescription> description,
                                             std::vector<Problem>* warnings) {
  ode::prepare_this_thread();
  auto prepared = std::make_shared<PreparedModel>();
  prepared->is_prop = is_prop(*description);
  for (const LinkDescription& link : description->links) {
    for (const CollisionDescription& collision : link.collisions) {
      auto mesh = mesh_of(collision, !description->is_static);
      // Each mesh is reported for its first user.
      if (mesh != nullptr && !mesh->remark.empty() && warnings != nullptr && mesh.use_count() == 1) {
        warnings->push_back({collision.source.file, collision.source.line,
                             "/" + description->name + "/" + collision.name, mesh->remark});
      }
      prepared->meshes.push_back(std::move(mesh));
    }
  }
  prepared->description = std::move(description);
  return prepared;
}

}  // namespace bubblesim
