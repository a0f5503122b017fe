// SPDX-License-Identifier: BSD-3-Clause
// The simulation step: phases, clock, sensor updates, and repeatability.
#include <gtest/gtest.h>

#include <functional>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_simulation {
namespace {

using Log = std::vector<std::pair<std::string, double>>;

/// Records the calls of its phases.
class Recorder : public System {
 public:
  Recorder(std::string name, Log& log, const Simulation& simulation)
      : name_(std::move(name)), log_(log), simulation_(simulation) {}

  void process_input() override { log_.emplace_back(name_ + " process_input", simulation_.time()); }
  void actuate(World&, double time) override { log_.emplace_back(name_ + " actuate", time); }
  void sense(const World&, double time) override { log_.emplace_back(name_ + " sense", time); }
  void publish(const World&, double time) override { log_.emplace_back(name_ + " publish", time); }

 private:
  std::string name_;
  Log& log_;
  const Simulation& simulation_;
};

/// Calls functions in its phases.
struct Caller : System {
  void actuate(World& world, double time) override {
    if (on_actuate) on_actuate(world, time);
  }
  void sense(const World& world, double time) override {
    if (on_sense) on_sense(world, time);
  }
  std::function<void(World&, double)> on_actuate;
  std::function<void(const World&, double)> on_sense;
};

TEST(Pass, RunsItsPhasesInOrderForAllParticipants) {
  Simulation simulation(scene({floor()}));
  Log log;
  Recorder first("a", log, simulation);
  Recorder second("b", log, simulation);
  simulation.add(first);
  simulation.add(second);
  simulation.step();
  // The time is that of the state: after the physics the end of the step.
  const Log expected = {{"a process_input", 0}, {"b process_input", 0}, {"a actuate", 0},    {"b actuate", 0},
                        {"a sense", 0.05},      {"b sense", 0.05},      {"a publish", 0.05}, {"b publish", 0.05}};
  EXPECT_EQ(log, expected);
}

TEST(Pass, PhysicsRunBetweenActuationAndSensing) {
  Simulation simulation(scene({model("Ball", link("link"))}, {1, 0, 0}));
  const ObjectId ball = simulation.world().tree().find("/Ball");
  std::vector<double> speeds;
  Caller caller;
  caller.on_actuate = [&](World& world, double) { speeds.push_back(world.velocity(ball).linear.x()); };
  caller.on_sense = [&](const World& world, double) { speeds.push_back(world.velocity(ball).linear.x()); };
  simulation.add(caller);
  simulation.step();
  ASSERT_EQ(speeds.size(), 2u);
  EXPECT_EQ(speeds[0], 0);
  EXPECT_NEAR(speeds[1], 0.05, 1e-12);
}

TEST(Clock, IsANumberOfPassesAndDoesNotDrift) {
  Simulation simulation(scene({floor()}));
  EXPECT_EQ(simulation.time(), 0);
  for (int i = 0; i < 2000; ++i) simulation.step();
  EXPECT_EQ(simulation.time(), 2000 * 0.05);
}

TEST(Drain, MovesNothing) {
  Simulation simulation(scene({model("Ball", link("link"))}));
  Log log;
  Recorder recorder("a", log, simulation);
  simulation.add(recorder);
  const std::uint64_t before = simulation.state_hash();
  simulation.process_input();
  EXPECT_EQ(log, (Log{{"a process_input", 0}}));
  EXPECT_EQ(simulation.state_hash(), before);
}

constexpr double kExact = 1e-4;                  // m, of rays
constexpr double kExactInSteps = kExact / 0.05;  // for a motion of 1 m/s

/// A sonar that looks along x at a sphere, which starts 5 m away and approaches with 1 m/s: the distance shows the time
/// of the measurement.
SceneDescription approach(double update_rate) {
  ModelDescription eye = still(model("Eye", link("link")));
  SensorDescription sonar;
  sonar.name = "Sonar";
  sonar.update_rate = update_rate;
  sonar.kind = SonarDescription{0, 10, 0};
  eye.links[0].sensors.push_back(sonar);
  ModelDescription ball = model("Ball", link_with(Sphere{1}), at(6, 0, 0));
  return scene({eye, ball}, Vector3::Zero());
}

struct Approach {
  explicit Approach(double update_rate) : simulation(approach(update_rate)) {
    simulation.world().set_velocity(simulation.world().tree().find("/Ball"), {{-1, 0, 0}, {}});
  }
  /// Age of the sensor's measurement in steps.
  double age_in_steps() {
    const double measured_at = 5 - simulation.read_proximity(sonar).distance;
    return (simulation.time() - measured_at) / simulation.time_step();
  }

