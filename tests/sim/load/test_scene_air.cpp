// SPDX-License-Identifier: BSD-3-Clause
// Wind and the decay of velocities, as read from files.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_scene_air {
namespace {

SceneDescription read(const std::string& models) {
  const TemporaryFile file("air.sdf", in_world("<wind><linear_velocity>1 -2 0.5</linear_velocity></wind>" + models));
  return read_scene(file.path());
}

const LinkDescription& link_of(const SceneDescription& scene, std::size_t index) {
  return scene.models.at(0).links.at(index);
}

TEST(SceneAir, WorldHasItsWind) { EXPECT_EQ(read("").environment.wind, Vector3(1, -2, 0.5)); }

TEST(SceneAir, LinksTakePartInTheWindLikeTheirModelUnlessTheyStateOtherwise) {
  const SceneDescription scene = read(
      "<model name='m'><enable_wind>true</enable_wind><link name='a'/><link "
      "name='b'><enable_wind>0</enable_wind></link>"
      "</model><model name='n'><link name='a'/><link name='b'><enable_wind>1</enable_wind></link></model>");
  EXPECT_TRUE(link_of(scene, 0).wind_enabled);
  EXPECT_FALSE(link_of(scene, 1).wind_enabled);
  EXPECT_FALSE(scene.models.at(1).links.at(0).wind_enabled);
  EXPECT_TRUE(scene.models.at(1).links.at(1).wind_enabled);
}

TEST(SceneAir, DecayIsThePartOfTheVelocityThatIsLostInAMillisecond) {
  const SceneDescription scene = read(
      "<model name='m'><link name='a'><velocity_decay><linear>0.01</linear><angular>1</angular></velocity_decay></link>"
      "<link name='b'/></model>");
  EXPECT_NEAR(std::exp(-link_of(scene, 0).linear_decay * 0.001), 0.99, 1e-12);
  EXPECT_TRUE(std::isinf(link_of(scene, 0).angular_decay));
  EXPECT_EQ(link_of(scene, 1).linear_decay, 0);
}

TEST(SceneAir, DecayBeyondTheWholeVelocityIsRefused) {
  const std::string bad =
      "<model name='m'><link name='a'><velocity_decay><linear>1.5</linear></velocity_decay></link></model>";
  try {
    read(bad);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("/m/a: <velocity_decay> <linear> is 1.5, it must be from 0 to 1"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace bubblesim::test::test_scene_air
