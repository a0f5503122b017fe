// SPDX-License-Identifier: BSD-3-Clause
// Builds bodies, joints and shapes in ODE from the description of a model.
#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "bubblesim/error.hpp"
#include "physics/contacts/convex_geom.hpp"
#include "physics/motion/impact.hpp"
#include "physics/motion/joint_correction.hpp"
#include "physics/world/state.hpp"
#include "scene/joint_kind.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {
namespace {

void set_pose(dGeomID geom, const Pose& pose) {
  dGeomSetPosition(geom, pose.position.x(), pose.position.y(), pose.position.z());
  dGeomSetQuaternion(geom, to_ode(pose.orientation).data());
}

/// `mesh` is that of the prepared model.
dGeomID make_geom(const Geometry& geometry, const CollisionMesh* mesh, const Pose& pose) {
  struct Maker {
    const CollisionMesh* mesh;
    const Pose& pose;
    dGeomID operator()(const Box& box) const { return dCreateBox(nullptr, box.size.x(), box.size.y(), box.size.z()); }
    dGeomID operator()(const Sphere& sphere) const { return dCreateSphere(nullptr, sphere.radius); }
    dGeomID operator()(const Cylinder& cylinder) const {
      return dCreateCylinder(nullptr, cylinder.radius, cylinder.length);
    }
    dGeomID operator()(const Capsule& capsule) const { return dCreateCapsule(nullptr, capsule.radius, capsule.length); }
    dGeomID operator()(const Ellipsoid& ellipsoid) const {
      return is_ball(ellipsoid) ? dCreateSphere(nullptr, ellipsoid.radii.x()) : surface();
    }
    dGeomID operator()(const Mesh&) const { return surface(); }
    dGeomID operator()(const Plane& plane) const {
      const Vector3 normal = pose.orientation * plane.normal.normalized();
      return dCreatePlane(nullptr, normal.x(), normal.y(), normal.z(), normal.dot(pose.position));
    }

   private:
    dGeomID surface() const {
      if (!mesh->parts.empty()) return create_convex(*mesh);
      return dCreateTriMesh(nullptr, mesh->data.get(), nullptr, nullptr, nullptr);
    }
  };
  return std::visit(Maker{mesh, pose}, geometry);
}

void place_body(dBodyID body, const LinkDescription& link, const Pose& pose) {
  const Vector3 centre = pose * link.centre_of_mass;
  dBodySetPosition(body, centre.x(), centre.y(), centre.z());
  dBodySetQuaternion(body, to_ode(pose.orientation).data());
}

ode::BodyHandle make_body(dWorldID world, const LinkDescription& link, const Pose& pose) {
  ode::BodyHandle body(dBodyCreate(world));
  set_inertia(body.get(), link, link.mass);
  dBodySetGravityMode(body.get(), link.gravity_enabled ? 1 : 0);
  dBodySetGyroscopicMode(body.get(), 0);  // see rotation.hpp
  dBodySetFiniteRotationMode(body.get(), 1);
  place_body(body.get(), link, pose);
  return body;
}

bool is_watched(const LinkDescription& link, const std::string& collision) {
  return std::any_of(link.sensors.begin(), link.sensors.end(), [&](const SensorDescription& sensor) {
    const auto* contact = sensor.kind.get_if<ContactDescription>();
    return contact != nullptr && watches(*contact, collision);
  });
}

/// Creates the ODE objects of one model; its objects are in the tree already.
class ModelBuilder {
 public:
  ModelBuilder(const WorldState& state, ObjectId id, std::shared_ptr<const PreparedModel> prepared)
      : state_(state), id_(id), placed_(std::make_unique<PlacedModel>(id, std::move(prepared))), model_(*placed_) {
    if (!model_.description.is_static) model_.space.reset(dSimpleSpaceCreate(state.spaces.movers.get()));
  }

  std::unique_ptr<PlacedModel> build() {
    const ModelDescription& description = model_.description;
    model_.rest.may_sleep = model_.prepared->is_prop && state_.gravity != Vector3::Zero();
    const std::vector<ObjectId> links = state_.tree().parts(id_, ObjectKind::kLink);
    for (std::size_t i = 0; i < links.size(); ++i) add_link(description.links[i], links[i]);
    const std::vector<ObjectId> joints = state_.tree().parts(id_, ObjectKind::kJoint);
    for (std::size_t i = 0; i < joints.size(); ++i) add_joint(description.joints[i], joints[i]);
    connect_mimics();
    model_.frame = frame_at(description.canonical_link, description.pose);
    for (const NestedModelDescription& nested : description.nested) {
      model_.nested.push_back(frame_at(nested.canonical_link, description.pose * nested.pose));
    }
    for (std::size_t i = 0; i < links.size(); ++i) start_at(description.links[i], model_.links[i]);
    return std::move(placed_);
  }

