// SPDX-License-Identifier: BSD-3-Clause
// Combined parameters of two touching surfaces, compared with theory.
#include <gtest/gtest.h>

#include "physics/contacts/surface_pair.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_surfaces {
namespace {

constexpr double kStep = 0.005;
constexpr double kLayer = 0.001;  // m, overlap of rigid contacts

ModelDescription thing(Geometry geometry, const Surface& surface, const Pose& pose) {
  ModelDescription made = model("Thing", link_with(std::move(geometry)), pose);
  made.links[0].collisions[0].surface = surface;
  return made;
}

ModelDescription ground(const Surface& surface) {
  ModelDescription made = floor();
  made.links[0].collisions[0].surface = surface;
  return made;
}

struct Fall {
  Fall(const Surface& of_thing, const Surface& of_ground, Geometry geometry, const Pose& pose)
      : world(scene({ground(of_ground), thing(std::move(geometry), of_thing, pose)}), 0) {}
  World world;
  ObjectId id = world.tree().find("/Thing");
};

Surface bouncy(double restitution, double threshold) {
  Surface surface;
  surface.restitution = restitution;
  surface.bounce_threshold = threshold;
  return surface;
}

/// The height after the first bounce of a ball that is dropped from 1 m above its rest position.
double rebound(const Surface& ball, const Surface& ground) {
  Fall fall(ball, ground, Sphere{0.1}, at(0, 0, 1.1));
  double highest = 0;
  bool has_touched = false;
  for (int i = 0; i < 200; ++i) {
    fall.world.advance(kStep, kStep);
    const double height = fall.world.pose(fall.id).position.z() - 0.1;
    has_touched = has_touched || height < 0.02;
    if (has_touched) highest = std::max(highest, height);
  }
  return highest;
}

TEST(Bounce, RestitutionIsTheRatioOfSpeeds) {
  for (const double e : {0.5, 0.9}) EXPECT_NEAR(rebound(bouncy(e, 0.01), bouncy(e, 0.01)), e * e, 0.06) << e;
}

TEST(Bounce, LowerRestitutionOfTheTwoCounts) {
  EXPECT_LT(rebound(bouncy(0.9, 0.01), Surface{}), 0.05);
  EXPECT_NEAR(rebound(bouncy(0.9, 0.01), bouncy(0.5, 0.01)), 0.25, 0.06);
}

TEST(Bounce, SlowThingsDoNotBounce) { EXPECT_LT(rebound(bouncy(0.9, 6), bouncy(0.9, 6)), 0.05); }

TEST(Softness, ThingSinksInByItsWeight) {
  Surface soft;
  soft.kp = 1000;
  soft.kd = 20;
  Fall alone(soft, Surface{}, Sphere{0.3}, at(0, 0, 0.3));
  alone.world.advance(3, kStep);
  EXPECT_NEAR(0.3 - alone.world.pose(alone.id).position.z(), 9.81 / 1000 + kLayer, 1e-4);
  Fall both(soft, soft, Sphere{0.3}, at(0, 0, 0.3));
  both.world.advance(3, kStep);
  EXPECT_NEAR(0.3 - both.world.pose(both.id).position.z(), 9.81 / 500 + kLayer, 1e-4) << "two springs in series";
}

TEST(Softness, StiffContactsAreRigid) {
  for (const double kp : {1e6, 1e9, 1e13}) {
    Surface stiff;
    stiff.kp = kp;
    stiff.kd = 1;
    stiff.max_vel = 0.01;
    stiff.min_depth = 0.003;
    Fall fall(stiff, Surface{}, Box{{1, 1, 0.4}}, at(0, 0, 0.21));
    fall.world.advance(2, kStep);
    EXPECT_NEAR(fall.world.pose(fall.id).position.z(), 0.2 - 0.0015, 0.0016) << "within its min_depth, " << kp;
  }
}

TEST(MaxVel, OverlappingShapesPartThatFast) {
  Surface quick;
  quick.max_vel = 0.5;
  SceneDescription described =
      scene({still(thing(Sphere{0.5}, quick, at(0.7, 0, 0))), model("Ball", link_with(Sphere{0.5}))}, Vector3::Zero());
  World world(described, 0);
  world.advance(2 * kStep, kStep);
  EXPECT_NEAR(world.velocity(world.tree().find("/Ball")).linear.norm(), 0.5, 0.05);
}

/// Velocity of a box a second after it was pushed along x and y over the ground.
Vector3 pushed(const Surface& of_box, const Surface& of_ground, const Pose& pose) {
  Fall fall(of_box, of_ground, Box{{0.5, 0.5, 0.1}}, pose);
  fall.world.advance(0.5, kStep);
  fall.world.set_velocity(fall.id, {{3, 3, 0}, {}});
  fall.world.advance(0.5, kStep);
  return fall.world.velocity(fall.id).linear;
}

Surface slippery_along(const Vector3& direction) {
  Surface surface;
  surface.mu = 0;
  surface.mu2 = 0.5;
  surface.fdir1 = direction;
  return surface;
}

TEST(FrictionDirection, MuCountsAlongItAndMu2Across) {
  const Vector3 velocity = pushed(slippery_along(Vector3::UnitX()), Surface{}, at(0, 0, 0.05));
  EXPECT_NEAR(velocity.x(), 3, 0.02);
  EXPECT_NEAR(velocity.y(), 3 - 0.5 * 9.81 * 0.5, 0.1) << "v = v0 - mu g t";
}

TEST(FrictionDirection, TurnsWithTheShape) {
  const Vector3 velocity = pushed(slippery_along(Vector3::UnitX()), Surface{}, Pose(0, 0, 0.05, 0, 0, M_PI / 2));
  EXPECT_NEAR(velocity.y(), 3, 0.02);
  EXPECT_LT(velocity.x(), 1);
}

TEST(Slip, LetsThingsSlideAtASpeedByTheForce) {
  Surface slips;
  slips.fdir1 = Vector3::UnitX();
  slips.slip1 = 0.2;
  // On a slope of 0.1 rad; four contacts side by side slip a quarter as much.
  const Quaternion tilt = from_rpy(0, 0.1, 0);
  ModelDescription slope = still(model("Slope", link_with(Box{{40, 4, 1}}), Pose(Vector3::Zero(), tilt)));
  ModelDescription box = thing(Sphere{0.2}, slips, Pose(tilt * Vector3(0, 0, 0.7), tilt));
  box.links[0].inertia_diagonal = Vector3(1e3, 1e3, 1e3);  // does not roll
  World world(scene({slope, box}), 0);
  world.advance(3, kStep);
  EXPECT_NEAR(world.velocity(world.tree().find("/Thing")).linear.norm(), 0.2 * 9.81 * std::sin(0.1), 0.01);
}

class Belt : public testing::TestWithParam<Solver> {
 protected:
  static World built(const std::vector<ModelDescription>& models) {
    SceneDescription described = scene(models);
    described.solver = GetParam();
    return World(described, 0);
  }
};

/// A box with corners, which does not turn.
ModelDescription crate(const Vector3& size, double mu, const Pose& pose) {
  ModelDescription made = model("Crate", link_with(Box{size}, mu), pose);
  made.links[0].inertia_diagonal = Vector3(10, 10, 10);
  return made;
}

TEST_P(Belt, CarriesWhatLiesOnIt) {
  World world = built({still(model("Belt", link_with(Box{{20, 2, 0.2}}), at(0, 0, -0.1))),
                       crate({0.3, 0.3, 0.3}, 0.2, at(0, 0, 0.15))});
  world.advance(0.2, kStep);
  world.properties().set_belt(world.tree().find("/Belt/link"), Vector3::UnitY(), 0.8);
  world.advance(0.2, kStep);
  const ObjectId crate = world.tree().find("/Crate");
  EXPECT_NEAR(world.velocity(crate).linear.x(), 0.2 * 9.81 * 0.2, 0.03) << "mu g t";
  world.advance(1, kStep);
  EXPECT_NEAR(world.velocity(crate).linear.x(), 0.8, 1e-3);
  world.properties().set_belt(world.tree().find("/Belt/link"), Vector3::UnitY(), 0);
  world.advance(1, kStep);
  EXPECT_NEAR(world.velocity(crate).linear.x(), 0, 1e-3);
}

TEST_P(Belt, DrivesItsVehicleAhead) {
  World world = built({floor(), crate({0.5, 0.3, 0.2}, 1, Pose(0, 0, 0.1, 0, 0, M_PI / 2))});
  const ObjectId crate = world.tree().find("/Crate");
  world.properties().set_belt(world.tree().find("/Crate/link"), {0, 2, 0}, 0.5);
  world.advance(2, kStep);
  EXPECT_NEAR((world.velocity(crate).linear - Vector3(0, 0.5, 0)).norm(), 0, 2e-3) << "along its own x";
  world.reset();
  world.advance(1, kStep);
  EXPECT_NEAR(world.velocity(crate).linear.norm(), 0, 1e-3);
}

TEST_P(Belt, OfAPlaneCarriesWhatLiesOnIt) {
  World world = built({floor(), crate({0.3, 0.3, 0.3}, 0.5, at(0, 0, 0.15))});
  world.properties().set_belt(world.tree().find("/Floor/link"), Vector3::UnitX(), 0.4);
  world.advance(1, kStep);
  EXPECT_NEAR(world.velocity(world.tree().find("/Crate")).linear.y(), -0.4, 1e-3) << "x axis x normal";
}

INSTANTIATE_TEST_SUITE_P(Solvers, Belt, testing::Values(Solver::kBubblesim, Solver::kOde));

TEST(BeltOfAWorld, NeedsALinkWithCollisionsAndAnAxis) {
  World world(scene({floor(), model("A", link("link"))}), 0);
  WorldProperties& properties = world.properties();
  EXPECT_THROW(properties.set_belt(world.tree().find("/Floor"), Vector3::UnitY(), 1), WrongObject);
  EXPECT_THROW(properties.set_belt(world.tree().find("/A/link"), Vector3::UnitY(), 1), WrongObject);
  EXPECT_THROW(properties.set_belt(world.tree().find("/Floor/link"), Vector3::Zero(), 1), InvalidInput);
  EXPECT_THROW(properties.set_belt(world.tree().find("/Floor/link"), Vector3::UnitY(), kInfinity), InvalidInput);
}

TEST(Torsion, BrakesASpinInPlace) {
  Surface rough;
  rough.torsion = 0.02;
  Fall fall(rough, Surface{}, Sphere{0.3}, at(0, 0, 0.3));
  fall.world.advance(0.2, kStep);
  fall.world.set_velocity(fall.id, {{}, {0, 0, 1}});
  fall.world.advance(1, kStep);
  EXPECT_NEAR(fall.world.velocity(fall.id).angular.z(), 1 - 0.02 * 9.81, 0.01) << "w = w0 - torsion m g t / I";
}

TEST(CollideWithoutContact, LetsThingsThrough) {
  Surface ghost;
  ghost.collide_without_contact = true;
  Fall fall(ghost, Surface{}, Sphere{0.3}, at(0, 0, 0.3));
  fall.world.advance(1, kStep);
  EXPECT_LT(fall.world.pose(fall.id).position.z(), -4);
}

TEST(SurfacePair, DoesNotDependOnTheOrder) {
  Surface a = bouncy(0.3, 2);
  a.mu = 0.4;
  a.kp = 2e4;
  a.slip1 = 0.1;
  Surface b = slippery_along(Vector3::UnitY());
  b.kd = 7;
  const dSurfaceParameters one = combine(a, b, kStep).ode;
  const dSurfaceParameters other = combine(b, a, kStep).ode;
  EXPECT_EQ(one.mode, other.mode);
  EXPECT_EQ(one.mu, other.mu);
  EXPECT_EQ(one.mu2, other.mu2);
  EXPECT_EQ(one.soft_erp, other.soft_erp);
  EXPECT_EQ(one.soft_cfm, other.soft_cfm);
  EXPECT_EQ(one.bounce, other.bounce);
}

}  // namespace
}  // namespace bubblesim::test::test_surfaces
