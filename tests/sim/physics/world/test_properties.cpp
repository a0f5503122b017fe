// SPDX-License-Identifier: BSD-3-Clause
// Mass, friction and gravity that are set while a world runs.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_properties {
namespace {

constexpr double kStep = 0.005;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string error_of(const std::function<void()>& set) {
  try {
    set();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// Two links with unequal moments of inertia and a driven hinge, which tumble.
ModelDescription robot(double mass) {
  ModelDescription made = model("Robot", link("base"), at(0, 0, 1));
  made.links.push_back(link("arm", {0.5, 0, 0}));
  for (LinkDescription& part : made.links) {
    part.mass = mass;
    part.centre_of_mass = {0.1, 0, 0.05};
    part.inertia_diagonal = Vector3(0.1, 0.2, 0.25) * mass;
    part.inertia_products = Vector3(0.01, 0.02, 0) * mass;
    part.collisions.push_back(shape(Box{{0.3, 0.2, 0.1}}));
  }
  made.joints.push_back(joint("revolute", {axis(Vector3::UnitY(), MotorMode::kVelocity)}, {0.25, 0, 0}));
  made.joints[0].axes[0].lower = -kInfinity;
  made.joints[0].axes[0].upper = kInfinity;
  made.joints[0].axes[0].max_force = 3;
  return made;
}

void run(World& world, int steps) {
  const ObjectId hinge = world.tree().find("/joint");
  const ObjectId base = world.tree().find("/base");
  for (int i = 0; i < steps; ++i) {
    world.joints().set_target_velocity(hinge, std::sin(0.1 * i));
    world.wrenches().apply(base, {{1, 0.2, 0}, {0.3, 0.1, 0.2}});
    world.advance(kStep, kStep);
  }
}

TEST(Properties, AChangedMassIsLikeThatOfTheDescription) {
  World heavy(scene({floor(), robot(2)}), 1);
  World light(scene({floor(), robot(1)}), 1);
  const ObjectId model = light.tree().find("/Robot");
  EXPECT_EQ(light.properties().mass(model), 2);
  light.properties().set_mass(model, 4);
  EXPECT_EQ(light.properties().mass(model), 4);
  EXPECT_EQ(light.properties().mass(light.tree().find("/arm")), 2);
  run(heavy, 300);
  run(light, 300);
  EXPECT_EQ(light.state_hash(), heavy.state_hash());
}

TEST(Properties, AMassChangesTheAccelerationAndNotTheCentre) {
  World world(scene({robot(1)}, Vector3::Zero()), 1);
  const ObjectId base = world.tree().find("/base");
  const Pose before = world.pose(base);
  run(world, 20);
  world.reset();
  world.properties().set_mass(base, 3);
  EXPECT_EQ(world.pose(base), before);
  EXPECT_EQ(world.properties().mass(world.tree().find("/Robot")), 4);
  world.wrenches().apply(base, {{8, 0, 0}, {}});
  world.wrenches().apply(world.tree().find("/arm"), {{0, 0, 0}, {}});
  world.advance(kStep, kStep);
  double momentum = 0;
  for (const char* name : {"/base", "/arm"}) {
    const ObjectId link = world.tree().find(name);
    const Twist twist = world.velocity(link);
    const Vector3 lever = world.pose(link).orientation * Vector3(0.1, 0, 0.05);
    momentum += world.properties().mass(link) * (twist.linear + twist.angular.cross(lever)).x();
  }
  EXPECT_NEAR(momentum, 8 * kStep, 1e-9);
}

/// Acceleration of a block on a slope, m/s^2.
double slide(double mu, double angle, bool jointed) {
  ModelDescription block = model("Block", link_with(Box{{0.4, 0.4, 0.1}}, 0.9), at(0, 0, 0.05));
  if (jointed) {
    block.links.push_back(link("arm"));
    block.links[0].name = "base";
    block.joints.push_back(joint("fixed", {}));
  }
  World world(scene({floor(0.9), block}), 1);
  const ObjectId id = world.tree().find("/Block");
  for (int i = 0; i < 200; ++i) world.advance(kStep, kStep);
  world.properties().set_gravity(Vector3(std::sin(angle), 0, -std::cos(angle)) * 9.81);
  world.properties().set_friction(id, mu);
  EXPECT_EQ(world.properties().friction(id), mu);
  for (int i = 0; i < 20; ++i) world.advance(kStep, kStep);
  const double before = world.velocity(id).linear.x();
  for (int i = 0; i < 100; ++i) world.advance(kStep, kStep);
  return (world.velocity(id).linear.x() - before) / (100 * kStep);
}

TEST(Properties, AChangedFrictionFollowsCoulombsLaw) {
  const double angle = 0.5;
  for (const bool jointed : {false, true}) {
    EXPECT_NEAR(slide(0.2, angle, jointed), 9.81 * (std::sin(angle) - 0.2 * std::cos(angle)), 0.02);
    EXPECT_NEAR(slide(0.7, angle, jointed), 0, 0.01);
  }
}

TEST(Properties, TheFrictionOfAStaticModelCanBeSet) {
  World world(scene({floor(0.9), model("Block", link_with(Box{{0.4, 0.4, 0.1}}), at(0, 0, 0.05))}), 1);
  world.properties().set_friction(world.tree().find("/Floor"), 0);
  world.properties().set_gravity({3, 0, -9.81});
  for (int i = 0; i < 100; ++i) world.advance(kStep, kStep);
  EXPECT_NEAR(world.velocity(world.tree().find("/Block")).linear.x(), 3 * 100 * kStep, 0.02);
}

TEST(Properties, AnotherGravityWakesWhatSleeps) {
  World world(scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 0.5))}), 1);
  for (int i = 0; i < 400; ++i) world.advance(kStep, kStep);
  world.properties().set_gravity({0, 0, 2});
  EXPECT_EQ(world.properties().gravity().z(), 2);
  for (int i = 0; i < 200; ++i) world.advance(kStep, kStep);
  EXPECT_NEAR(world.velocity(world.tree().find("/Box")).linear.z(), 2.0 * 200 * kStep, 0.05);
}

