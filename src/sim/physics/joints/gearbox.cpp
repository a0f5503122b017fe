// SPDX-License-Identifier: BSD-3-Clause
// gearbox: when the parent turns by an angle in the reference body, the child turns by -ratio times that angle. Hinges
// connect parent and child to the reference body.
#include <algorithm>
#include <cmath>

#include "load/sdf/elements/sdf_element.hpp"
#include "physics/joints/define.hpp"
#include "physics/joints/point_velocity_constraint.hpp"
#include "physics/ode/body_state.hpp"
#include "physics/ode/constraint_defaults.hpp"
#include "physics/ode/ode_math.hpp"
#include "scene/describe.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {
namespace {

constexpr double kSmallestSize = 0.1;  // m, of gears whose axes meet
/// Two axes are collinear when the motions of a point beside them differ by less than this angle, rad.
constexpr double kOneLine = 1e-2;
/// Mass and inertia of a layshaft relative to those of the child.
constexpr double kLayshaftPart = 1e-3;

/// The pose and velocity of a body; null is the world.
struct Frame {
  explicit Frame(dBodyID body) {
    if (body == nullptr) return;
    pose = body_pose(body);
    angular = to_vector(dBodyGetAngularVel(body));
  }
  Pose pose;
  Vector3 angular;  // rad/s
};

/// The orientation of a body in a frame.
Quaternion turn_in(const Frame& frame, dBodyID body) {
  return frame.pose.orientation.conjugate() * Frame(body).pose.orientation;
}

/// An axis in the frame of the reference body, and the body that turns about it.
struct Shaft {
  dBodyID body = nullptr;
  Vector3 point;
  Vector3 direction;

  Vector3 way_of(const Vector3& at) const { return direction.cross(at - point); }  // per radian
};

/// The point at which two shafts mesh.
struct Mesh {
  Vector3 point;  // in the frame of the reference body
  Vector3 direction;
  double arm = 0;  // m per radian, motion of the first shaft along the direction
};

/// Computes the mesh for a ratio of -ratio. Empty when the axes are collinear.
std::optional<Mesh> mesh_of(const Shaft& first, const Shaft& second, double ratio) {
  const Vector3 apart = second.point - first.point;
  const double size = std::max(apart.norm(), kSmallestSize);
  std::optional<Mesh> best;
  double widest = kOneLine;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 point = first.point + apart / 2 + Vector3::Unit(axis) * size / 2;
    const Vector3 way1 = first.way_of(point);
    const Vector3 way2 = second.way_of(point);
    const double angle = way1.cross(way2).norm() / std::max(way1.norm() * way2.norm(), 1e-12);
    if (angle <= widest) continue;
    widest = angle;
    // Along the direction, way1 must be as long as way2 for a rotation of -ratio.
    const Vector3 difference = way1 + way2 * ratio;
    const Vector3 direction = (way1 - difference * (way1.dot(difference) / difference.squaredNorm())).normalized();
    best = Mesh{point, direction, way1.dot(direction)};
  }
  return best;
}

class Gearbox final : public Joint {
 public:
  Gearbox(dWorldID world, const JointDescription& description, const JointSite& site)
      : Joint(description.axes), reference_(site.reference), ratio_(description.gearbox_ratio) {
    const Frame frame(reference_);
    const auto shaft = [&](dBodyID body, const Vector3& point, int axis) {
      return Shaft{body, frame.pose.orientation.conjugate() * (point - frame.pose.position),
                   frame.pose.orientation.conjugate() * axis_direction(description, axis, site)};
    };
    shafts_[0] = shaft(site.parent, site.parent_shaft, 0);
    shafts_[1] = shaft(site.child, site.child_shaft, 1);
    for (int i = 0; i < 2; ++i) at_start_[i] = turn_in(frame, shafts_[i].body);
    if (const auto direct = mesh_of(shafts_[0], shafts_[1], ratio_)) {
      teeth_.push_back({shafts_[0].body, shafts_[1].body, *direct, ratio_, PointVelocityConstraint(world)});
    } else {
      add_layshaft(world);
    }
  }

  /// Angle of the parent (axis 0) or the child (axis 1) in the reference body, counting full turns.
  double position(int axis) const override {
    const Quaternion turn = turn_in(Frame(reference_), shafts_[axis].body) * at_start_[axis].conjugate();
    const double sine = turn.vec().dot(shafts_[axis].direction);
    const double angle = 2 * std::atan2(sine, turn.w());
    return followed_[axis] + std::remainder(angle - followed_[axis], 2 * M_PI);
  }
  double velocity(int axis) const override {
    const Frame frame(reference_);
    return (Frame(shafts_[axis].body).angular - frame.angular).dot(frame.pose.orientation * shafts_[axis].direction);
  }

  std::optional<ShaftCoupling> coupling() const override {
    const Quaternion axes = Frame(reference_).pose.orientation;
    return ShaftCoupling{axes * shafts_[0].direction, axes * shafts_[1].direction, ratio_};
  }

 private:
  struct Pair {
    dBodyID first;
    dBodyID second;
    Mesh mesh;
    double ratio;
    PointVelocityConstraint tooth;
  };

