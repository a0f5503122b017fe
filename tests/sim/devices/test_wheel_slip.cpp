// SPDX-License-Identifier: BSD-3-Clause
// The speeds of a wheel that is held upright, turns at a constant rate and is pushed, compared with the law of its
// slip.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/wheel_slip.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_wheel_slip {
namespace {

constexpr double kStep = 0.002;
constexpr double kRadius = 0.2;
constexpr double kRate = 5;         // rad/s
constexpr double kForce = 8;        // N
constexpr double kLoad = 4 * 9.81;  // N: links of 1 kg

/// The wheel's axle may move up and down, along x and along y.
ModelDescription rig(double mu) {
  ModelDescription made = model("Rig", link("lift"), at(0, 0, kRadius));
  made.links.push_back(link("forth"));
  made.links.push_back(link("aside"));
  made.links.push_back(link_with(Sphere{kRadius}, mu));
  made.links.back().name = "wheel";
  made.joints = {joint("prismatic", {axis(Vector3::UnitZ())}, {}, "world", "lift"),
                 joint("prismatic", {axis(Vector3::UnitX())}, {}, "lift", "forth"),
                 joint("prismatic", {axis(Vector3::UnitY())}, {}, "forth", "aside"),
                 joint("continuous", {axis(Vector3::UnitY(), MotorMode::kVelocity)}, {}, "aside", "wheel")};
  const std::vector<std::string> names = {"up", "along", "across", "axle"};
  for (std::size_t i = 0; i < names.size(); ++i) made.joints[i].name = names[i];
  made.joints.back().axes[0].target = kRate;
  return made;
}

struct Rig {
  explicit Rig(const SlipCompliance& compliance, Solver solver = Solver::kBubblesim, double mu = 1)
      : description(scene({floor(), rig(mu)})) {
    description.solver = solver;
    world = std::make_unique<World>(description, 0);
    const ObjectId axle = world->tree().find("/Rig/axle");
    slip = std::make_shared<WheelSlip>(*world, std::vector<SlippingWheel>{{axle, kRadius, kLoad, compliance}});
    world->devices().add(slip, world->tree().find("/Rig"));
  }

  /// The velocity of the axle when it has become constant.
  Vector3 pushed(const Vector3& force) {
    const ObjectId wheel = world->tree().find("/Rig/wheel");
    for (int i = 0; i < 1000; ++i) {
      world->wrenches().apply(wheel, {force, {}});
      world->advance(kStep, kStep);
    }
    return world->velocity(wheel).linear;
  }

  SceneDescription description;
  std::unique_ptr<World> world;
  std::shared_ptr<WheelSlip> slip;
};

class Slipping : public testing::TestWithParam<Solver> {};

TEST_P(Slipping, LosesSpeedByTheComplianceTimesTheForceRatio) {
  const double slip = 0.5 * kForce / kLoad;  // (r w - v) / (r w)
  Rig rig({0, 0.5}, GetParam());
  const Vector3 velocity = rig.pushed({-kForce, 0, 0});
  EXPECT_NEAR(velocity.x(), kRadius * kRate * (1 - slip), 2e-3);
  EXPECT_NEAR(velocity.y(), 0, 1e-3);
  EXPECT_NEAR((rig.slip->slip(*rig.world, 0) - Vector3(-slip, 0, 1) * kRadius * kRate).norm(), 0, 3e-3);
}

TEST_P(Slipping, DriftsSidewaysByTheComplianceTimesTheForceRatio) {
  Rig rig({0.7, 0}, GetParam());
  const Vector3 velocity = rig.pushed({0, kForce, 0});
  EXPECT_NEAR(velocity.y(), 0.7 * kForce / kLoad * kRadius * kRate, 2e-3) << "the tangent of the slip angle";
  EXPECT_NEAR(velocity.x(), kRadius * kRate, 2e-3);
}

TEST_P(Slipping, IsLimitedByTheFriction) {
  Rig rig({0, 0.1}, GetParam(), 0.1);
  EXPECT_LT(rig.pushed({-kForce, 0, 0}).x(), -1) << "8 N against 0.1 times 39 N: it is pushed away";
}

INSTANTIATE_TEST_SUITE_P(Solvers, Slipping, testing::Values(Solver::kBubblesim, Solver::kOde));

TEST(WheelSlip, IsNoneAtRest) {
  Rig rig({5, 5});
  rig.world->joints().set_target_velocity(rig.world->tree().find("/Rig/axle"), 0);
  EXPECT_NEAR(rig.pushed({-kForce, kForce, 0}).norm(), 0, 1e-3);
}

TEST(WheelSlip, ChangesWhileItRunsUntilAReset) {
  Rig rig({0, 0});
  const double rolling = kRadius * kRate;
  EXPECT_NEAR(rig.pushed({-kForce, 0, 0}).x(), rolling, 2e-3);
  rig.slip->set_compliance({}, 0.5);
  EXPECT_EQ(rig.slip->compliance(0).lateral, 0);
  EXPECT_NEAR(rig.pushed({-kForce, 0, 0}).x(), rolling * (1 - 0.5 * kForce / kLoad), 2e-3);
  rig.world->reset();
  EXPECT_EQ(rig.slip->compliance(0).longitudinal, 0);
  EXPECT_NEAR(rig.pushed({-kForce, 0, 0}).x(), rolling, 2e-3);
}

TEST(WheelSlip, RefusesWhatIsNoWheel) {
  Rig rig({0, 0});
  const World& world = *rig.world;
  const auto made = [&](const std::string& joint, double radius, double load, double compliance) {
    WheelSlip(world, {{world.tree().find("/Rig/" + joint), radius, load, {compliance, 0}}});
  };
  EXPECT_THROW(made("along", 0.1, 10, 0), WrongObject);
  EXPECT_THROW(made("axle", 0, 10, 0), InvalidInput);
  EXPECT_THROW(made("axle", 0.1, -1, 0), InvalidInput);
  EXPECT_THROW(made("axle", 0.1, 10, -1), InvalidInput);
  EXPECT_THROW(made("axle", 0.1, kNaN, 0), InvalidInput);
  EXPECT_THROW(rig.slip->set_compliance(kInfinity, {}), InvalidInput);
  EXPECT_THROW(rig.world->properties().set_slip(world.tree().find("/Rig"), Vector3::UnitX(), 0, 0), WrongObject);
  EXPECT_THROW(rig.world->properties().set_slip(world.tree().find("/Rig/lift"), Vector3::UnitX(), 0, 0), WrongObject);
  const ObjectId wheel = world.tree().find("/Rig/wheel");
  EXPECT_THROW(rig.world->properties().set_slip(wheel, Vector3(), 0, 0), InvalidInput);
  EXPECT_THROW(rig.world->properties().set_slip(wheel, Vector3::UnitX(), -1, 0), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_wheel_slip
