// SPDX-License-Identifier: BSD-3-Clause
// What is drawn by the seed of a simulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/batch.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/randomization.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_randomization {
namespace {

using Kind = Distribution::Kind;
using Operation = Distribution::Operation;

RandomQuantity random(const std::string& name, Kind kind, std::vector<double> first, std::vector<double> second = {},
                      Operation operation = Operation::kSet) {
  return {name, {kind, operation, std::move(first), std::move(second)}, "", 0};
}

std::shared_ptr<const Scene> boxes(std::vector<RandomQuantity> randomized = {}) {
  SceneDescription made = scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 2)),
                                 model("Other", link_with(Box{{1, 1, 1}}), at(5, 0, 2))});
  made.randomized = std::move(randomized);
  return std::make_shared<const Scene>(made);
}

double mass_of(const Simulation& simulation, const char* path = "/Box") {
  return simulation.world().properties().mass(simulation.world().tree().find(path));
}

/// Masses of a box for many seeds.
std::vector<double> masses(const RandomQuantity& quantity) {
  Simulation simulation(boxes());
  const Randomization randomization(simulation, {quantity});
  std::vector<double> found;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    simulation.reset_to_scene(seed);
    randomization.apply(simulation);
    found.push_back(mass_of(simulation));
  }
  return found;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// The bounds are four standard errors.
TEST(Randomization, DrawsHaveTheirDistributions) {
  const std::vector<double> uniform = masses(random("/Box.mass", Kind::kUniform, {2}, {4}));
  EXPECT_GE(*std::min_element(uniform.begin(), uniform.end()), 2);
  EXPECT_LT(*std::max_element(uniform.begin(), uniform.end()), 4);
  EXPECT_NEAR(mean_of(uniform), 3, 4 * 2 / std::sqrt(12.0 * 4000));
  EXPECT_NEAR(deviation_of(uniform), 2 / std::sqrt(12.0), 0.02);
  std::vector<double> sorted = uniform;
  std::sort(sorted.begin(), sorted.end());
  double largest = 0;  // Kolmogorov and Smirnov's statistic; 1.95 / sqrt(n) at 0.1 %
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    largest = std::max(largest, std::abs((sorted[i] - 2) / 2 - static_cast<double>(i) / 4000));
  }
  EXPECT_LT(largest, 1.95 / std::sqrt(4000.0));
  const std::vector<double> normal = masses(random("/Box.mass", Kind::kNormal, {10}, {1}));
  EXPECT_NEAR(mean_of(normal), 10, 4 / std::sqrt(4000.0));
  EXPECT_NEAR(deviation_of(normal), 1, 4 / std::sqrt(2 * 4000.0));
  const std::vector<double> choice = masses(random("/Box.mass", Kind::kChoice, {1, 2, 5}));
  for (const double value : {1, 2, 5}) {
    EXPECT_NEAR(static_cast<double>(std::count(choice.begin(), choice.end(), value)) / 4000, 1 / 3.0, 0.03);
  }
}

TEST(Randomization, DependsOnTheSeedAndTheQuantityAlone) {
  const RandomQuantity mass = random("/Box.mass", Kind::kUniform, {2}, {4});
  const RandomQuantity place = random("/Other.position", Kind::kUniform, {1, 2, 3}, {2, 3, 4});
  Simulation one(boxes({mass}), 7);
  Simulation two(boxes({place, mass}), 7);
  EXPECT_EQ(mass_of(one), mass_of(two));
  EXPECT_NE(mass_of(one), mass_of(Simulation(boxes({mass}), 8)));
  const Vector3 position = two.world().pose(two.world().tree().find("/Other")).position;
  for (unsigned i = 0; i < 3; ++i) {
    EXPECT_GE(position[i], i + 1);
    EXPECT_LT(position[i], i + 2);
  }
  EXPECT_NE(position.x() - 1, position.y() - 2);
}

TEST(Randomization, AResetDrawsTheSameAgain) {
  Simulation simulation(boxes({random("/*.mass", Kind::kUniform, {0.5}, {2}, Operation::kScale),
                               random("gravity", Kind::kNormal, {0, 0, 0}, {0, 0, 0.1}, Operation::kAdd),
                               random("/Box.yaw", Kind::kUniform, {-1}, {1})}),
                        3);
  const std::string start = simulation.save();
  const double mass = mass_of(simulation);
  EXPECT_NE(mass, mass_of(simulation, "/Other"));
  EXPECT_NE(simulation.world().properties().gravity().z(), -9.81);
  simulation.step();
  simulation.reset();
  EXPECT_TRUE(simulation.save() == start);
  simulation.step();
  simulation.reset_world();
  EXPECT_EQ(mass_of(simulation), mass);
  simulation.reset_to_scene(4);
  EXPECT_NE(mass_of(simulation), mass);
}

TEST(Randomization, OfABatchIsThatOfSingleSimulations) {
  const std::vector<RandomQuantity> randomized{random("/Box.mass", Kind::kUniform, {2}, {4}),
                                               random("/Box.friction", Kind::kChoice, {0.1, 0.5})};
  const auto scene = boxes({random("/Other.position", Kind::kNormal, {0, 0, 0}, {0.1, 0.1, 0}, Operation::kAdd)});
  for (const std::size_t threads : {1U, 3U}) {
    BatchOptions options;
    options.worlds = threads * 5;
    options.threads = threads;
    options.seed = 20;
    options.randomized = randomized;
    Batch batch(scene, options);
    for (const bool again : {false, true}) {
      if (again) batch.reset({}, {}, {});
      batch.step(nullptr, 10, nullptr);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        Simulation alone(scene, 20 + i);
        Randomization(alone, randomized).apply(alone);
        for (int step = 0; step < 10; ++step) alone.step();
        EXPECT_EQ(batch[i].state_hash(), alone.state_hash());
        EXPECT_EQ(mass_of(batch[i]), mass_of(alone));
      }
    }
  }
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Randomization, ErrorsNameTheQuantityAndItsPlace) {
  const auto in_file = [](RandomQuantity quantity) {
    quantity.file = "world.sdf";
    quantity.line = 12;
    return error_of([&] { Simulation simulation(boxes({quantity})); });
  };
  EXPECT_TRUE(has(in_file(random("/Bix.mass", Kind::kUniform, {1}, {2})), "world.sdf:12: randomize /Bix.mass"));
  EXPECT_TRUE(has(in_file(random("/Box.weight", Kind::kUniform, {1}, {2})), "there is no action 'weight'"));
  EXPECT_TRUE(has(in_file(random("/Box.mass", Kind::kUniform, {2}, {1})), "low is 2, more than high, 1"));
  EXPECT_TRUE(has(in_file(random("/Box.mass", Kind::kNormal, {2}, {-1})), "standard_deviation is -1"));
  EXPECT_TRUE(has(in_file(random("/Box.position", Kind::kUniform, {1, 2}, {3})), "low has 2 numbers"));
  EXPECT_TRUE(has(in_file(random("/Box.position", Kind::kChoice, {1, 2})), "rows of 3 numbers"));
  EXPECT_TRUE(has(in_file(random("/Box.mass", Kind::kUniform, {-2}, {-1})), "world.sdf:12: randomize /Box.mass: "));
  EXPECT_TRUE(has(in_file(random("/Floor.mass", Kind::kUniform, {1}, {2})), "without mass"));
  Simulation simulation(boxes());
  EXPECT_TRUE(
      has(error_of([&] { Randomization(simulation, {random("/Box.mass", Kind::kUniform, {kNaN}, {1})}); }), "finite"));
}

}  // namespace
}  // namespace bubblesim::test::test_randomization
