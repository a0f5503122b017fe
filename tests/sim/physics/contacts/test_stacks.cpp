// SPDX-License-Identifier: BSD-3-Clause
// Stacks, piles and shared loads: contacts that live over substeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "scenes.hpp"

namespace bubblesim::test::test_stacks {
namespace {

constexpr double kStep = 0.005;

ModelDescription cube(const std::string& name, double size, const Pose& pose) {
  ModelDescription made = model(name, link_with(Box{{size, size, size}}), pose);
  made.links[0].inertia_diagonal = Vector3(1, 1, 1) * (size * size / 6);
  return made;
}

ModelDescription ball(const std::string& name, double radius, const Pose& pose) {
  ModelDescription made = model(name, link_with(Sphere{radius}), pose);
  made.links[0].inertia_diagonal = Vector3(1, 1, 1) * (0.4 * radius * radius);
  return made;
}

std::string numbered(int number) { return "Thing" + std::to_string(number); }

SceneDescription stack(int count) {
  std::vector<ModelDescription> models{floor()};
  for (int i = 0; i < count; ++i) models.push_back(cube(numbered(i), 0.2, at(0, 0, 0.1 + 0.2 * i)));
  return scene(std::move(models));
}

/// Things dropped in layers of five by five with some disorder.
SceneDescription pile(bool of_balls, int count) {
  std::vector<ModelDescription> models{floor()};
  std::mt19937 random(1);
  const auto disorder = [&random] { return (static_cast<double>(random() % 1000) / 1000 - 0.5) * 0.04; };
  for (int i = 0; i < count; ++i) {
    const Pose pose(0.25 * (i % 5) + disorder(), 0.25 * (i / 5 % 5) + disorder(), 0.15 + 0.25 * (i / 25), disorder(),
                    disorder(), disorder());
    models.push_back(of_balls ? ball(numbered(i), 0.1, pose) : cube(numbered(i), 0.2, pose));
  }
  return scene(std::move(models));
}

double fastest(const World& world, int count) {
  double speed = 0;
  for (int i = 0; i < count; ++i) {
    speed = std::max(speed, world.velocity(world.tree().find("/" + numbered(i))).linear.norm());
  }
  return speed;
}

TEST(Stack, OfTenBoxesDoesNotMove) {
  World world(stack(10), 0);
  const ObjectId top = world.tree().find("/" + numbered(9));
  const Pose before = world.pose(top);
  world.advance(60, kStep);
  EXPECT_LT((world.pose(top).position - before.position).norm(), 2e-3);
}

TEST(Stack, OfTwentyBoxesStandsForTenMinutes) {
  World world(stack(20), 0);
  const ObjectId top = world.tree().find("/" + numbered(19));
  const Pose before = world.pose(top);
  world.advance(600, kStep);
  // It stands; each of its contacts settles within the millimetre by which rigid shapes overlap.
  EXPECT_LT((world.pose(top).position - before.position).norm(), 0.02);
}

TEST(Stack, OfTwelveBoxesDoesNotSwayAtItsStart) {
  World world(stack(12), 0);
  const ObjectId top = world.tree().find("/" + numbered(11));
  world.advance(1, kStep);
  EXPECT_LT(world.pose(top).position.head<2>().norm(), 2e-4);
}

/// Whether a stack of four stands whose upper boxes overhang by this part of their size.
bool stands(double overhang) {
  SceneDescription description = stack(4);
  for (std::size_t i = 2; i < description.models.size(); ++i) description.models[i].pose.position.x() = 0.2 * overhang;
  World world(description, 0);
  const ObjectId top = world.tree().find("/" + numbered(3));
  world.advance(1.5, kStep);
  return world.pose(top).position.z() > 0.65;
}

TEST(Stack, FallsOnceItsCentreOfMassIsBeyondTheEdge) {
  EXPECT_TRUE(stands(0.47));
  EXPECT_FALSE(stands(0.53));
}

TEST(Stack, SlidesDownASlopeAsOneBlock) {
  // a = g (sin - mu cos). The load stays within the base: mu times the height of the centre, 0.09 m, is below 0.1 m.
  const double slope = 0.35;
  const double mu = 0.3;
  SceneDescription description = stack(3);
  description.models[0].links[0].collisions[0].surface.mu = mu;
  description.gravity = Vector3(9.81 * std::sin(slope), 0, -9.81 * std::cos(slope));
  World world(description, 0);
  world.advance(1, kStep);
  const double expected = 9.81 * (std::sin(slope) - mu * std::cos(slope));
  for (int i = 0; i < 3; ++i) {
    const Vector3 velocity = world.velocity(world.tree().find("/" + numbered(i))).linear;
    EXPECT_NEAR(velocity.x(), expected, 0.01 * expected) << i;
    EXPECT_NEAR(velocity.z(), 0, 2e-3) << i;
  }
}

TEST(Stack, SlidesWhereFrictionIsLeast) {
  // Gravity with a horizontal part of 0.22 g: the top has mu 0.2 and slides, the others have mu 1 and stick. Nothing
  // topples: 0.22 times the height of the centre, 0.088 m, is below 0.1 m.
  SceneDescription description = stack(4);
  description.models[4].links[0].collisions[0].surface.mu = 0.2;
  description.gravity = Vector3(0.22 * 9.81, 0, -9.81);
  World world(description, 0);
  world.advance(0.2, kStep);
  const auto speed = [&](int i) { return world.velocity(world.tree().find("/" + numbered(i))).linear.x(); };
  EXPECT_NEAR(speed(3), 0.02 * 9.81 * 0.2, 0.02 * 0.02 * 9.81 * 0.2);
  EXPECT_NEAR(speed(2), 0, 1e-3);
}

TEST(Pile, OfBoxesComesToRest) {
  World world(pile(false, 200), 0);
  world.advance(5, kStep);
  EXPECT_LT(fastest(world, 200), 3e-3);
}

TEST(Pile, OfBallsKeepsNoEnergy) {
  World world(pile(true, 200), 0);
  world.advance(10, kStep);
  // Balls roll on the floor without resistance; none flies.
  double highest = 0;
  for (int i = 0; i < 200; ++i) {
    highest = std::max(highest, world.velocity(world.tree().find("/" + numbered(i))).linear.z());
  }
  EXPECT_LT(highest, 0.02);
}

}  // namespace
}  // namespace bubblesim::test::test_stacks
