// SPDX-License-Identifier: BSD-3-Clause
// Data of all models together, updated when a model is added or removed: numbers, static shapes.
#include <algorithm>
#include <variant>

#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

// Static shapes of finite size are in a quadtree, so a moving shape is tested only against those near it. With 6 levels
// its cells are 1/64 of the scene and take 350 kB.
constexpr int kQuadtreeDepth = 6;

/// Levels for a number of shapes: up to sixteen times as many cells as shapes.
int quadtree_depth(std::size_t shapes) {
  int depth = 2;
  for (; shapes > 1 && depth < kQuadtreeDepth; shapes = (shapes + 3) / 4) ++depth;
  return depth;
}

/// Bounding box of the finite static shapes; grows with the shapes.
struct Extent {
  Vector3 low{-1, -1, -1};
  Vector3 high{1, 1, 1};

  void include(dGeomID geom) {
    dReal box[6];
    dGeomGetAABB(geom, box);
    low = low.cwiseMin(Vector3(box[0], box[2], box[4]));
    high = high.cwiseMax(Vector3(box[1], box[3], box[5]));
  }
};

}  // namespace

void lower_bottom(WorldState& state) {
  const Vector3 down = state.gravity.normalized();
  for (const auto& model : state.models) {
    for (const Link& link : model->links) state.bottom = std::max(state.bottom, link_pose(link).position.dot(down));
  }
}

void list_moving(WorldState& state) {
  state.moving.clear();
  int link_number = 0;
  for (const auto& model : state.models) {
    const bool moves = model->space != nullptr;
    const int number = moves ? static_cast<int>(state.moving.size()) : Collider::kNoModel;
    if (moves) state.moving.push_back(model.get());
    const double mass = total_mass(*model);
    for (Collider& collider : model->colliders) {
      collider.model = number;
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
}

void gather_statics(WorldState& state) {
  Extent extent;
  std::vector<dGeomID> geoms;
  for (const auto& model : state.models) {
    for (const Collider& collider : model->colliders) {
      dGeomID geom = collider.geom.get();
      if (collider.link->body != nullptr || std::holds_alternative<Plane>(collider.geometry)) continue;
      if (dGeomGetSpace(geom) != nullptr) dSpaceRemove(state.spaces.statics.get(), geom);
      geoms.push_back(geom);
      extent.include(geom);
    }
  }
  const Vector3 centre = (extent.low + extent.high) / 2;
  const Vector3 half = (extent.high - extent.low) / 2;
  const dVector3 ode_centre = {centre.x(), centre.y(), centre.z()};
  const dVector3 ode_half = {half.x(), half.y(), half.z()};
  state.spaces.statics.reset(dQuadTreeSpaceCreate(nullptr, ode_centre, ode_half, quadtree_depth(geoms.size())));
  for (dGeomID geom : geoms) dSpaceAdd(state.spaces.statics.get(), geom);
  state.statics_stale = false;
}

}  // namespace bubblesim
