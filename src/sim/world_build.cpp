// SPDX-License-Identifier: BSD-3-Clause
// From a scene description to bodies, joints and shapes in ODE.
#include <utility>
#include <variant>

#include "world_state.hpp"

namespace bubblesim {
namespace {

// Measured on wheeled robots: error correction and softness that keep turning radius and distance exact, and a limit on
// how fast overlapping shapes are pushed apart, without which badly placed ones fly off.
constexpr double kErrorReduction = 0.2;
constexpr double kConstraintSoftness = 1e-10;
constexpr double kMaxCorrectingVelocity = 0.1;  // m/s
constexpr double kSurfaceLayer = 0.001;         // m
// Levels of the statics' quadtree: cells of 1/64 of the scene.
constexpr int kQuadtreeDepth = 6;

void set_pose(dGeomID geom, const Pose& pose) {
  const dQuaternion rotation = {pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()};
  dGeomSetPosition(geom, pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
  dGeomSetQuaternion(geom, rotation);
}

dGeomID make_geom(const Geometry& geometry, const Pose& pose) {
  struct Maker {
    const Pose& pose;
    dGeomID operator()(const Box& box) const { return dCreateBox(nullptr, box.size.X(), box.size.Y(), box.size.Z()); }
    dGeomID operator()(const Sphere& sphere) const { return dCreateSphere(nullptr, sphere.radius); }
    dGeomID operator()(const Cylinder& cylinder) const {
      return dCreateCylinder(nullptr, cylinder.radius, cylinder.length);
    }
    dGeomID operator()(const Plane& plane) const {
      const Vector3 normal = pose.Rot().RotateVector(plane.normal.Normalized());
      return dCreatePlane(nullptr, normal.X(), normal.Y(), normal.Z(), normal.Dot(pose.Pos()));
    }
  };
  return std::visit(Maker{pose}, geometry);
}

dBodyID make_body(dWorldID world, const LinkDescription& link, const Pose& pose) {
  dMass mass;
  dMassSetParameters(&mass, link.mass, 0, 0, 0, link.inertia_diagonal.X(), link.inertia_diagonal.Y(),
                     link.inertia_diagonal.Z(), link.inertia_products.X(), link.inertia_products.Y(),
                     link.inertia_products.Z());
  dBodyID body = dBodyCreate(world);
  dBodySetMass(body, &mass);
  const Vector3 centre = pose.CoordPositionAdd(link.centre_of_mass);
  const dQuaternion rotation = {pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()};
  dBodySetPosition(body, centre.X(), centre.Y(), centre.Z());
  dBodySetQuaternion(body, rotation);
  return body;
}

/// The largest a finite static scene needs; grows with the shapes in it.
struct Extent {
  Vector3 low{-1, -1, -1};
  Vector3 high{1, 1, 1};

  void include(dGeomID geom) {
    dReal box[6];
    dGeomGetAABB(geom, box);
    low.Min({box[0], box[2], box[4]});
    high.Max({box[1], box[3], box[5]});
  }
};

/// Adds the objects of one model to the tree and to ODE.
class ModelBuilder {
 public:
  ModelBuilder(World::State& state, const ModelDescription& model)
      : state_(state),
        model_(model),
        id_(state.tree.add(ObjectKind::kModel, model.name, kNoObject, state.models.size())) {
    state.models.emplace_back();
    if (model.is_static) return;
    placed().space = dSimpleSpaceCreate(state.movers.get());
    placed().self_collide = model.self_collide;
  }

  void build() {
    for (const LinkDescription& link : model_.links) add_link(link);
    for (const JointDescription& joint : model_.joints) add_joint(joint);
    PlacedModel& model = placed();
    model.canonical_link = model_.canonical_link.empty() ? model.links.front() : link_named(model_.canonical_link);
    model.in_canonical_link = state_.link_pose(model.canonical_link).Inverse() * model_.pose;
  }

 private:
  PlacedModel& placed() { return state_.models[state_.tree.at(id_).index]; }

  ObjectId link_named(const std::string& name) {
    for (const ObjectId id : placed().links) {
      if (state_.tree.at(id).name == name) return id;
    }
    return kNoObject;  // "world"
  }

  void add_link(const LinkDescription& description) {
    const ObjectId id = state_.tree.add(ObjectKind::kLink, description.name, id_, state_.links.size());
    placed().links.push_back(id);
    const Pose pose = model_.pose * description.pose;
    Link link{nullptr, description.centre_of_mass, pose, id};
    if (!model_.is_static) link.body = make_body(state_.world.get(), description, pose);
    state_.links.push_back(link);
    for (const CollisionDescription& collision : description.collisions) add_collider(id, link, collision);
    for (const SensorDescription& sensor : description.sensors) {
      state_.tree.add(ObjectKind::kSensor, sensor.name, id, state_.sensors.size());
      state_.sensors.push_back(sensor.pose);
    }
  }

  void add_collider(ObjectId link_id, const Link& link, const CollisionDescription& description) {
    const Pose pose = link.pose * description.pose;
    dGeomID geom = make_geom(description.geometry, pose);
    state_.colliders.push_back({geom, link_id, id_, description.geometry, description.surface, description.pose});
    dGeomSetData(geom, &state_.colliders.back());
    if (std::holds_alternative<Plane>(description.geometry)) {
      dSpaceAdd(state_.planes.get(), geom);
    } else if (link.body == nullptr) {
      set_pose(geom, pose);  // goes into the statics' space when their extent is known
    } else {
      dSpaceAdd(placed().space, geom);
      dGeomSetBody(geom, link.body);
      const Vector3 offset = description.pose.Pos() - link.centre_of_mass;
      const Quaternion& turn = description.pose.Rot();
      const dQuaternion rotation = {turn.W(), turn.X(), turn.Y(), turn.Z()};
      dGeomSetOffsetPosition(geom, offset.X(), offset.Y(), offset.Z());
      dGeomSetOffsetQuaternion(geom, rotation);
    }
  }

  void add_joint(const JointDescription& description) {
    const ObjectId id = state_.tree.add(ObjectKind::kJoint, description.name, id_, state_.joints.size());
    // The second axis of a steered wheel is an object of its own, so that scripts can name it.
    for (std::size_t axis = 1; axis < description.axes.size(); ++axis) {
      state_.tree.add(ObjectKind::kJoint, "axis" + std::to_string(axis + 1), id, state_.joints.size());
    }
    PlacedJoint joint;
    joint.object = id;
    joint.parent = link_named(description.parent);
    joint.child = link_named(description.child);
    const Pose pose = model_.pose * description.pose;
    joint.in_parent = joint.parent == kNoObject ? pose : state_.link_pose(joint.parent).Inverse() * pose;
    joint.in_child = state_.link_pose(joint.child).Inverse() * pose;
    if (!model_.is_static) {
      const JointBodies bodies{joint.parent == kNoObject ? nullptr : state_.link(joint.parent).body,
                               state_.link(joint.child).body};
      joint.joint = make_joint(state_.world.get(), description, pose, bodies);
    }
    state_.joints.push_back(std::move(joint));
  }

  World::State& state_;
  const ModelDescription& model_;
  ObjectId id_;
};

/// Static shapes of finite size go into a quadtree: a moving shape then meets only those near it.
void gather_statics(World::State& state) {
  Extent extent;
  std::vector<dGeomID> geoms;
  for (const Collider& collider : state.colliders) {
    if (dGeomGetSpace(collider.geom) != nullptr) continue;
    geoms.push_back(collider.geom);
    extent.include(collider.geom);
  }
  const Vector3 centre = (extent.low + extent.high) / 2;
  const Vector3 half = (extent.high - extent.low) / 2;
  const dVector3 ode_centre = {centre.X(), centre.Y(), centre.Z()};
  const dVector3 ode_half = {half.X(), half.Y(), half.Z()};
  state.statics.reset(dQuadTreeSpaceCreate(nullptr, ode_centre, ode_half, kQuadtreeDepth));
  for (dGeomID geom : geoms) dSpaceAdd(state.statics.get(), geom);
}

}  // namespace

void build_world(World::State& state, const SceneDescription& scene) {
  state.threading.reset(dThreadingAllocateSelfThreadedImplementation());
  state.world.reset(dWorldCreate());
  dWorldID world = state.world.get();
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(state.threading.get()),
                                       state.threading.get());
  dWorldSetGravity(world, scene.gravity.X(), scene.gravity.Y(), scene.gravity.Z());
  dWorldSetERP(world, kErrorReduction);
  dWorldSetCFM(world, kConstraintSoftness);
  dWorldSetContactMaxCorrectingVel(world, kMaxCorrectingVelocity);
  dWorldSetContactSurfaceLayer(world, kSurfaceLayer);
  state.movers.reset(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
  state.planes.reset(dSimpleSpaceCreate(nullptr));
  state.contacts.reset(dJointGroupCreate(0));

  for (const ModelDescription& model : scene.models) ModelBuilder(state, model).build();
  gather_statics(state);
}

}  // namespace bubblesim
