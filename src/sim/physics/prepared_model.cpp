// SPDX-License-Identifier: BSD-3-Clause
#include "physics/prepared_model.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "meshes/made_meshes.hpp"
#include "physics/ode_handles.hpp"

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

std::shared_ptr<const CollisionMesh> mesh_of(const Geometry& geometry, bool moves) {
  if (const auto* mesh = std::get_if<Mesh>(&geometry)) return collision_mesh(mesh->triangles, moves);
  const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry);
  if (ellipsoid == nullptr || is_ball(*ellipsoid)) return nullptr;
  return collision_mesh(tessellate(*ellipsoid), moves);  // ODE has no ellipsoids
}

}  // namespace

bool is_ball(const Ellipsoid& ellipsoid) {
  const Vector3& radii = ellipsoid.radii;
  return radii.X() == radii.Y() && radii.Y() == radii.Z();
}

std::shared_ptr<const PreparedModel> prepare_model(std::shared_ptr<const ModelDescription> description,
                                                   std::vector<Problem>* warnings) {
  ode::prepare_this_thread();
  auto prepared = std::make_shared<PreparedModel>();
  prepared->is_prop = is_prop(*description);
  for (const LinkDescription& link : description->links) {
    for (const CollisionDescription& collision : link.collisions) {
      auto mesh = mesh_of(collision.geometry, !description->is_static);
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
