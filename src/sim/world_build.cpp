// SPDX-License-Identifier: BSD-3-Clause
// From the description of a model to bodies, joints and shapes in ODE.
#include <algorithm>
#include <utility>
#include <variant>

#include "meshes/made_meshes.hpp"
#include "world_state.hpp"

namespace bubblesim {
namespace {

// Measured on wheeled robots: error correction and softness that keep turning radius and distance exact, and a limit on
// how fast overlapping shapes are pushed apart, without which badly placed ones fly off.
constexpr double kErrorReduction = 0.2;
constexpr double kConstraintSoftness = 1e-10;
constexpr double kMaxCorrectingVelocity = 0.1;  // m/s
constexpr double kSurfaceLayer = 0.001;         // m
// Static shapes of finite size are in a quadtree: a moving shape then meets only those near it. 6 levels: its cells are
// 1/64 of the scene.
constexpr int kQuadtreeDepth = 6;

void set_pose(dGeomID geom, const Pose& pose) {
  const dQuaternion rotation = {pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()};
  dGeomSetPosition(geom, pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
  dGeomSetQuaternion(geom, rotation);
}

dGeomID make_geom(Collider& collider, const Pose& pose) {
  struct Maker {
    Collider& collider;
    const Pose& pose;
    dGeomID operator()(const Box& box) const { return dCreateBox(nullptr, box.size.X(), box.size.Y(), box.size.Z()); }
    dGeomID operator()(const Sphere& sphere) const { return dCreateSphere(nullptr, sphere.radius); }
    dGeomID operator()(const Cylinder& cylinder) const {
      return dCreateCylinder(nullptr, cylinder.radius, cylinder.length);
    }
    dGeomID operator()(const Capsule& capsule) const { return dCreateCapsule(nullptr, capsule.radius, capsule.length); }
    dGeomID operator()(const Ellipsoid& ellipsoid) const {
      const Vector3& radii = ellipsoid.radii;
      if (radii.X() == radii.Y() && radii.Y() == radii.Z()) return dCreateSphere(nullptr, radii.X());
      return surface(tessellate(ellipsoid));  // ODE has no ellipsoids
    }
    dGeomID operator()(const Mesh& mesh) const { return surface(mesh.triangles); }
    dGeomID operator()(const Plane& plane) const {
      const Vector3 normal = pose.Rot().RotateVector(plane.normal.Normalized());
      return dCreatePlane(nullptr, normal.X(), normal.Y(), normal.Z(), normal.Dot(pose.Pos()));
    }

   private:
    dGeomID surface(const std::shared_ptr<const TriangleMesh>& mesh) const {
      collider.mesh = collision_mesh(mesh);
      return dCreateTriMesh(nullptr, collider.mesh->data.get(), nullptr, nullptr, nullptr);
    }
  };
  return std::visit(Maker{collider, pose}, collider.geometry);
}

ode::BodyHandle make_body(dWorldID world, const LinkDescription& link, const Pose& pose) {
  dMass mass;
  dMassSetParameters(&mass, link.mass, 0, 0, 0, link.inertia_diagonal.X(), link.inertia_diagonal.Y(),
                     link.inertia_diagonal.Z(), link.inertia_products.X(), link.inertia_products.Y(),
                     link.inertia_products.Z());
  ode::BodyHandle body(dBodyCreate(world));
  dBodySetMass(body.get(), &mass);
  dBodySetGravityMode(body.get(), link.has_weight ? 1 : 0);
  const Vector3 centre = pose.CoordPositionAdd(link.centre_of_mass);
  const dQuaternion rotation = {pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()};
  dBodySetPosition(body.get(), centre.X(), centre.Y(), centre.Z());
  dBodySetQuaternion(body.get(), rotation);
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

bool is_watched(const LinkDescription& link, const std::string& collision) {
  return std::any_of(link.sensors.begin(), link.sensors.end(), [&](const SensorDescription& sensor) {
    const auto* contact = std::get_if<ContactDescription>(&sensor.kind);
    return contact != nullptr && watches(*contact, collision);
  });
}

/// Makes what one model has in ODE, for the objects that it has in the tree.
class ModelBuilder {
 public:
  ModelBuilder(const World::State& state, ObjectId id, ModelDescription description) : state_(state), id_(id) {
    model_.description = std::move(description);
    if (!model_.description.is_static) model_.space.reset(dSimpleSpaceCreate(state.movers.get()));
  }

  PlacedModel build() {
    const ModelDescription& description = model_.description;
    const std::vector<ObjectId> links = state_.tree.children(id_, ObjectKind::kLink);
    for (std::size_t i = 0; i < links.size(); ++i) add_link(description.links[i], links[i]);
    // The further axes of a joint lie below it: these are the joints alone.
    const std::vector<ObjectId> joints = state_.tree.children(id_, ObjectKind::kJoint);
    for (std::size_t i = 0; i < joints.size(); ++i) add_joint(description.joints[i], joints[i]);
    const Link* canonical = &model_.links.front();
    if (!description.canonical_link.empty()) canonical = link_named(description.canonical_link);
    model_.canonical_link = canonical->object;
    model_.in_canonical_link = link_pose(*canonical).Inverse() * description.pose;
    return std::move(model_);
  }

 private:
  const Link* link_named(const std::string& name) const {
    for (const Link& link : model_.links) {
      if (state_.tree.at(link.object).name == name) return &link;
    }
    return nullptr;  // "world"
  }

  void add_link(const LinkDescription& description, ObjectId id) {
    const Pose pose = model_.description.pose * description.pose;
    Link& link = model_.links.emplace_back();
    link.object = id;
    link.centre_of_mass = description.centre_of_mass;
    link.pose = pose;
    if (!model_.description.is_static) link.body = make_body(state_.world.get(), description, pose);
    for (const CollisionDescription& collision : description.collisions) {
      add_collider(link, collision, is_watched(description, collision.name));
    }
    for (const SensorDescription& sensor : description.sensors) model_.sensors.push_back(sensor.pose);
  }

  void add_collider(const Link& link, const CollisionDescription& description, bool watched) {
    const Pose pose = link.pose * description.pose;
    Collider& collider = model_.colliders.emplace_back();
    collider.geometry = description.geometry;
    collider.geom.reset(make_geom(collider, pose));
    collider.link = &link;
    collider.name = description.name;
    collider.watched = watched;
    collider.surface = description.surface;
    collider.in_link = description.pose;
    dGeomID geom = collider.geom.get();
    dGeomSetData(geom, &collider);
    if (std::holds_alternative<Plane>(description.geometry)) {
      dSpaceAdd(state_.planes.get(), geom);
    } else if (link.body == nullptr) {
      set_pose(geom, pose);  // goes into the statics' space when their extent is known
    } else {
      dSpaceAdd(model_.space.get(), geom);
      dGeomSetBody(geom, link.body.get());
      const Vector3 offset = description.pose.Pos() - link.centre_of_mass;
      const Quaternion& turn = description.pose.Rot();
      const dQuaternion rotation = {turn.W(), turn.X(), turn.Y(), turn.Z()};
      dGeomSetOffsetPosition(geom, offset.X(), offset.Y(), offset.Z());
      dGeomSetOffsetQuaternion(geom, rotation);
    }
  }

  void add_joint(const JointDescription& description, ObjectId id) {
    const Link* parent = link_named(description.parent);
    const Link& child = *link_named(description.child);
    const Pose pose = model_.description.pose * description.pose;
    PlacedJoint joint;
    joint.object = id;
    joint.parent = parent == nullptr ? kNoObject : parent->object;
    joint.child = child.object;
    joint.in_parent = parent == nullptr ? pose : link_pose(*parent).Inverse() * pose;
    joint.in_child = link_pose(child).Inverse() * pose;
    if (!model_.description.is_static) {
      const JointBodies bodies{parent == nullptr ? nullptr : parent->body.get(), child.body.get()};
      joint.joint = make_joint(state_.world.get(), description, pose, bodies);
    }
    for (const SensorDescription& sensor : description.sensors) model_.sensors.push_back(sensor.pose);
    if (joint.joint && !description.sensors.empty()) {
      joint.meter = make_meter(parent == nullptr ? nullptr : parent->body.get(), child.body.get());
    }
    model_.joints.push_back(std::move(joint));
  }

  const World::State& state_;
  ObjectId id_;
  PlacedModel model_;
};

}  // namespace

World::State::State(const Vector3& gravity_, std::uint64_t seed_) : gravity(gravity_), seed(seed_) {
  ode::prepare_this_thread();
  threading.reset(dThreadingAllocateSelfThreadedImplementation());
  world.reset(dWorldCreate());
  dWorldSetStepThreadingImplementation(world.get(), dThreadingImplementationGetFunctions(threading.get()),
                                       threading.get());
  dWorldSetGravity(world.get(), gravity.X(), gravity.Y(), gravity.Z());
  dWorldSetERP(world.get(), kErrorReduction);
  dWorldSetCFM(world.get(), kConstraintSoftness);
  dWorldSetContactMaxCorrectingVel(world.get(), kMaxCorrectingVelocity);
  dWorldSetContactSurfaceLayer(world.get(), kSurfaceLayer);
  movers.reset(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
  planes.reset(dSimpleSpaceCreate(nullptr));
  contacts.reset(dJointGroupCreate(0));
}

ObjectId enter_model(SceneTree& tree, const ModelDescription& model) {
  const ObjectId id = tree.add(ObjectKind::kModel, model.name, kNoObject, 0);
  std::size_t sensors = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const ObjectId link = tree.add(ObjectKind::kLink, model.links[i].name, id, i);
    for (const SensorDescription& sensor : model.links[i].sensors) {
      tree.add(ObjectKind::kSensor, sensor.name, link, sensors++);
    }
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const ObjectId joint = tree.add(ObjectKind::kJoint, model.joints[i].name, id, i);
    for (const SensorDescription& sensor : model.joints[i].sensors) {
      tree.add(ObjectKind::kSensor, sensor.name, joint, sensors++);
    }
    // The second axis of a steered wheel is an object of its own, so that scripts can name it.
    for (std::size_t axis = 1; axis < model.joints[i].axes.size(); ++axis) {
      tree.add(ObjectKind::kJoint, "axis" + std::to_string(axis + 1), joint, i);
    }
  }
  return id;
}

void place_model(World::State& state, ObjectId id, ModelDescription model) {
  state.models.emplace(id, ModelBuilder(state, id, std::move(model)).build());
}

void gather_statics(World::State& state) {
  Extent extent;
  std::vector<dGeomID> geoms;
  for (const auto& [id, model] : state.models) {
    for (const Collider& collider : model.colliders) {
      dGeomID geom = collider.geom.get();
      if (collider.link->body != nullptr || std::holds_alternative<Plane>(collider.geometry)) continue;
      if (dGeomGetSpace(geom) != nullptr) dSpaceRemove(state.statics.get(), geom);
      geoms.push_back(geom);
      extent.include(geom);
    }
  }
  const Vector3 centre = (extent.low + extent.high) / 2;
  const Vector3 half = (extent.high - extent.low) / 2;
  const dVector3 ode_centre = {centre.X(), centre.Y(), centre.Z()};
  const dVector3 ode_half = {half.X(), half.Y(), half.Z()};
  state.statics.reset(dQuadTreeSpaceCreate(nullptr, ode_centre, ode_half, kQuadtreeDepth));
  for (dGeomID geom : geoms) dSpaceAdd(state.statics.get(), geom);
}

}  // namespace bubblesim