 private:
  const Link* link_named(const std::string& name) const {
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (model_.description.links[i].name == name) return &model_.links[i];
    }
    return nullptr;  // "world"
  }

  ModelFrame frame_at(const std::string& canonical_link, const Pose& pose) const {
    const Link* canonical = canonical_link.empty() ? &model_.links.front() : link_named(canonical_link);
    return {canonical->object, link_pose(*canonical).inverse() * pose};
  }

  void add_link(const LinkDescription& description, ObjectId id) {
    const Pose pose = model_.description.pose * description.pose;
    Link& link = model_.links.emplace_back();
    link.object = id;
    link.centre_of_mass = description.centre_of_mass;
    link.pose = pose;
    if (!model_.description.is_static) {
      link.body = make_body(state_.ode.id(), description, pose);
      link.mass = description.mass;
      if (Rotation::is_needed(link.body.get())) model_.rotations.emplace_back(link.body.get());
    }
    for (const CollisionDescription& collision : description.collisions) {
      add_collider(link, collision, is_watched(description, collision.name));
    }
    for (const Collider& collider : model_.colliders) {
      if (collider.link == &link) measure(collider, link.sweep);
    }
    for (const SensorDescription& sensor : description.sensors) add_link_sensor(link, sensor);
  }

  void add_link_sensor(const Link& link, const SensorDescription& sensor) {
    const auto* imu = sensor.kind.get_if<ImuDescription>();
    if (imu != nullptr && link.body != nullptr) {
      const Pose in_body(sensor.pose.position - link.centre_of_mass, sensor.pose.orientation);
      model_.motion_meters.emplace(model_.sensors.size(), MotionMeter(link.body.get(), in_body, imu->bandwidth));
    }
    model_.sensors.push_back(sensor.pose);
    model_.described_sensors.push_back(&sensor);
  }

  /// Sets the initial pose and velocity. Call it after the joints are created: their zero positions are those of the
  /// description.
  void start_at(const LinkDescription& description, const Link& link) const {
    if (link.body == nullptr) return;
    if (description.start) place_body(link.body.get(), description, model_.description.pose * *description.start);
    if (!description.start_velocity) return;
    const auto& [linear, angular] = *description.start_velocity;
    const Vector3 arm = link_pose(link).orientation * description.centre_of_mass;
    const Vector3 at_centre = linear + angular.cross(arm);
    dBodySetLinearVel(link.body.get(), at_centre.x(), at_centre.y(), at_centre.z());
    dBodySetAngularVel(link.body.get(), angular.x(), angular.y(), angular.z());
  }

