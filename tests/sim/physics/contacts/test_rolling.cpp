// SPDX-License-Identifier: BSD-3-Clause
// Resistance to rolling and spinning, compared with theory, in each of the solvers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_rolling {
namespace {

constexpr double kG = 9.81;  // m/s^2
constexpr double kStep = 0.005;
constexpr double kRadius = 0.1;
constexpr double kDegree = M_PI / 180;

Vector3 heading(double degrees) { return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0}; }

/// A body of 2 kg that rolls on a shape of 0.1 m. With `jointed`, the exact solver solves it, as it does robots.
ModelDescription roller(Geometry geometry, double inertia, const Surface& surface, bool jointed, const Pose& pose) {
  LinkDescription solid = link("link");
  solid.mass = 2;
  solid.inertia_diagonal = Vector3(1, 1, 1) * (inertia * 2 * kRadius * kRadius);
  solid.collisions.push_back(shape(std::move(geometry)));
  solid.collisions[0].surface = surface;
  ModelDescription made = model("Roller", solid, pose);
  if (!jointed) return made;
  LinkDescription core = link("core");
  core.mass = 1e-4;
  core.inertia_diagonal = Vector3(1, 1, 1) * 1e-8;
  made.links.push_back(core);
  made.joints.push_back(joint("fixed", {}, {}, "link", "core"));
  return made;
}

ModelDescription ball(double rolling, bool jointed) {
  Surface surface;
  surface.rolling = rolling;
  return roller(Sphere{kRadius}, 0.4, surface, jointed, at(0, 0, kRadius));
}

ModelDescription lying_cylinder(double rolling, bool jointed, double direction) {
  Surface surface;
  surface.rolling = rolling;
  const Quaternion lying = from_rpy(0, 0, direction * kDegree) * from_rpy(M_PI / 2, 0, 0);
  return roller(Cylinder{kRadius, 0.2}, 0.5, surface, jointed, Pose(Vector3(0, 0, kRadius), lying));
}

/// The change of the velocity within a second of a body that rolls at 3 m/s.
Vector3 slowed(ModelDescription rolls, double direction) {
  World world(scene({floor(), std::move(rolls)}), 0);
  world.advance(0.5, kStep);
  const ObjectId id = world.tree().find("/Roller");
  const Vector3 velocity = heading(direction) * 3;
  world.set_velocity(id, {velocity, Vector3::UnitZ().cross(velocity) / kRadius});
  world.advance(0.2, kStep);
  const Vector3 before = world.velocity(id).linear;
  world.advance(1, kStep);
  return before - world.velocity(id).linear;
}

/// m a = F and I a / r = k m g - F r, with I = inertia m r^2.
double deceleration(double rolling, double inertia) { return rolling * kG / (kRadius * (1 + inertia)); }

class RollingResistance : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Rolling, RollingResistance, testing::Bool(),
                         [](const auto& info) { return info.param ? "Exact" : "Own"; });

TEST_P(RollingResistance, SlowsABallAlikeInAnyDirection) {
  for (const double rolling : {0.001, 0.01}) {
    for (const double direction : {0.0, 20.0, 45.0, 70.0, 135.0}) {
      const Vector3 change = slowed(ball(rolling, GetParam()), direction);
      const double theory = deceleration(rolling, 0.4);
      EXPECT_NEAR(change.dot(heading(direction)), theory, 0.01 * theory) << rolling << " " << direction;
      EXPECT_NEAR(change.cross(heading(direction)).norm(), 0, 0.01 * theory) << rolling << " " << direction;
    }
  }
}

TEST_P(RollingResistance, SlowsACylinder) {
  for (const double direction : {0.0, 30.0, 45.0}) {
    const double theory = deceleration(0.005, 0.5);
    const Vector3 change = slowed(lying_cylinder(0.005, GetParam(), direction), direction);
    EXPECT_NEAR(change.dot(heading(direction)), theory, 0.02 * theory) << direction;
  }
}

