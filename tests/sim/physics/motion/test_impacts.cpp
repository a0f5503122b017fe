// SPDX-License-Identifier: BSD-3-Clause
// Fast bodies stop at thin ones, and bounce off them at their full speed.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/world.hpp"
#include "meshes/made_meshes.hpp"
#include "polyhedra.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_impacts {
namespace {

constexpr double kStep = 0.005;
const Vector3 kNoGravity = Vector3::Zero();

ModelDescription body(const std::string& name, const Geometry& geometry, const Pose& pose, double restitution = 0) {
  ModelDescription made = model(name, link_with(geometry), pose);
  made.links[0].inertia_diagonal = Vector3::Ones() * 0.001;
  Surface& surface = made.links[0].collisions[0].surface;
  surface.restitution = restitution;
  surface.bounce_threshold = 0.01;
  return made;
}

/// A wall of 5 cm, whose front is at x = 0.
ModelDescription wall(const Geometry& geometry = Box{{0.05, 2, 2}}, double restitution = 0) {
  return still(body("Wall", geometry, at(0.025, 0, 0), restitution));
}

struct Flight {
  Vector3 place;
  Twist velocity;
};

/// A body that flies towards the wall at 20 m/s, after 0.2 s. `phase` moves its start.
Flight after_impact(const ModelDescription& obstacle, const Geometry& geometry, double restitution, double phase,
                    const Twist& velocity = {{20, 0, 0}, {}}) {
  World world(scene({obstacle, body("Body", geometry, at(-1 - phase, 0.01, 0.02), restitution)}, kNoGravity), 0);
  const ObjectId id = world.tree().find("/Body");
  world.set_velocity(id, velocity);
  world.advance(0.2, kStep);
  return {world.pose(id).position, world.velocity(id)};
}

std::vector<Geometry> small_bodies() {
  return {Sphere{0.05},         Box{{0.05, 0.05, 0.05}},      Capsule{0.02, 0.1},
          Cylinder{0.03, 0.05}, box_mesh({0.05, 0.05, 0.05}), Mesh{hull_mesh(icosahedron(0.05))}};
}

std::vector<Geometry> walls() {
  TriangleMesh sheet;  // of two triangles, at x = -0.025 in its frame
  sheet.vertices = {{-0.025F, -1, -1}, {-0.025F, -1, 1}, {-0.025F, 1, 1}, {-0.025F, 1, -1}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {Box{{0.05, 2, 2}}, box_mesh({0.05, 2, 2}), Mesh{finish_mesh(std::move(sheet))}};
}

TEST(Impact, ABodyAt20MetresASecondStopsAtAThinWall) {
  for (const Geometry& obstacle : walls()) {
    for (const Geometry& geometry : small_bodies()) {
      for (int i = 0; i < 10; ++i) {
        const Flight flight = after_impact(wall(obstacle), geometry, 0, 0.01 * i);
        EXPECT_LT(flight.place.x(), 0) << "wall " << obstacle.index() << ", body " << geometry.index() << ", phase "
                                       << i;
        EXPECT_LT(std::abs(flight.velocity.linear.x()), 1);
      }
    }
  }
}

TEST(Impact, ABallBouncesWithItsFullSpeed) {
  for (const double restitution : {0.5, 0.9, 1.0}) {
    for (int i = 0; i < 10; ++i) {
      const Flight flight = after_impact(wall(Box{{0.05, 2, 2}}, restitution), Sphere{0.05}, restitution, 0.013 * i);
      EXPECT_NEAR(flight.velocity.linear.x(), -20 * restitution, 1e-5);
      // It loses less than a substep of its way.
      const double free = 1 + 0.013 * i - 0.05;
      const double expected = -0.05 - 20 * restitution * (0.2 - free / 20);
      EXPECT_NEAR(flight.place.x(), expected, 20 * kStep);
    }
  }
}

TEST(Impact, KeepsTheEnergyOfAFallingBall) {
  // Restitution 1 from 50 m at 31 m/s: it comes back to its height within the substep's error of the integration.
  World world(
      scene({still(body("Floor", Box{{4, 4, 0.02}}, at(0, 0, -0.01), 1)), body("Ball", Sphere{0.05}, at(0, 0, 50), 1)}),
      0);
  const ObjectId ball = world.tree().find("/Ball");
  const double before = 9.81 * 50;
  for (int i = 0; i < 400; ++i) {
    world.advance(0.05, kStep);
    const double v = world.velocity(ball).linear.z();
    const double now = v * v / 2 + 9.81 * world.pose(ball).position.z();
    EXPECT_NEAR(now, before, 0.01 * before) << 0.05 * i;
  }
}

TEST(Impact, TwoFastBallsMeet) {
  // Equal masses with restitution 1 exchange their velocities.
  for (int i = 0; i < 10; ++i) {
    World world(scene({body("A", Sphere{0.05}, at(-1, 0, 0), 1), body("B", Sphere{0.05}, at(1 + 0.02 * i, 0, 0), 1)},
                      kNoGravity),
                0);
    const ObjectId a = world.tree().find("/A");
    const ObjectId b = world.tree().find("/B");
    world.set_velocity(a, {{30, 0, 0}, {}});
    world.set_velocity(b, {{-20, 0, 0}, {}});
    world.advance(0.1, kStep);
    EXPECT_NEAR(world.velocity(a).linear.x(), -20, 1e-6);
    EXPECT_NEAR(world.velocity(b).linear.x(), 30, 1e-6);
  }
}

TEST(Impact, APlateThatMovesIsHit) {
  // A plate of 1 cm flies against the ball; momentum is kept.
  World world(
      scene({body("Plate", Box{{0.01, 0.4, 0.4}}, at(0, 0, 0)), body("Ball", Sphere{0.05}, at(-1, 0, 0))}, kNoGravity),
      0);
  const ObjectId plate = world.tree().find("/Plate");
  const ObjectId ball = world.tree().find("/Ball");
  world.set_velocity(ball, {{20, 0, 0}, {}});
  world.set_velocity(plate, {{-10, 0, 0}, {}});
  world.advance(0.2, kStep);
  EXPECT_NEAR(world.velocity(ball).linear.x() + world.velocity(plate).linear.x(), 10, 1e-9);
  EXPECT_LT(world.pose(ball).position.x(), world.pose(plate).position.x());
}

TEST(Impact, ASpinningRodStopsAtAPost) {
  // A rod of 1 m by 2 cm turns at 40 rad/s: its tip moves 10 cm in a substep, past a post of 2 cm.
  World world(
      scene({still(body("Post", Box{{0.02, 0.02, 1}}, at(0, 0.45, 0))), body("Rod", Box{{1, 0.02, 0.02}}, at(0, 0, 0))},
            kNoGravity),
      0);
  const ObjectId rod = world.tree().find("/Rod");
  world.set_velocity(rod, {{}, {0, 0, 40}});
  for (int i = 0; i < 40; ++i) {
    world.advance(kStep, kStep);
    const double spin = world.velocity(rod).angular.z();
    if (spin < 20) return;  // it hit the post
  }
  FAIL() << "the rod passed through the post";
}

TEST(Impact, AJointedLinkStopsAtAWallAndItsJointStaysClosed) {
  // A hammer on a hinge: its head of 6 cm moves 15 cm in a substep towards a wall of 2 cm.
  ModelDescription hammer = model("Hammer", link("base"), at(0, 0, 1));
  LinkDescription head = link("arm", {0, 0, -0.6});
  head.collisions.push_back(shape(Box{{0.06, 0.06, 0.06}}));
  head.inertia_diagonal = Vector3::Ones() * 0.001;
  hammer.links.push_back(head);
  hammer.joints.push_back(joint("revolute", {axis({0, 1, 0})}, {0, 0, 0.6}));
  hammer.joints[0].pose = Pose();
  JointDescription anchor = joint("fixed", {}, {}, "world", "base");
  anchor.name = "anchor";
  hammer.joints.push_back(anchor);
  World world(scene({still(body("Wall", Box{{0.02, 1, 1}}, at(-0.36, 0, 0.5))), hammer}), 0);
  const ObjectId arm = world.tree().find("/Hammer/arm");
  world.set_velocity(arm, {{-30, 0, 0}, {0, 50, 0}});
  for (int i = 0; i < 20; ++i) {
    world.advance(kStep, kStep);
    const Vector3 at_head = world.pose(arm).position;
    EXPECT_GT(at_head.x(), -0.36) << i;
    // A quarter of a radian in a substep opens the joint by 1 - cos along the tangent.
    EXPECT_NEAR((at_head - Vector3(0, 0, 1)).norm(), 0.6, 0.04) << i;
  }
}

TEST(Impact, ABoxThatSlidesFastDoesNotCatchOnLevelTiles) {
  // v^2 / (2 mu g), across tiles of 0.5 m of a floor, at up to 10 cm in a substep.
  std::vector<ModelDescription> models;
  for (int i = 0; i < 60; ++i) {
    models.push_back(still(body("Tile" + std::to_string(i), Box{{0.5, 1, 0.1}}, at(0.5 * i, 0, -0.05))));
  }
  ModelDescription slider = body("Slider", Box{{0.1, 0.1, 0.05}}, at(0, 0.013, 0.025));
  slider.links[0].collisions[0].surface.mu = 0.5;
  models.push_back(slider);
  World world(scene(std::move(models)), 0);
  const ObjectId id = world.tree().find("/Slider");
  world.advance(0.2, kStep);
  world.set_velocity(id, {{15, 0, 0}, {}});
  world.advance(4, kStep);
  EXPECT_NEAR(world.pose(id).position.x(), 15 * 15 / (2 * 0.5 * 9.81), 1);
}

}  // namespace
}  // namespace bubblesim::test::test_impacts
