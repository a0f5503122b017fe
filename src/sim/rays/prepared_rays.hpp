// SPDX-License-Identifier: BSD-3-Clause
// Embree's geometries of models, made once and shared by all simulations that have the models: tracing only reads them.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "rays/embree_handles.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_shape.hpp"

namespace bubblesim::rays {

/// The shapes of a model.
struct RayModel {
  struct Fixed {
    const RayShape* shape;
    GeometryHandle geometry;
  };
  struct InfinitePlane {
    const RayShape* shape;
    PlaneEquation equation;
  };
  /// A link that may move, as a scene in its own frame.
  struct Link {
    ObjectId id = kNoObject;
    SceneHandle scene;
    std::vector<const RayShape*> shapes;  // by geometry id
    Vector3 middle;                       // of a sphere around them, in the link's frame
    double reach = 0;                     // m, its radius
  };

  ObjectId object = kNoObject;
  std::vector<std::unique_ptr<RayShape>> shapes;
  std::vector<Fixed> fixed;  // of a static model, in the world
  std::vector<InfinitePlane> planes;
  std::vector<Link> links;  // of a moving model
};

using SharedRayModel = std::shared_ptr<const RayModel>;

/// The static shapes of several models.
struct StaticRays {
  SceneHandle scene;
  SceneHandle housings;                 // round shapes around sensors, whose rays skip them
  std::vector<const RayShape*> shapes;  // of both scenes, by geometry id
  std::vector<const RayShape*> housing_shapes;
};

struct PreparedRays {
  std::vector<SharedRayModel> models;
  std::shared_ptr<const StaticRays> statics;
};

/// The shapes of a model whose objects are in the tree.
SharedRayModel prepare_rays(const SceneTree& tree, ObjectId model, const ModelDescription& description);

/// A link of a static model as one that moves. `pose`: of the link, where the model was prepared.
SharedRayModel loosened(const RayModel& model, ObjectId link, const Pose& pose);

/// `loose`: the links of static models that move.
std::shared_ptr<const StaticRays> gather_statics(const std::vector<SharedRayModel>& models,
                                                 const std::set<ObjectId>& loose = {});

}  // namespace bubblesim::rays