TEST_P(RollingResistance, HoldsABallOnASlopeUpToItsAngle) {
  const double rolling = 0.01;
  const double angle = std::atan(rolling / kRadius);
  for (const double direction : {0.0, 30.0, 45.0, 100.0}) {
    const auto gained = [&](double slope) {
      const Vector3 gravity = (heading(direction) * std::sin(slope) - Vector3::UnitZ() * std::cos(slope)) * kG;
      World world(scene({floor(), ball(rolling, GetParam())}, gravity), 0);
      world.advance(0.5, kStep);
      const ObjectId id = world.tree().find("/Roller");
      const double before = world.velocity(id).linear.norm();
      world.advance(1, kStep);
      return world.velocity(id).linear.norm() - before;
    };
    EXPECT_LT(gained(0.98 * angle), 1e-4) << direction;
    for (const double slope : {1.05 * angle, 2 * angle}) {
      const double theory = kG * (std::sin(slope) - rolling / kRadius * std::cos(slope)) / 1.4;
      EXPECT_NEAR(gained(slope), theory, 0.02 * theory + 0.02 * kG * std::sin(angle) / 1.4) << direction;
    }
  }
}

TEST_P(RollingResistance, StopsABallAndDoesNotTurnItBack) {
  World world(scene({floor(), ball(0.02, GetParam())}), 0);
  world.advance(0.5, kStep);
  const ObjectId id = world.tree().find("/Roller");
  const Vector3 start = world.pose(id).position;
  world.set_velocity(id, {{0.6, 0.8, 0}, {-8, 6, 0}});
  world.advance(2, kStep);
  const double theory = 1 / (2 * deceleration(0.02, 0.4));
  EXPECT_NEAR((world.pose(id).position - start).norm(), theory, 0.02 * theory);
  EXPECT_LT(world.velocity(id).linear.cross(Vector3::UnitZ()).norm(), 1e-9);
}

/// A cart on free wheels; many of them need the iterative solver.
double cart_deceleration(int pairs) {
  const double mass = 50;
  LinkDescription base = link("base", {0, 0, kRadius});
  base.mass = mass;
  base.inertia_diagonal = {10, 10, 10};
  ModelDescription made = model("Cart", base);
  for (int i = 0; i < 2 * pairs; ++i) {
    const std::string name = "wheel" + std::to_string(i);
    const Vector3 place(0.25 * (i / 2) - 0.125 * (pairs - 1), i % 2 == 0 ? 0.3 : -0.3, kRadius);
    LinkDescription wheel = link(name, place);
    wheel.mass = 0.1;
    wheel.inertia_diagonal = Vector3(1, 1, 1) * (0.4 * 0.1 * kRadius * kRadius);
    wheel.collisions.push_back(shape(Sphere{kRadius}));
    wheel.collisions[0].surface.rolling = 0.005;
    made.links.push_back(wheel);
    made.joints.push_back(joint("revolute", {axis(Vector3::UnitY())}, place, "base", name));
    made.joints.back().name = name + "_axle";
  }
  World world(scene({floor(), made}), 0);
  world.advance(0.5, kStep);
  world.set_velocity(world.tree().find("/base"), {{3, 0, 0}, {}});
  for (int i = 0; i < 2 * pairs; ++i) {
    world.set_velocity(world.tree().find("/wheel" + std::to_string(i)), {{3, 0, 0}, {0, 3 / kRadius, 0}});
  }
  world.advance(0.2, kStep);
  const double before = world.velocity(world.tree().find("/base")).linear.x();
  world.advance(1, kStep);
  const double total = mass + 0.1 * 2 * pairs;
  const double theory = 0.005 / kRadius * total * kG / (total + 0.4 * 0.1 * 2 * pairs);
  return (before - world.velocity(world.tree().find("/base")).linear.x()) / theory;
}

TEST(Rolling, SlowsACartInTheExactAndTheIterativeSolver) {
  EXPECT_NEAR(cart_deceleration(2), 1, 0.01);
  EXPECT_NEAR(cart_deceleration(22), 1, 0.03);  // 44 contacts
}

