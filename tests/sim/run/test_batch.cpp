// SPDX-License-Identifier: BSD-3-Clause
// Many worlds of one scene.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/batch.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_batch {
namespace {

const std::vector<std::string> kActions{"/FrontMotor.target_velocity", "/Steering.target_position"};
const std::vector<std::string> kObservations{"time", "/Tricycle.pose", "/FrontSonar.distance"};

BatchOptions options(std::size_t worlds, std::size_t threads) {
  BatchOptions made;
  made.worlds = worlds;
  made.seed = 7;
  made.threads = threads;
  made.actions = kActions;
  made.observations = kObservations;
  made.numbers = NumberType::kFloat64;
  return made;
}

/// The commands of a world in a step; they depend on neither the batch nor its size.
std::vector<double> commands(std::size_t world, int step) {
  const double phase = static_cast<double>(world) + 0.1 * step;
  return {4 + std::sin(phase), 0.4 * std::cos(phase)};
}

std::vector<double> step(Batch& batch, int step) {
  std::vector<double> actions;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    for (const double value : commands(i, step)) actions.push_back(value);
  }
  std::vector<double> observed(batch.size() * batch.observations().width());
  batch.step(actions.data(), 1, observed.data());
  return observed;
}

TEST(Batch, EqualsSingleSimulationsForAnyNumberOfThreads) {
  const auto scene = load_scene("tricycle");
  for (const std::size_t threads : {1U, 2U, 5U}) {
    Batch batch(scene, options(9, threads));
    std::vector<double> observed;
    for (int i = 0; i < 25; ++i) observed = step(batch, i);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      Simulation alone(scene, 7 + i);
      const SceneTree& tree = alone.world().tree();
      for (int k = 0; k < 25; ++k) {
        alone.world().joints().set_target_velocity(tree.find("/FrontMotor"), commands(i, k)[0]);
        alone.world().joints().set_target_position(tree.find("/Steering"), commands(i, k)[1]);
        alone.step();
        alone.read_proximity(tree.find("/FrontSonar"));
      }
      EXPECT_EQ(batch[i].state_hash(), alone.state_hash());
      const double* row = &observed[i * batch.observations().width()];
      EXPECT_EQ(row[0], alone.state_time());
      EXPECT_EQ(row[1], alone.world().pose(tree.find("/Tricycle")).position.x());
    }
  }
}

TEST(Batch, ResetsMarkedWorldsToTheirSeedsAndStates) {
  Batch batch(load_scene("tricycle"), options(4, 2));
  for (int i = 0; i < 5; ++i) step(batch, i);
  const std::string state = batch[1].save();
  const std::uint64_t hash = batch[1].state_hash();
  const std::uint64_t untouched = batch[0].state_hash();
  batch.reset({0, 0, 1, 1}, {0, 0, 100, 101}, {});
  EXPECT_EQ(batch[0].state_hash(), untouched);
  EXPECT_EQ(batch[2].seed(), 100U);
  EXPECT_EQ(batch[3].state_hash(), Simulation(load_scene("tricycle"), 101).state_hash());
  batch.reset({}, {}, {state});
  for (std::size_t i = 0; i < batch.size(); ++i) EXPECT_EQ(batch[i].state_hash(), hash);
}

TEST(Batch, ResetsWorldsThatLoseAModel) {
  BatchOptions made;
  made.worlds = 3;
  made.actions = {"/Ball.position"};
  made.observations = {"/Ball.position"};
  made.numbers = NumberType::kFloat64;
  Batch batch(std::make_shared<const Scene>(scene({floor(), model("Ball", link_with(Sphere{0.5}), at(0, 0, 3))})),
              made);
  std::vector<double> actions{0, 0, 3, 0, 0, -2000, 0, 0, 3};
  std::vector<double> observed(9);
  batch.step(actions.data(), 1, observed.data());
  EXPECT_EQ(batch.failed(), (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(observed[5], 3);
  batch.step(nullptr, 1, observed.data());
  EXPECT_EQ(batch.failed(), (std::vector<std::uint8_t>{0, 0, 0}));
  EXPECT_LT(observed[5], 3);
}

TEST(Batch, WritesNoFileWhenAWorldDiverges) {
  char folder[] = "/tmp/bubblesim_test_batch_XXXXXX";
  ASSERT_NE(::mkdtemp(folder), nullptr);
  const char* before = std::getenv("TMPDIR");
  const std::string restored = before == nullptr ? "/tmp" : before;
  ::setenv("TMPDIR", folder, 1);
  BatchOptions made;
  made.worlds = 2;
  made.actions = {"/Ball.position"};
  made.numbers = NumberType::kFloat64;
  Batch batch(std::make_shared<const Scene>(scene({model("Ball", link_with(Sphere{0.5}))})), made);
  const std::vector<double> actions{0, 0, 3, 0, 0, -999999.999};
  batch.step(actions.data(), 1, nullptr);
  ::setenv("TMPDIR", restored.c_str(), 1);
  EXPECT_EQ(batch.failed(), (std::vector<std::uint8_t>{0, 1}));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

std::string error_of(const std::vector<std::string>& actions, const std::vector<std::string>& observations) {
  BatchOptions made;
  made.actions = actions;
  made.observations = observations;
  try {
    const Batch batch(load_scene("tricycle"), made);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Batch, NamesTheQuantitiesThatThereAre) {
  EXPECT_TRUE(has(error_of({}, {"/Tricycle"}), "PATH.QUANTITY"));
  EXPECT_TRUE(has(error_of({}, {"/Tricycle.speed"}), "linear_velocity"));
  EXPECT_TRUE(has(error_of({}, {"/Tricycle.ranges"}), "is a model without ranges"));
  EXPECT_TRUE(has(error_of({"/Tricycle.ranges"}, {}), "there is no action 'ranges'"));
  EXPECT_TRUE(has(error_of({}, {"/Tricycel.pose"}), "/Tricycle"));
}

TEST(Batch, SpreadsWildcardsOverObjectsThatHaveTheQuantity) {
  BatchOptions made;
  made.observations = {"/Tricycle/*.joint_velocity", "/FrontMotor.position@/Tricycle"};
  Batch batch(load_scene("tricycle"), made);
  const std::vector<Quantity>& list = batch.observations().list();
  ASSERT_GE(list.size(), 3U);
  EXPECT_EQ(list.back().start, list.size() - 1);
  EXPECT_EQ(list.back().size, 3U);
  for (std::size_t i = 0; i + 1 < list.size(); ++i) EXPECT_TRUE(has(list[i].name, ".joint_velocity"));
}

TEST(Batch, RefusesCommandsThatAreNoNumbers) {
  Batch batch(load_scene("tricycle"), options(2, 1));
  std::vector<double> observed(2 * batch.observations().width());
  const std::vector<double> bad{1, 0, kNaN, 0};
  EXPECT_THROW(batch.step(bad.data(), 1, observed.data()), InvalidInput);
  EXPECT_THROW(batch.reset({1}, {}, {}), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_batch
