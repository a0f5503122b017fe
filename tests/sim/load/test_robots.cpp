// SPDX-License-Identifier: BSD-3-Clause
// The installed robots move according to the geometry of their wheels.
#include <gtest/gtest.h>

#include <algorithm>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_robots {
namespace {

/// An installed scene without obstacles for its robot.
SceneDescription open_field(const std::string& name) {
  SceneDescription scene = read_scene(name);
  const auto in_the_way = [](const ModelDescription& m) { return m.name == "Room"; };
  scene.models.erase(std::remove_if(scene.models.begin(), scene.models.end(), in_the_way), scene.models.end());
  return scene;
}

/// A circle in the x-y plane.
struct Circle {
  double x = 0;
  double y = 0;
  double radius = 0;
};

/// The least-squares circle of points: (x-a)^2 + (y-b)^2 = r^2, about the points' mean.
Circle fit_circle(const std::vector<Vector3>& points) {
  Vector3 mean;
  for (const Vector3& point : points) mean += point / static_cast<double>(points.size());
  double uu = 0, uv = 0, vv = 0, uz = 0, vz = 0, z = 0;
  for (const Vector3& point : points) {
    const double u = point.x() - mean.x();
    const double v = point.y() - mean.y();
    const double square = u * u + v * v;
    uu += u * u;
    uv += u * v;
    vv += v * v;
    uz += u * square / 2;
    vz += v * square / 2;
    z += square / static_cast<double>(points.size());
  }
  const double determinant = uu * vv - uv * uv;
  const double a = (uz * vv - vz * uv) / determinant;
  const double b = (vz * uu - uz * uv) / determinant;
  return {mean.x() + a, mean.y() + b, std::sqrt(a * a + b * b + z)};
}

constexpr double kWheelbase = 1;
constexpr double kWheelRadius = 0.3;

class Tricycle : public ::testing::Test {
 protected:
  void steer(double angle) { world().joints().set_target_position(world().tree().find("/Steering"), angle); }
  void drive(double wheel_speed) {
    world().joints().set_target_velocity(world().tree().find("/FrontMotor"), wheel_speed);
  }
  void run(double duration) {
    for (int i = 0; i < std::lround(duration / simulation.time_step()); ++i) simulation.step();
  }
  World& world() { return simulation.world(); }
  Pose pose() { return world().pose(robot); }

  Simulation simulation{open_field("tricycle")};
  ObjectId robot = world().tree().find("/Tricycle");  // its frame is the middle of the rear axle, on the ground
};

TEST_F(Tricycle, TurnsAboutThePointWhereItsAxlesMeet) {
  constexpr double kSteering = M_PI / 6;
  constexpr double kSpeed = 0.5;  // m/s, of the front wheel's centre
  steer(kSteering);
  run(2);
  drive(kSpeed / kWheelRadius);
  run(3);
  const double radius = kWheelbase / std::tan(kSteering);
  const double front_radius = kWheelbase / std::sin(kSteering);
  const double lap = 2 * M_PI * front_radius / kSpeed;
  std::vector<Vector3> track;
  for (double time = 0; time < lap; time += simulation.time_step()) {
    run(simulation.time_step());
    track.push_back(pose().position);
  }
  const Circle circle = fit_circle(track);
  EXPECT_NEAR(circle.radius, radius, radius * 1e-3);
  for (const Vector3& point : track) {
    EXPECT_NEAR(std::hypot(point.x() - circle.x, point.y() - circle.y), circle.radius, radius * 1e-3)
        << "it is a circle";
  }
  EXPECT_LT((track.front() - track.back()).norm(), 0.05) << "a lap takes its time";
}

TEST_F(Tricycle, PositiveSteeringTurnsLeft) {
  steer(0.3);
  drive(2);
  run(3);
  EXPECT_GT(to_rpy(pose().orientation).z(), 0.2);
}

TEST_F(Tricycle, RollsAsFarAsItsWheelTurns) {
  constexpr double kWheelSpeed = 2;
  drive(kWheelSpeed);
  run(2);
  const Vector3 start = pose().position;
  run(10);
  const double distance = kWheelRadius * kWheelSpeed * 10;
  EXPECT_NEAR(pose().position.x() - start.x(), distance, distance * 5e-4);
  // The wheel spins at the start, which turns the tricycle by less than a milliradian.
  EXPECT_NEAR(pose().position.y(), start.y(), distance * 1e-3) << "straight on";
}

TEST_F(Tricycle, StandsStillWithoutACommand) {
  run(1);
  const Vector3 start = pose().position;
  run(20);
  EXPECT_LT((pose().position - start).norm(), 1e-3);
  EXPECT_NEAR(pose().position.z(), 0, 2e-3) << "on its wheels";
}

TEST_F(Tricycle, DrivesBackwardsToo) {
  drive(-2);
  run(3);
  EXPECT_LT(pose().position.x(), -2.5 - 1);
}

TEST(TricycleSonar, MeasuresTheDistanceToAWallAhead) {
  SceneDescription scene = open_field("tricycle");
  scene.models.push_back(still(model("Wall", link_with(Box{{0.2, 40, 2}}, 1, 2), at(1, 0, 1))));
  Simulation simulation(scene);
  World& world = simulation.world();
  const ObjectId sonar = world.tree().find("/FrontSonar");
  constexpr double kFace = 0.9;        // x of the wall's near side
  constexpr double kSonarAhead = 1.4;  // of the robot's frame
  for (const double distance : {0.03, 0.5, 1.25, 2.49}) {
    world.set_pose(world.tree().find("/Tricycle"), at(kFace - distance - kSonarAhead, 0, 0));
    const ProximityReading reading = simulation.measure_proximity(sonar);
    EXPECT_TRUE(reading.detected) << distance;
    EXPECT_NEAR(reading.distance, distance, 1e-4);
  }
  world.set_pose(world.tree().find("/Tricycle"), at(kFace - 2.51 - kSonarAhead, 0, 0));
  EXPECT_FALSE(simulation.measure_proximity(sonar).detected) << "beyond its range";
}

TEST(BubbleRob, CirclesAboutItsRightWheelWhenOnlyTheLeftTurns) {
  Simulation simulation(open_field("bubblerob"));
  World& world = simulation.world();
  const ObjectId robot = world.tree().find("/rosInterfaceControlledBubbleRob");
  constexpr double kTrack = 0.2;
  constexpr double kRadius = 0.04;
  constexpr double kWheelSpeed = 3;
  for (int i = 0; i < 20; ++i) simulation.step();
  const Vector3 right_before = world.pose(world.tree().find("/right_wheel")).position;
  world.joints().set_target_velocity(world.tree().find("/rosInterfaceControlledBubbleRobLeftMotor"), kWheelSpeed);
  std::vector<Vector3> track;
  const double lap = 2 * M_PI * kTrack / (kRadius * kWheelSpeed);
  while (simulation.time() < 1 + lap) {
    simulation.step();
    track.push_back(world.pose(world.tree().find("/left_wheel")).position);
    const Vector3 right = world.pose(world.tree().find("/right_wheel")).position;
    EXPECT_LT((right - right_before).norm(), 5e-3) << "the right wheel stays";
  }
  const Circle circle = fit_circle(track);
  EXPECT_NEAR(circle.radius, kTrack, kTrack * 5e-3);
  EXPECT_NEAR(circle.x, right_before.x(), 3e-3);
  EXPECT_NEAR(circle.y, right_before.y(), 3e-3);
  EXPECT_LT(to_rpy(world.pose(robot).orientation).z(), 0.5) << "nearly round: it turns to the right";
}

}  // namespace
}  // namespace bubblesim::test::test_robots