/// Grounds of 8 m with their surface at z = 0.
std::vector<ModelDescription> grounds() {
  // A mesh that moves collides as convex parts; this one is too heavy to move.
  ModelDescription heavy = model("Ground", link_with(box_mesh({8, 8, 1})), at(0, 0, -0.5));
  heavy.links[0].mass = 1e6;
  heavy.links[0].inertia_diagonal = Vector3(1, 1, 1) * 1e7;
  return {still(model("Ground", link_with(Plane{}))), still(model("Ground", link_with(Box{{8, 8, 1}}), at(0, 0, -0.5))),
          still(model("Ground", link_with(Cylinder{4, 1}), at(0, 0, -0.5))),
          still(model("Ground", link_with(box_mesh({8, 8, 1})), at(0, 0, -0.5))), heavy};
}

TEST_P(RollingResistance, RoundShapesRollWithTheirRadiusOnAnyGround) {
  for (const ModelDescription& ground : grounds()) {
    for (const Geometry& geometry :
         {Geometry(Sphere{kRadius}), Geometry(Cylinder{kRadius, 0.2}), Geometry(Capsule{kRadius, 0.2})}) {
      // ODE finds one point of a long shape on a cylinder, and of a capsule on a box: they rock.
      const Geometry& below = ground.links[0].collisions[0].geometry;
      if (std::holds_alternative<Cylinder>(below) && !std::holds_alternative<Sphere>(geometry)) continue;
      if (std::holds_alternative<Box>(below) && std::holds_alternative<Capsule>(geometry)) continue;
      const Quaternion lying = from_rpy(M_PI / 2, 0, 0);
      ModelDescription rolls = roller(geometry, 0.4, {}, GetParam(), Pose(Vector3(-2, 0.03, kRadius), lying));
      World world(scene({ground, still(model("Base", link_with(Plane{}), at(0, 0, -1))), rolls}), 0);
      world.advance(0.5, kStep);
      const ObjectId id = world.tree().find("/Roller");
      world.set_velocity(id, {{1, 0, 0}, {0, 1 / kRadius, 0}});
      world.advance(1, kStep);
      const Twist velocity = world.velocity(id);
      EXPECT_NEAR(velocity.linear.x() / (velocity.angular.y() * kRadius), 1, 1e-5)
          << below.index() << " " << geometry.index();
    }
  }
}

TEST_P(RollingResistance, TorsionLeavesFrictionAlikeInAllDirections) {
  Surface surface;
  surface.mu = 0.5;
  surface.torsion = 0.001;
  for (const double direction : {0.0, 45.0}) {
    const double slope = 35 * kDegree;
    const Vector3 gravity = (heading(direction) * std::sin(slope) - Vector3::UnitZ() * std::cos(slope)) * kG;
    ModelDescription box = roller(Box{{0.2, 0.2, 0.1}}, 0.4, surface, GetParam(), at(0, 0, 0.05));
    World world(scene({floor(), box}, gravity), 0);
    world.advance(0.5, kStep);
    const ObjectId id = world.tree().find("/Roller");
    const double before = world.velocity(id).linear.norm();
    world.advance(1, kStep);
    const double theory = kG * (std::sin(slope) - 0.5 * std::cos(slope));
    EXPECT_NEAR(world.velocity(id).linear.norm() - before, theory, 0.02 * theory) << direction;
  }
}

TEST_P(RollingResistance, TorsionByDepthFollowsThePatchOfASphere) {
  Surface soft;
  soft.torsion_by_depth = 0.3;
  soft.kp = 5000;
  soft.kd = 50;
  World world(scene({floor(), roller(Sphere{kRadius}, 0.4, soft, GetParam(), at(0, 0, kRadius))}), 0);
  world.advance(1, kStep);
  const ObjectId id = world.tree().find("/Roller");
  const double depth = kRadius - world.pose(id).position.z();
  world.set_velocity(id, {{}, {0, 0, 50}});
  world.advance(0.2, kStep);
  const double before = world.velocity(id).angular.z();
  world.advance(0.2, kStep);
  const double theory = 0.3 * std::sqrt(depth) * 2 * kG / (0.4 * 2 * kRadius * kRadius);
  EXPECT_NEAR((before - world.velocity(id).angular.z()) / 0.2, theory, 0.02 * theory);
}

}  // namespace
}  // namespace bubblesim::test::test_rolling