  void add_collider(const Link& link, const CollisionDescription& description, bool watched) {
    const Pose pose = link.pose * description.pose;
    const CollisionMesh* mesh = model_.prepared->meshes[model_.colliders.size()].get();
    Collider& collider = model_.colliders.emplace_back(description);
    collider.mesh = mesh;
    collider.geom.reset(make_geom(description.geometry, mesh, pose));
    collider.link = &link;
    collider.watched = watched;
    dGeomID geom = collider.geom.get();
    dGeomSetData(geom, &collider);
    // Pairs of shapes without a common bit are skipped before any other test.
    const unsigned long bits = collide_bits(description.surface);
    dGeomSetCategoryBits(geom, bits);
    dGeomSetCollideBits(geom, bits);
    if (std::holds_alternative<Plane>(description.geometry)) {
      dSpaceAdd(state_.spaces.planes.get(), geom);
    } else if (link.body == nullptr) {
      set_pose(geom, pose);  // added to the statics' space when their extent is known
    } else {
      dSpaceAdd(model_.space.get(), geom);
      dGeomSetBody(geom, link.body.get());
      const Vector3 offset = description.pose.position - link.centre_of_mass;
      dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
      dGeomSetOffsetQuaternion(geom, to_ode(description.pose.orientation).data());
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
    joint.in_parent = parent == nullptr ? pose : link_pose(*parent).inverse() * pose;
    joint.in_child = link_pose(child).inverse() * pose;
    joint.built_in_parent = joint.in_parent;
    joint.built_in_child = joint.in_child;
    if (!model_.description.is_static) {
      JointSite site;
      site.pose = pose;
      site.parent = body_named(description.parent);
      site.child = child.body.get();
      if (find_joint_kind(description.type)->couples_hinges) {
        site.reference = body_named(description.gearbox_reference);
        site.parent_shaft = shaft_point(description.gearbox_reference, description.parent);
        site.child_shaft = shaft_point(description.gearbox_reference, description.child);
      }
      joint.joint = make_joint(state_.ode.id(), description, site);
    }
    if (joint.joint) {
      for (dBodyID body : {body_named(description.parent), child.body.get()}) {
        // A pendulum keeps its energy better with ODE's other rotation: it is shorter, as the tangent is than its arc.
        if (body != nullptr) dBodySetFiniteRotationMode(body, 0);
        note_lever(model_, body, pose.position);
      }
      meter_motors(joint, description, pose);
    }
    if (joint.joint && !description.sensors.empty()) {
      joint.meter = std::make_unique<WrenchMeter>(parent, child, joint.in_child);
    }
    for (const SensorDescription& sensor : description.sensors) {
      const auto* force_torque = sensor.kind.get_if<ForceTorqueDescription>();
      if (joint.meter != nullptr && force_torque != nullptr) {
        joint.meter->add_sensor(*force_torque, model_.sensors.size(), sensor.pose);
      }
      model_.sensors.push_back(sensor.pose);
      model_.described_sensors.push_back(&sensor);
    }
    model_.joints.push_back(std::move(joint));
    const std::size_t last = model_.joints.size() - 1;
    // As when it is put back after a run that has moved it, to the bit.
    if (has_loose_frame(model_, last))
      place_joint(model_, last, model_.joints[last].in_parent, model_.joints[last].in_child);
  }

  void meter_motors(PlacedJoint& joint, const JointDescription& description, const Pose& pose) const {
    const int axes = joint.joint->axis_count();
    for (int i = 0; i < axes; ++i) {
      auto& meter = joint.motor_meters.emplace_back();
      if (joint.joint->motor_joint(i) == nullptr) continue;
      MeteredAxis axis;
      axis.joint = joint.joint->motor_joint(i);
      axis.child = body_named(description.child);
      // With two axes, the first is fixed in the parent and the second in the child.
      axis.carrier = i == axes - 1 ? axis.child : body_named(description.parent);
      axis.direction = pose.orientation * joint.joint->axis(i).direction;
      axis.origin = pose.position;
      axis.slides = find_joint_kind(description.type)->slides;
      meter = std::make_unique<MotorMeter>(axis);
    }
  }

  /// A point, in the world, on the axis of a link in the reference body of a gearbox.
  Vector3 shaft_point(const std::string& reference, const std::string& link) const {
    const JointDescription* hinge = hinge_between(model_.description, reference, link);
    return (model_.description.pose * hinge->pose).position;
  }

  dBodyID body_named(const std::string& name) const {
    const Link* link = link_named(name);
    return link == nullptr ? nullptr : link->body.get();
  }

  void connect_mimics() {
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      const std::vector<AxisDescription>& axes = model_.description.joints[i].axes;
      for (std::size_t axis = 0; axis < axes.size() && model_.joints[i].joint; ++axis) {
        if (!axes[axis].mimic) continue;
        const auto leader =
            std::find_if(model_.description.joints.begin(), model_.description.joints.end(),
                         [&](const JointDescription& joint) { return joint.name == axes[axis].mimic->joint; });
        model_.joints[i].joint->mimic(
            static_cast<int>(axis),
            *model_.joints[static_cast<std::size_t>(leader - model_.description.joints.begin())].joint);
      }
    }
  }

  const WorldState& state_;
  ObjectId id_;
  std::unique_ptr<PlacedModel> placed_;
  PlacedModel& model_;
};

}  // namespace

WorldState::WorldState(const Vector3& gravity_, std::uint64_t seed_)
    : first_gravity(gravity_), gravity(gravity_), seed(seed_), ode(gravity_, seed_) {
  spaces.movers.reset(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
  spaces.planes.reset(dSimpleSpaceCreate(nullptr));
}

void place_model(WorldState& state, ObjectId id, std::shared_ptr<const PreparedModel> model) {
  state.models.push_back(ModelBuilder(state, id, std::move(model)).build());
  state.model_at.resize(state.tree().places());
  state.model_at[SceneTree::index_of(id)] = state.models.back().get();
  place_frames(state, *state.models.back());
}

}  // namespace bubblesim