TEST(Properties, AResetPutsAllBack) {
  for (const bool other_models : {false, true}) {
    World world(scene({floor(), robot(1)}), 1);
    if (other_models) world.models().add(model("Ball", link_with(Sphere{0.1}), at(3, 0, 0.1)));
    world.reset();
    const std::uint64_t start = world.state_hash();
    run(world, 60);
    const std::uint64_t expected = world.state_hash();
    world.properties().set_gravity({0, 1, -1});
    world.properties().set_mass(world.tree().find("/Robot"), 5);
    world.properties().set_friction(world.tree().find("/Robot"), 0.1);
    world.properties().set_friction(world.tree().find("/Floor"), 0.1);
    run(world, 60);
    world.reset();
    EXPECT_EQ(world.state_hash(), start);
    EXPECT_EQ(world.properties().gravity().z(), -9.81);
    EXPECT_EQ(world.properties().mass(world.tree().find("/Robot")), 2);
    EXPECT_EQ(world.properties().friction(world.tree().find("/Floor")), 1);
    run(world, 60);
    EXPECT_EQ(world.state_hash(), expected);
  }
}

TEST(Properties, RefuseValuesThatCannotBeUsed) {
  World world(scene({floor(), robot(1)}), 1);
  const ObjectId robot = world.tree().find("/Robot");
  for (const double bad : {0.0, -1.0, kNaN, kInfinity, 2e6}) {
    EXPECT_TRUE(has(error_of([&] { world.properties().set_mass(robot, bad); }), "/Robot: the mass"));
  }
  for (const double bad : {-0.1, kNaN}) {
    EXPECT_TRUE(has(error_of([&] { world.properties().set_friction(robot, bad); }), "/Robot: the friction"));
  }
  for (const double bad : {kNaN, kInfinity, 2e4}) {
    EXPECT_TRUE(has(error_of([&] { world.properties().set_gravity({0, 0, bad}); }), "gravity"));
  }
  const ObjectId hinge = world.tree().find("/joint");
  EXPECT_TRUE(has(error_of([&] { world.properties().set_mass(hinge, 1); }), "is a joint: it has no mass"));
  EXPECT_TRUE(has(error_of([&] { world.properties().set_friction(hinge, 1); }), "is a joint: it has no friction"));
  EXPECT_TRUE(has(error_of([&] { world.properties().set_mass(world.tree().find("/Floor"), 1); }), "static"));
  World bare(jointed(joint("fixed", {})), 1);
  EXPECT_TRUE(
      has(error_of([&] { bare.properties().set_friction(bare.tree().find("/Robot"), 1); }), "has no collisions"));
}

}  // namespace
}  // namespace bubblesim::test::test_properties
