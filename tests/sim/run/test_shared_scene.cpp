// SPDX-License-Identifier: BSD-3-Clause
// A scene that several simulations share.
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_shared_scene {
namespace {

const std::shared_ptr<const Scene>& tricycle() {
  static const std::shared_ptr<const Scene> scene = load_scene("tricycle");
  return scene;
}

/// The hashes of the states after each step of a tricycle that drives a curve, and the distances to walls.
std::vector<double> drive(Simulation& simulation, int steps = 40) {
  const SceneTree& tree = simulation.world().tree();
  simulation.world().joints().set_target_position(tree.find("/Steering"), 0.3);
  simulation.world().joints().set_target_velocity(tree.find("/FrontMotor"), 4);
  const ObjectId sonar = tree.find("/FrontSonar");
  std::vector<double> states;
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    states.push_back(static_cast<double>(simulation.state_hash()));
    states.push_back(simulation.read_proximity(sonar).distance);
  }
  return states;
}

TEST(SharedScene, HasEqualFuturesInAllItsSimulations) {
  Simulation alone(read_scene("tricycle"), 3);
  const std::vector<double> expected = drive(alone);
  Simulation first(tricycle(), 3);
  Simulation second(tricycle(), 3);
  EXPECT_EQ(drive(first), expected);
  EXPECT_EQ(drive(second), expected);
}

TEST(SharedScene, OutlivesNoSimulation) {
  auto shared = std::make_shared<const Scene>(scene({floor(), model("Ball", link_with(Sphere{0.5}), at(0, 0, 1))}));
  Simulation simulation(shared);
  shared.reset();
  simulation.step();
  EXPECT_EQ(simulation.scene().models.size(), 2U);
}

TEST(SharedScene, IsNotChangedByModelsThatComeAndGo) {
  Simulation changed(tricycle());
  Simulation other(tricycle());
  const ObjectId robot = changed.world().tree().find("/Tricycle");
  changed.step();
  changed.remove_model(robot);
  changed.add_model(still(model("Wall", link_with(Box{{1, 1, 1}}), at(3, 0, 0.5))));
  changed.step();
  EXPECT_EQ(other.world().tree().find("/Tricycle"), robot);
  EXPECT_THROW(other.world().tree().find("/Wall"), NoSuchObject);
  Simulation expected(tricycle());
  EXPECT_EQ(drive(other), drive(expected));
}

TEST(SharedScene, RunsInSeveralThreadsAtOnce) {
  Simulation alone(tricycle(), 5);
  const std::vector<double> expected = drive(alone, 100);
  std::vector<std::vector<double>> states(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& found : states) {
    threads.emplace_back([&found] {
      Simulation simulation(tricycle(), 5);
      found = drive(simulation, 100);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& found : states) EXPECT_EQ(found, expected);
}

TEST(SharedScene, GivesTheWarningsOfItsFiles) {
  const TemporaryFile file("warned.sdf", in_world("<model name='m'>\n<link name='l'><kinematic>true</kinematic>"
                                                  "</link></model>"));
  testing::internal::CaptureStderr();
  const std::shared_ptr<const Scene> scene = load_scene(file.path());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(scene->warnings().size(), 1U);
  const Problem& warning = scene->warnings().front();
  EXPECT_EQ(warning.file, file.path());
  EXPECT_EQ(warning.line, 2);
  EXPECT_EQ(warning.object, "/m/l");
  EXPECT_EQ(warning.message.rfind("<kinematic> is ignored", 0), 0U) << warning.message;
}

TEST(BadScene, ListsItsWarningsToo) {
  const TemporaryFile file("bad.sdf", in_world("<model name='m'><link name='l'><kinematic>true</kinematic><inertial>"
                                               "<mass>-1</mass></inertial></link></model>"));
  try {
    load_scene(file.path());
    ADD_FAILURE() << "loaded";
  } catch (const SceneError& error) {
    EXPECT_NE(lines_of(error.problems).find("-1"), std::string::npos) << error.what();
    EXPECT_NE(lines_of(error.warnings).find("<kinematic> is ignored"), std::string::npos);
  }
}

}  // namespace
}  // namespace bubblesim::test::test_shared_scene