  Simulation simulation;
  ObjectId sonar = simulation.world().tree().find("/Sonar");
};

TEST(Sensor, WithoutARateMeasuresInEveryPass) {
  Approach approach(0);
  for (int i = 0; i < 30; ++i) {
    approach.simulation.step();
    EXPECT_NEAR(approach.age_in_steps(), 0, kExactInSteps);
  }
}

class SensorRate : public ::testing::TestWithParam<std::pair<double, int>> {};

TEST_P(SensorRate, MeasuresOnceInItsPeriod) {
  const auto [rate, steps] = GetParam();
  Approach approach(rate);
  approach.age_in_steps();  // the sensor has a reader from now on
  for (int i = 0; i < 60; ++i) {
    approach.simulation.step();
    EXPECT_NEAR(approach.age_in_steps(), (i + 1) % steps, kExactInSteps) << "rate " << rate << " step " << i;
  }
}

// A step is 1/20 s; higher rates are not possible.
INSTANTIATE_TEST_SUITE_P(Rates, SensorRate,
                         ::testing::Values(std::pair(20.0, 1), std::pair(10.0, 2), std::pair(5.0, 4),
                                           std::pair(2.0, 10), std::pair(1000.0, 1)));

TEST(SensorRateThatDoesNotDivideTheClock, IsKeptOnAverage) {
  Approach approach(3);
  approach.age_in_steps();
  int measured = 0;
  for (int i = 0; i < 200; ++i) {
    approach.simulation.step();
    if (std::abs(approach.age_in_steps()) < kExactInSteps) ++measured;
    if (approach.simulation.time() > 4.5) break;  // it would pass through the sensor
  }
  EXPECT_NEAR(measured, 3 * 4.5, 1);
}

TEST(SensorThatNobodyReads, MeasuresWhenItIsAsked) {
  Approach approach(1);
  for (int i = 0; i < 33; ++i) approach.simulation.step();
  // A measurement at its due time, 1.0 s, would be old.
  EXPECT_NEAR(approach.age_in_steps(), 0, kExactInSteps);
  approach.simulation.step();
  EXPECT_NEAR(approach.age_in_steps(), 1, kExactInSteps) << "now it measures with its rate again";
}

TEST(Measuring, IsIndependentOfTheRate) {
  Approach approach(1);
  approach.age_in_steps();
  for (int i = 0; i < 5; ++i) approach.simulation.step();
  EXPECT_NEAR(approach.simulation.measure_proximity(approach.sonar).distance, 5 - 0.25, kExact);
}

TEST(Reading, HoldsWhatWasSeen) {
  Approach approach(0);
  const ProximityReading reading = approach.simulation.read_proximity(approach.sonar);
  EXPECT_TRUE(reading.detected);
  EXPECT_NEAR(reading.distance, 5, kExact);
  EXPECT_LT((reading.point - Vector3(5, 0, 0)).norm(), kExact);
  EXPECT_LT((reading.normal - Vector3(-1, 0, 0)).norm(), kExact);
  EXPECT_EQ(reading.object, approach.simulation.world().tree().find("/Ball/link"));
}

TEST(Reading, OfNothingIsEmpty) {
  Approach approach(0);
  approach.simulation.world().set_pose(approach.simulation.world().tree().find("/Ball"), at(50, 0, 0));
  const ProximityReading reading = approach.simulation.read_proximity(approach.sonar);
  EXPECT_FALSE(reading.detected);
  EXPECT_EQ(reading.distance, 0);
  EXPECT_EQ(reading.object, kNoObject);
}

TEST(Reading, OfWhatIsNoSensorIsRefused) {
  Approach approach(0);
  const ObjectId ball = approach.simulation.world().tree().find("/Ball");
  EXPECT_THROW(approach.simulation.read_proximity(ball), WrongObject);
  EXPECT_THROW(approach.simulation.measure_proximity(kNoObject), NoSuchObject);
}

TEST(Sonar, DoesNotSeeItsOwnModel) {
  SceneDescription described = approach(0);
  described.models[0].links[0].collisions.push_back(shape(Box{{1, 1, 1}}));
  described.models[0].links[0].collisions[0].pose.position = {2, 0, 0};
  Simulation simulation(described);
  EXPECT_NEAR(simulation.read_proximity(simulation.world().tree().find("/Sonar")).distance, 5, kExact);
}

TEST(Sonar, SeesNothingNearerThanItsMinimalRange) {
  SceneDescription described = approach(0);
  described.models[0].links[0].sensors[0].kind.get<SonarDescription>().min_range = 5.5;
  Simulation simulation(described);
  EXPECT_FALSE(simulation.read_proximity(simulation.world().tree().find("/Sonar")).detected);
}

TEST(Sonar, SeesWhatStandsAsideWithinItsCone) {
  for (const double side : {0.9, 1.2}) {
    SceneDescription described = approach(0);
    described.models[0].links[0].sensors[0].kind.get<SonarDescription>().half_angle = 0.3;
    // A thin post at the edge of the cone: 3 m ahead, off the axis by the angle.
    described.models[1] = still(model("Post", link_with(Cylinder{0.1, 4}), at(3, 3 * std::tan(0.3 * side), 0)));
    Simulation simulation(described);
    const ProximityReading reading = simulation.read_proximity(simulation.world().tree().find("/Sonar"));
    EXPECT_EQ(reading.detected, side < 1) << side;
  }
}

std::uint64_t hash_of_a_run(std::uint64_t seed) {
  std::vector<ModelDescription> models{floor()};
  for (int i = 0; i < 4; ++i) {
    models.push_back(model("Box" + std::to_string(i), link_with(Box{{0.5, 0.4, 0.3}}),
                           Pose(0.1 * i, 0, 0.5 + 0.6 * i, 0.3 * i, 0.2, 0)));
  }
  Simulation simulation(scene(models), seed);
  for (int i = 0; i < 40; ++i) simulation.step();
  return simulation.state_hash();
}

TEST(SameSeed, GivesTheSameStateInTwentyRuns) {
  const std::uint64_t first = hash_of_a_run(7);
  for (int run = 1; run < 20; ++run) EXPECT_EQ(hash_of_a_run(7), first);
}

/// Boxes that fall on each other, and a sonar that is read.
SceneDescription tumble() {
  SceneDescription described = approach(3);
  described.gravity = {0, 0, -9.81};
  described.models.push_back(floor());
  for (int i = 0; i < 3; ++i) {
    described.models.push_back(model("Box" + std::to_string(i), link_with(Box{{0.5, 0.4, 0.3}}),
                                     Pose(8 + 0.1 * i, 0, 0.5 + 0.6 * i, 0.3 * i, 0.2, 0)));
  }
  return described;
}

/// Hash and sonar distance after each of some steps.
std::vector<std::pair<std::uint64_t, double>> history(Simulation& simulation) {
  const ObjectId sonar = simulation.world().tree().find("/Sonar");
  std::vector<std::pair<std::uint64_t, double>> seen;
  for (int i = 0; i < 30; ++i) {
    simulation.step();
    seen.emplace_back(simulation.state_hash(), simulation.read_proximity(sonar).distance);
  }
  return seen;
}

TEST(Reset, IsFollowedByWhatFollowsInANewSimulation) {
  Simulation simulation(tumble(), 7);
  const std::uint64_t start = simulation.state_hash();
  const auto first = history(simulation);
  EXPECT_NE(simulation.state_hash(), start);
  simulation.reset();
  EXPECT_EQ(simulation.time(), 0);
  EXPECT_EQ(simulation.state_hash(), start);
  EXPECT_EQ(history(simulation), first);
}

TEST(ResetWorld, KeepsTheTime) {
  Simulation simulation(tumble());
  const std::uint64_t start = simulation.world().state_hash();
  history(simulation);
  simulation.reset_world();
  EXPECT_DOUBLE_EQ(simulation.time(), 1.5);
  EXPECT_EQ(simulation.world().state_hash(), start);
}

TEST(ResetWorld, LetsSensorsForgetWhatTheySawAndKeepTheirRate) {
  Approach approach(1);
  approach.age_in_steps();
  for (int i = 0; i < 30; ++i) approach.simulation.step();
  approach.simulation.reset_world();
  EXPECT_NEAR(approach.simulation.read_proximity(approach.sonar).distance, 5, kExact);
  const ObjectId ball = approach.simulation.world().tree().find("/Ball");
  approach.simulation.world().set_velocity(ball, {{-1, 0, 0}, {}});
  for (int i = 30; i < 39; ++i) approach.simulation.step();
  EXPECT_NEAR(approach.simulation.read_proximity(approach.sonar).distance, 5, kExact);
  approach.simulation.step();  // to 2 s
  EXPECT_NEAR(approach.simulation.read_proximity(approach.sonar).distance, 5 - 10 * 0.05, kExact);
}

/// Calls a function in its process_input().
struct Drainer : System {
  void process_input() override {
    if (on_drain) on_drain();
  }
  std::function<void()> on_drain;
};

TEST(Reset, TakesEffectAtOnceWhileDraining) {
  Simulation simulation(tumble());
  history(simulation);
  Drainer drainer;
  drainer.on_drain = [&] { simulation.reset(); };
  Caller caller;
  std::vector<double> times;
  caller.on_actuate = [&](World&, double time) { times.push_back(time); };
  simulation.add(drainer);
  simulation.add(caller);
  simulation.step();
  EXPECT_EQ(times, std::vector<double>{0});
  EXPECT_EQ(simulation.time(), 0.05);
}

TEST(Reset, IsRefusedInTheMiddleOfAPass) {
  Simulation simulation(tumble());
  Caller caller;
  caller.on_actuate = [&](World&, double) {
    EXPECT_THROW(simulation.reset(), std::logic_error);
    EXPECT_THROW(simulation.reset_world(), std::logic_error);
    EXPECT_THROW(simulation.step(), std::logic_error);
  };
  simulation.add(caller);
  simulation.step();
  EXPECT_EQ(simulation.time(), 0.05);
}

TEST(Reset, MakesADivergedSimulationUsableAgain) {
  Simulation simulation(scene({model("Ball", link("link"), at(999999, 0, 0))}, {1e4, 0, 0}));
  EXPECT_THROW(for (int i = 0; i < 100; ++i) simulation.step(), Diverged);
  simulation.reset();
  EXPECT_EQ(simulation.state_hash(),
            Simulation(scene({model("Ball", link("link"), at(999999, 0, 0))}, {1e4, 0, 0})).state_hash());
}

TEST(OtherSeed, GivesAnotherHash) { EXPECT_NE(hash_of_a_run(7), hash_of_a_run(8)); }

TEST(ReadingSensors, DoesNotChangeTheState) {
  Approach watched(0);
  Approach alone(0);
  for (int i = 0; i < 20; ++i) {
    watched.simulation.step();
    watched.age_in_steps();
    alone.simulation.step();
  }
  EXPECT_EQ(watched.simulation.state_hash(), alone.simulation.state_hash());
}

TEST(DivergingSimulation, ReportsItInEachFurtherPass) {
  SceneDescription described = scene({model("Ball", link("link"), at(999999, 0, 0))}, {1e4, 0, 0});
  Simulation simulation(described);
  EXPECT_THROW(for (int i = 0; i < 100; ++i) simulation.step(), Diverged);
  EXPECT_THROW(simulation.step(), Diverged);
}

}  // namespace
}  // namespace bubblesim::test::test_simulation
