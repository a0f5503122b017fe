// SPDX-License-Identifier: BSD-3-Clause
// Stacks, piles and shared loads: contacts that live over substeps.
#include <gtest/gtest.h>

#include <algorithm>
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
