// SPDX-License-Identifier: BSD-3-Clause
// Data of all models together, updated when a model is added or removed: numbers, static shapes.
#include <algorithm>
#include <variant>

#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

// Static shapes of finite size are in a quadtree, and models that sleep in another, so a moving shape is tested only
// against those near it. With 6 levels its cells are 1/64 of the scene and take 350 kB.
constexpr int kQuadtreeDepth = 6;

/// Levels for a number of shapes: up to sixteen times as many cells as shapes.
int quadtree_depth(std::size_t shapes) {
  int depth = 2;
  for (; shapes > 1 && depth < kQuadtreeDepth; shapes = (shapes + 3) / 4) ++depth;
  return depth;
}

/// The least extent of a quadtree; it grows with the shapes.
Eigen::AlignedBox3d least_extent() { return {Vector3(-1, -1, -1), Vector3(1, 1, 1)}; }

dSpaceID make_quadtree(const Eigen::AlignedBox3d& extent, std::size_t shapes) {
  const Vector3 centre = extent.center();
  const Vector3 half = extent.sizes() / 2;
  const dVector3 ode_centre = {centre.x(), centre.y(), centre.z()};
  const dVector3 ode_half = {half.x(), half.y(), half.z()};
  return dQuadTreeSpaceCreate(nullptr, ode_centre, ode_half, quadtree_depth(shapes));
}

/// Makes the space of sleeping models anew, of the size of where they are now.
void fit_sleepers(WorldState& state) {
  Eigen::AlignedBox3d extent = least_extent();
  std::size_t props = 0;
  for (const PlacedModel* model : state.moving.all) {
    dGeomID shapes = reinterpret_cast<dGeomID>(model->space.get());
    if (!model->rest.is_awake()) {
      dSpaceRemove(state.spaces.sleepers.get(), shapes);
      dSpaceAdd(state.spaces.movers.get(), shapes);
    }
    if (!model->prepared->is_prop) continue;
    ++props;
    extent.extend(box_of(shapes));
  }
  state.spaces.sleepers.reset(props == 0 ? nullptr : make_quadtree(extent, props));
  // A model that is awake is searched among them as a whole.
  if (props > 0) dSpaceSetSublevel(state.spaces.sleepers.get(), 1);
}

}  // namespace

void lower_bottom(WorldState& state) {
  const Vector3 down = state.gravity.normalized();
  for (const auto& model : state.models) {
    for (const Link& link : model->links) state.bottom = std::max(state.bottom, link_pose(link).position.dot(down));
  }
}

void list_moving(WorldState& state) {
  MovingModels& moving = state.moving;
  moving.all.clear();
  int link_number = 0;
  for (const auto& model : state.models) {
    const bool moves = model->space != nullptr;
    model->number = moves ? static_cast<int>(moving.all.size()) : Collider::kNoModel;
    if (moves) moving.all.push_back(model.get());
    const double mass = total_mass(*model);
    for (Collider& collider : model->colliders) {
      collider.model = model->number;
      collider.model_mass = mass;
    }
    for (Link& link : model->links) link.number = link_number += moves ? 1 : 0;
  }
  lower_bottom(state);
  state.colliders.clear();
  for (const bool moves : {true, false}) {
    for (const auto& model : state.models) {
      if ((model->space != nullptr) != moves) continue;
      for (Collider& collider : model->colliders) {
        collider.number = static_cast<int>(state.colliders.size());
        state.colliders.push_back(&collider);
      }
    }
  }
  fit_sleepers(state);
  sort_by_sleep(moving, state.spaces, state.contacts);
}

void wake_all(WorldState& state) { wake(state.moving, state.spaces, state.contacts); }

void gather_statics(WorldState& state) {
  Eigen::AlignedBox3d extent = least_extent();
  std::vector<dGeomID> geoms;
  for (const auto& model : state.models) {
    for (const Collider& collider : model->colliders) {
      dGeomID geom = collider.geom.get();
      if (collider.link->body != nullptr || std::holds_alternative<Plane>(collider.geometry)) continue;
      if (dGeomGetSpace(geom) != nullptr) dSpaceRemove(state.spaces.statics.get(), geom);
      geoms.push_back(geom);
      extent.extend(box_of(geom));
    }
  }
  state.spaces.statics.reset(make_quadtree(extent, geoms.size()));
  for (dGeomID geom : geoms) dSpaceAdd(state.spaces.statics.get(), geom);
  ++state.spaces.changes;
  state.statics_stale = false;
}

}  // namespace bubblesim
