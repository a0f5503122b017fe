// SPDX-License-Identifier: BSD-3-Clause
// Time stamps: a measurement has the time of the state that it shows (docs/time.md), in each phase of a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_time {
namespace {

constexpr double kSpeed = 10;    // m/s along x
constexpr double kTurning = 2;   // rad/s to the left
constexpr double kWall = 8;      // m, x of the wall's face
constexpr double kStep = 0.05;   // s
constexpr double kExact = 1e-6;  // m and rad
constexpr double kRounding = 1e-12;

/// A mover that starts at the origin with kSpeed, in front of a wall, with a lidar, a sonar, a depth camera and an IMU.
SceneDescription scene_of_mover(double update_rate) {
  LinkDescription body = link("link");
  const auto add = [&](const std::string& name, const auto& kind) {
    SensorDescription sensor;
    sensor.name = name;
    sensor.update_rate = update_rate;
    sensor.kind = kind;
    body.sensors.push_back(sensor);
  };
  LidarDescription lidar;
  lidar.max_range = 30;
  CameraDescription camera;
  camera.width = camera.height = 3;
  add("Lidar", lidar);
  add("Sonar", SonarDescription{0, 30, 0});
  add("Camera", camera);
  add("Imu", ImuDescription{});
  const ModelDescription wall = still(model("Wall", link_with(Box{{1, 40, 40}}), at(kWall + 0.5, 0, 0)));
  return scene({model("Mover", body), wall}, Vector3::Zero());
}

struct Mover {
  explicit Mover(double turning = 0, double update_rate = 0)
      : simulation(scene_of_mover(update_rate)), turning(turning) {
    simulation.world().set_velocity(find("/Mover"), {{kSpeed, 0, 0}, {0, 0, turning}});
  }

  ObjectId find(const std::string& path) const { return simulation.world().tree().find(path); }

  double heading(double time) const { return turning * time; }

  /// Checks a reading against the state at its time.
  void check(const Reading& reading) const {
    const double ahead = kWall - kSpeed * reading.time;
    const double yaw = heading(reading.time);
    if (const auto* scan = reading.measurement.get_if<LidarScan>()) {
      EXPECT_NEAR(scan->ranges.at(0) * std::cos(yaw), ahead, kExact) << "lidar at " << reading.time;
    } else if (const auto* echo = reading.measurement.get_if<ProximityReading>()) {
      EXPECT_NEAR(echo->distance * std::cos(yaw), ahead, kExact) << "sonar at " << reading.time;
    } else if (const auto* image = reading.measurement.get_if<CameraImage>()) {
      EXPECT_NEAR(image->depth.at(4) * std::cos(yaw), ahead, kExact) << "camera at " << reading.time;
    } else {
      const Quaternion& turned = reading.measurement.get<ImuReading>().orientation;
      EXPECT_NEAR(to_rpy(turned).z(), yaw, kExact) << "IMU at " << reading.time;
    }
  }

  /// Checks what the sensors return now, on request and at their rate; both must have the time `expected`.
  void check_all(double expected) {
    EXPECT_NEAR(simulation.world().pose(find("/Mover")).position.x(), kSpeed * expected, kRounding);
    EXPECT_NEAR(simulation.state_time(), expected, kRounding);
    for (const char* name : {"/Lidar", "/Sonar", "/Camera", "/Imu"}) {
      for (const auto& reading : {simulation.read(find(name)), simulation.measure(find(name))}) {
        EXPECT_EQ(reading->time, simulation.state_time()) << name;
        EXPECT_EQ(reading->time, simulation.reading_time(find(name))) << name;
        check(*reading);
      }
    }
  }