  /// Collinear shafts have no point at which they could mesh: a small layshaft beside them connects them.
  void add_layshaft(dWorldID world) {
    const Shaft& parent = shafts_[0];
    const Vector3 aside = parent.direction.unitOrthogonal();
    layshaft_.reset(dBodyCreate(world));
    dMass mass;
    dBodyGetMass(shafts_[1].body, &mass);
    const double inertia = kLayshaftPart * std::min({mass.I[0], mass.I[5], mass.I[10]});
    dMassSetParameters(&mass, kLayshaftPart * mass.mass, 0, 0, 0, inertia, inertia, inertia, 0, 0, 0);
    dBodySetMass(layshaft_.get(), &mass);
    dBodySetGravityMode(layshaft_.get(), 0);
    const Shaft lay{layshaft_.get(), parent.point + aside * kSmallestSize, parent.direction};
    lay_ = lay;
    carry_layshaft();
    bearing_.reset(dJointCreateHinge(world, nullptr));
    dJointAttach(bearing_.get(), layshaft_.get(), reference_);
    const Pose frame = Frame(reference_).pose;
    const Vector3 anchor = frame * lay.point;
    const Vector3 direction = frame.orientation * lay.direction;
    dJointSetHingeAnchor(bearing_.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(bearing_.get(), direction.x(), direction.y(), direction.z());
    teeth_.push_back({parent.body, lay.body, *mesh_of(parent, lay, 1), 1, PointVelocityConstraint(world)});
    teeth_.push_back(
        {lay.body, shafts_[1].body, *mesh_of(lay, shafts_[1], -ratio_), -ratio_, PointVelocityConstraint(world)});
  }

  /// Moves the layshaft with the reference body, which may have been moved. The layshaft is round, so only its spin
  /// matters, not its angle.
  void carry_layshaft() {
    const Frame frame(reference_);
    const Vector3 at = frame.pose * lay_.point;
    const Vector3 axis = frame.pose.orientation * lay_.direction;
    const double spin = (Frame(lay_.body).angular - frame.angular).dot(axis);
    const Vector3 angular = frame.angular + axis * spin;
    dVector3 velocity = {};
    if (reference_ != nullptr) dBodyGetPointVel(reference_, at.x(), at.y(), at.z(), velocity);
    dBodySetPosition(lay_.body, at.x(), at.y(), at.z());
    dBodySetQuaternion(lay_.body, to_ode(frame.pose.orientation).data());
    dBodySetLinearVel(lay_.body, velocity[0], velocity[1], velocity[2]);
    dBodySetAngularVel(lay_.body, angular.x(), angular.y(), angular.z());
  }

  void follow(double step) override {
    for (int i = 0; i < 2; ++i) followed_[i] = position(i);
    if (layshaft_ != nullptr) carry_layshaft();
    const double error = followed_[1] + ratio_ * followed_[0];
    const Frame frame(reference_);
    for (Pair& pair : teeth_) {
      // Only the last pair corrects the error of the child's angle.
      const double gain = &pair == &teeth_.back() ? kErrorReduction / step : 0;
      pair.tooth.hold(pair.first, pair.second, frame.pose * pair.mesh.point,
                      frame.pose.orientation * pair.mesh.direction, -gain * error * pair.mesh.arm / pair.ratio);
    }
  }

  void transfer_own(StateArchive& archive) override {
    archive(followed_[0], followed_[1]);
    if (layshaft_ != nullptr) transfer_body(archive, layshaft_.get());
  }

  dBodyID reference_;
  double ratio_;
  Shaft shafts_[2];         // of the parent and of the child
  Quaternion at_start_[2];  // in the reference body
  double followed_[2] = {};
  ode::BodyHandle layshaft_;  // null when the shafts mesh directly
  Shaft lay_;
  ode::JointHandle bearing_;
  std::vector<Pair> teeth_;
};

}  // namespace

class GearboxKind final : public JointKind {
 public:
  GearboxKind() : JointKind("gearbox", 2) { couples_hinges = true; }

  void read(const SdfElement& joint, const std::string&, LoadContext&, JointDescription& description) const override {
    if (description.axes.size() == 1) description.axes.push_back(description.axes.front());
    description.gearbox_ratio = joint.number("gearbox_ratio");
    description.gearbox_reference = joint.text("gearbox_reference_body");
  }

  void check(Checker& checker, const ModelDescription& model, const JointDescription& joint) const override {
    checker.require(std::abs(joint.gearbox_ratio) >= 1e-3 && within(joint.gearbox_ratio, 1e3), "the gearbox ratio",
                    text(joint.gearbox_ratio), "1e-3 to 1e3 in absolute value");
    if (joint.gearbox_reference != "world") {
      checker.check_link_name(joint.gearbox_reference, "gearbox_reference_body");
    }
    for (const std::string& link : {joint.parent, joint.child}) {
      if (hinge_between(model, joint.gearbox_reference, link) != nullptr) continue;
      checker.report("a gearbox couples two hinges: '" + link + "' needs a revolute joint with the reference body '" +
                     joint.gearbox_reference + "'");
    }
    for (const AxisDescription& axis : joint.axes) {
      if (axis.motor != MotorMode::kNone || axis.mimic || axis.friction > 0 || axis.damping > 0 ||
          axis.spring_stiffness > 0 || std::isfinite(axis.lower) || std::isfinite(axis.upper)) {
        checker.report(
            "a gearbox cannot have a motor, limits, friction, damping or spring: set them on the hinges of its links");
        return;
      }
    }
  }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Gearbox>(world, description, site);
  }
};

template const JointKind& joint_kind<GearboxKind>();

}  // namespace bubblesim
