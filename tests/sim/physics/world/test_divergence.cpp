// SPDX-License-Identifier: BSD-3-Clause
// Divergence handling, and models that fall below the scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_divergence {
namespace {

/// A ball that is about to leave the finite world, and a box on the floor.
struct Leaving {
  explicit Leaving(OnDivergence policy) : simulation(described(policy)) {
    World& world = simulation.world();
    world.set_pose(world.tree().find("/Ball"), at(999999, 0, 5));
    world.set_velocity(world.tree().find("/Ball"), {{1e5, 0, 0}, {}});
  }

  static SceneDescription described(OnDivergence policy) {
    SceneDescription made = scene({floor(), model("Ball", link_with(Sphere{0.5}), at(0, 0, 5)),
                                   model("Box", link_with(Box{{1, 1, 1}}), at(0, 3, 2))});
    made.on_divergence = policy;
    return made;
  }

  Simulation simulation;
};

/// Records the models that are about to be removed.
struct Witness : System {
  void model_removing(World& world, ObjectId model) override { removed.push_back(world.tree().path(model)); }
  std::vector<std::string> removed;
};

TEST(Divergence, ThrowsAndStatesWhereTheLastStatesAre) {
  Leaving leaving(OnDivergence::kPause);
  std::string reported;
  try {
    leaving.simulation.step();
    FAIL();
  } catch (const Diverged& error) {
    reported = error.what();
  }
  EXPECT_NE(reported.find("/Ball"), std::string::npos);
  const std::string before = "the last states are in ";
  const std::string file = reported.substr(reported.find(before) + before.size());
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(text.find("/Ball/link,999999,"), std::string::npos) << text;
}

std::string file_of(OnDivergence policy) {
  Leaving leaving(policy);
  try {
    leaving.simulation.step();
  } catch (const Diverged& error) {
    const std::string what = error.what();
    return what.substr(what.rfind(' ') + 1);
  }
  return "";
}

TEST(Divergence, WritesOneFileThatOnlyItsUserCanRead) {
  const std::filesystem::path file = file_of(OnDivergence::kPause);
  EXPECT_EQ(std::filesystem::status(file).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_EQ(file_of(OnDivergence::kPause), file) << "each divergence of a process replaces the last one";
  const std::filesystem::path other = file.parent_path() / "bubblesim_test_divergence_other";
  std::filesystem::remove(file);
  std::filesystem::create_symlink(other, file);
  const std::filesystem::path next = file_of(OnDivergence::kPause);
  EXPECT_NE(next, file);
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(next)));
  EXPECT_FALSE(std::filesystem::exists(other)) << "a link in its place is not followed";
  std::filesystem::remove(file);
  std::filesystem::remove(next);
}

TEST(Divergence, ResetsTheWorldWhenTheSceneAsksForIt) {
  Leaving leaving(OnDivergence::kReset);
  leaving.simulation.step();
  const World& world = leaving.simulation.world();
  EXPECT_EQ(world.pose(world.tree().find("/Ball")).position, Vector3(0, 0, 5));
  EXPECT_NO_THROW(leaving.simulation.step());
}

TEST(Divergence, RemovesTheModelWhenTheSceneAsksForIt) {
  Leaving leaving(OnDivergence::kRemove);
  Witness witness;
  leaving.simulation.add(witness);
  leaving.simulation.step();
  EXPECT_EQ(witness.removed, std::vector<std::string>{"/Ball"});
  const World& world = leaving.simulation.world();
  EXPECT_THROW(world.tree().find("/Ball"), NoSuchObject);
  for (int i = 0; i < 40; ++i) leaving.simulation.step();
  EXPECT_NEAR(world.pose(world.tree().find("/Box")).position.z(), 0.5, 0.01) << "the rest goes on";
}

TEST(FallingOff, ModelsFarBelowEverythingAreRemoved) {
  Simulation simulation(scene({model("Low", link_with(Sphere{0.5}), at(0, 0, -300)),
                               still(model("Table", link_with(Box{{1, 1, 1}}), at(5, 0, 0)))}));
  Witness witness;
  simulation.add(witness);
  const ObjectId low = simulation.world().tree().find("/Low");
  double last = 0;
  for (int i = 0; i < 400 && witness.removed.empty(); ++i) {
    last = simulation.world().pose(low).position.z();
    simulation.step();
  }
  EXPECT_EQ(witness.removed, std::vector<std::string>{"/Low"});
  EXPECT_NEAR(last, -1300, 10) << "1000 m under where it began";
  EXPECT_NO_THROW(simulation.step());
}

TEST(FallingOff, NothingFallsWithoutGravity) {
  Simulation simulation(scene({model("Far", link_with(Sphere{0.5}))}, Vector3::Zero()));
  simulation.world().set_pose(simulation.world().tree().find("/Far"), at(0, 0, -5000));
  simulation.step();
  EXPECT_NO_THROW(simulation.world().tree().find("/Far"));
}

}  // namespace
}  // namespace bubblesim::test::test_divergence