  Simulation simulation;
  double turning;
};

/// Calls functions in its phases.
struct Phases : System {
  void process_input() override {
    if (on_input) on_input();
  }
  void actuate(World&, double time) override {
    if (on_actuate) on_actuate(time);
  }
  void sense(const World&, double time) override {
    if (on_sense) on_sense(time);
  }
  void publish(const World&, double time) override {
    if (on_publish) on_publish(time);
  }
  std::function<void()> on_input;
  std::function<void(double)> on_actuate, on_sense, on_publish;
};

class Stamps : public ::testing::TestWithParam<double> {};

TEST_P(Stamps, AreTheTimeOfTheStateInEachPhase) {
  Mover mover(GetParam());
  Phases phases;
  double start = 0;
  const auto at_start = [&](double time) {
    EXPECT_EQ(time, mover.simulation.state_time());
    EXPECT_EQ(mover.simulation.time(), time);
    mover.check_all(start);
  };
  const auto at_end = [&](double time) {
    EXPECT_EQ(time, mover.simulation.state_time());
    EXPECT_NEAR(mover.simulation.time(), start, kRounding) << "constant during the step";
    mover.check_all(start + kStep);
  };
  phases.on_input = [&] { at_start(mover.simulation.time()); };
  phases.on_actuate = at_start;
  phases.on_sense = at_end;
  phases.on_publish = at_end;
  mover.simulation.add(phases);
  for (int i = 0; i < 10; ++i) {
    start = i * kStep;
    mover.simulation.process_input();  // as in a pause
    mover.check_all(start);
    mover.simulation.step();
  }
  mover.check_all(10 * kStep);
}

INSTANTIATE_TEST_SUITE_P(StraightAndTurning, Stamps, ::testing::Values(0.0, kTurning));

/// Times of the readings that a reader of each step sees, in 0.5 s.
std::vector<double> reading_times(Mover& mover) {
  std::vector<double> times;
  Phases phases;
  phases.on_sense = [&](double now) {
    const auto reading = mover.simulation.read(mover.find("/Lidar"));
    mover.check(*reading);
    EXPECT_EQ(reading->time, mover.simulation.reading_time(mover.find("/Lidar")));
    if (reading->time == now) times.push_back(now);
  };
  mover.simulation.add(phases);
  for (int i = 0; i < 10; ++i) mover.simulation.step();
  return times;
}

TEST(SensorWithARate, MeasuresAtMultiplesOfItsPeriod) {
  Mover mover(0, 10);
  mover.simulation.read(mover.find("/Lidar"));
  const std::vector<double> times = reading_times(mover);
  ASSERT_EQ(times.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(times[i], 0.1 * (i + 1), kRounding);
}

TEST(SensorWithARate, MeasuresBeforeItsFirstPeriodOnRequestOnly) {
  Mover mover(0, 10);
  const std::vector<double> times = reading_times(mover);
  ASSERT_EQ(times.size(), 6u);
  EXPECT_NEAR(times[0], kStep, kRounding) << "the first read";
  EXPECT_NEAR(times[1], 0.1, kRounding);
  EXPECT_NEAR(times[5], 0.5, kRounding);
}

TEST(SensorWithARate, OfAnAddedModelMeasuresAtMultiplesOfItsPeriodFromThen) {
  Simulation simulation(scene({floor()}));
  for (int i = 0; i < 3; ++i) simulation.step();
  const SceneDescription described = scene_of_mover(5);
  simulation.add_model(described.models[0]);
  const ObjectId lidar = simulation.world().tree().find("/Lidar");
  std::vector<double> times;
  for (int i = 0; i < 12; ++i) {
    simulation.read(lidar);
    simulation.step();
    if (simulation.reading_time(lidar) == simulation.state_time()) times.push_back(simulation.time());
  }
  ASSERT_EQ(times.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(times[i], 0.15 + 0.2 * (i + 1), kRounding);
}

TEST(SensorWithARate, StartsAgainWithTheTimeAndGoesOnAfterAResetOfTheWorld) {
  for (const bool all : {false, true}) {
    Mover mover(0, 5);
    const ObjectId lidar = mover.find("/Lidar");
    const auto step = [&] {
      mover.simulation.read(lidar);
      mover.simulation.step();
      return mover.simulation.reading_time(lidar) == mover.simulation.state_time();
    };
    for (int i = 0; i < 5; ++i) EXPECT_EQ(step(), i == 3);
    all ? mover.simulation.reset() : mover.simulation.reset_world();
    EXPECT_EQ(mover.simulation.read(lidar)->time, all ? 0 : 5 * kStep);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(step(), i == (all ? 3 : 2)) << i;
  }
}

TEST(OverriddenImage, IsNewAtTheRateOfTheCamera) {
  Mover mover(0, 10);
  const ObjectId camera = mover.find("/Camera");
  mover.simulation.override_image(camera, std::vector<std::uint8_t>(27, 9));
  EXPECT_EQ(mover.simulation.reading_time(camera), 0);
  for (int i = 1; i <= 4; ++i) {
    mover.simulation.step();
    EXPECT_EQ(mover.simulation.reading_time(camera) == mover.simulation.state_time(), i % 2 == 0) << i;
  }
  EXPECT_EQ(mover.simulation.read(camera)->measurement.get<CameraImage>().rgb.at(0), 9);
}

TEST(Noise, IsThatOfTheTimeOfTheState) {
  SceneDescription described = scene_of_mover(0);
  auto& lidar = described.models[0].links[0].sensors[0].kind.get<LidarDescription>();
  lidar.noise.stddev = 0.1;
  Simulation simulation(described);
  Phases phases;
  std::vector<float> sensed;
  const auto range = [&] {
    const auto reading = simulation.measure(simulation.world().tree().find("/Lidar"));
    return reading->measurement.get<LidarScan>().ranges.at(0);
  };
  phases.on_sense = [&](double) { sensed.push_back(range()); };
  simulation.add(phases);
  for (int i = 0; i < 3; ++i) {
    simulation.step();
    EXPECT_EQ(range(), sensed.back()) << "the same state between the steps";
  }
  EXPECT_NE(sensed[0], sensed[1]);
}

TEST(TimeStep, ChangedAfterThePhysicsIsThatOfTheNextStep) {
  Mover mover;
  Phases phases;
  phases.on_sense = [&](double) {
    if (mover.simulation.time() == 0) mover.simulation.set_time_step(0.02);
    EXPECT_NEAR(mover.simulation.state_time(), mover.simulation.time() + (mover.simulation.time() == 0 ? 0.05 : 0.02),
                kRounding);
  };
  mover.simulation.add(phases);
  mover.simulation.step();
  mover.check_all(0.05);
  mover.simulation.step();
  mover.check_all(0.07);
}

TEST(TimeStep, ChangedBeforeThePhysicsIsThatOfTheStep) {
  Mover mover;
  Phases phases;
  phases.on_actuate = [&](double time) {
    if (time == 0) mover.simulation.set_time_step(0.02);
  };
  mover.simulation.add(phases);
  mover.simulation.step();
  mover.check_all(0.02);
}

}  // namespace
}  // namespace bubblesim::test::test_time
