// SPDX-License-Identifier: BSD-3-Clause
// Reading <actor>.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/scripted_motion.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_actors {
namespace {

std::string waypoint(double time, const std::string& pose) {
  return "<waypoint><time>" + std::to_string(time) + "</time><pose>" + pose + "</pose></waypoint>";
}

std::string actor(const std::string& content) {
  return "<actor name='visitor'><skin><filename>walk.dae</filename></skin>" + content + "</actor>";
}

ModelDescription loaded(const std::string& content, std::vector<Problem>* warnings = nullptr) {
  const TemporaryFile file("actor.sdf", in_world(actor(content)));
  return read_scene(file.path(), {}, warnings).models.at(0);
}

TEST(Actor, IsAStandingPersonWithTheTrajectoriesOfItsScript) {
  const ModelDescription read = loaded(
      "<script><loop>false</loop><delay_start>2</delay_start>"
      "<trajectory id='5' type='walk' tension='0.25'>" +
      waypoint(3, "1 2 0 0 0 1") +
      "</trajectory>"
      "<trajectory id='1' type='walk'>" +
      waypoint(4, "5 5 0 0 0 0") + waypoint(1, "0 0 0 0 0 0.5") + "</trajectory></script>");
  EXPECT_EQ(read.name, "visitor");
  EXPECT_TRUE(read.is_static);
  ASSERT_TRUE(read.script);
  EXPECT_FALSE(read.script->loop);
  EXPECT_EQ(read.script->delay, 2);
  ASSERT_EQ(read.script->trajectories.size(), 2U);
  const Trajectory& first = read.script->trajectories[0];
  ASSERT_EQ(first.waypoints.size(), 2U) << "by the ids";
  EXPECT_EQ(first.waypoints[0].time, 1) << "by the times";
  EXPECT_EQ(first.tension, 0);
  EXPECT_EQ(read.script->trajectories[1].tension, 0.25);
  EXPECT_EQ(read.pose, first.waypoints[0].pose);
  const CollisionDescription& body = read.links.at(0).collisions.at(0);
  const auto& capsule = std::get<Capsule>(body.geometry);
  EXPECT_NEAR(body.pose.position.z() - capsule.length / 2 - capsule.radius, 0, 1e-12) << "its feet";
  EXPECT_NEAR(capsule.length + 2 * capsule.radius, 1.8, 1e-12);
}

TEST(Actor, StandsOnItsFeetWhereverItsOriginIs) {
  const auto at_start = [](const std::string& pose, const std::string& point) {
    return loaded("<pose>" + pose + "</pose><script><trajectory id='0' type='w'>" + waypoint(1, point) +
                  "</trajectory></script>")
        .pose;
  };
  const Pose lying = at_start("0 0 0 0 0 0", "1 2 1.05 1.5707 0 0.3");
  EXPECT_NEAR((lying.position - Vector3(1, 2, 0.05)).norm(), 0, 1e-12)
      << "an origin at the hips, and a skin that is turned";
  EXPECT_NEAR((to_rpy(lying.orientation) - Vector3(0, 0, 0.3)).norm(), 0, 1e-9);
  const Pose placed = at_start("1 0 1.0 0 0 1.5707963267948966", "2 0 0 0 0 0");
  EXPECT_NEAR((placed.position - Vector3(1, 2, 0)).norm(), 0, 1e-9) << "in the frame of the actor";
}

TEST(Actor, StandsStillWithoutAScriptThatStarts) {
  EXPECT_FALSE(loaded("<pose>1 2 0 0 0 0</pose>").script);
  EXPECT_EQ(loaded("<pose>1 2 0 0 0 0</pose>").pose.position, Vector3(1, 2, 0));
  const std::string script = "<script><auto_start>false</auto_start><trajectory id='0' type='w'>" +
                             waypoint(1, "3 0 0 0 0 0") + "</trajectory></script>";
  EXPECT_FALSE(loaded(script).script);
  EXPECT_EQ(loaded(script).pose.position, Vector3(3, 0, 0));
}

TEST(Actor, MayBeAFileOfItsOwn) {
  const std::string text = "<sdf version='1.9'>" + actor("<pose>1 2 0 0 0 0</pose>") + "</sdf>";
  const TemporaryFile file("visitor.sdf", text);
  const SceneDescription alone = read_scene(file.path());
  EXPECT_TRUE(alone.is_model_file);
  EXPECT_EQ(alone.models.back().name, "visitor");
  EXPECT_EQ(load_model(text, ".").pose.position, Vector3(1, 2, 0)) << "as a service spawns it";
}

TEST(Actor, KeepsItsPluginsAndWarnsOfLinks) {
  std::vector<Problem> warnings;
  const ModelDescription read = loaded("<link name='l'/><plugin name='p' filename='libActorPlugin.so'/>", &warnings);
  EXPECT_EQ(read.plugins.at(0).filename, "libActorPlugin.so");
  EXPECT_NE(lines_of(warnings).find("<link> of an actor is ignored"), std::string::npos) << lines_of(warnings);
}

std::string obstacle(const std::string& is_static, const std::string& script) {
  return in_world("<model name='cart'><pose>1 0 0.5 0 0 0</pose><static>" + is_static +
                  "</static><link name='l'/><bubblesim:script>" + script + "</bubblesim:script></model>");
}

TEST(ScriptOfAModel, MovesItInTheFrameOfItsPose) {
  const TemporaryFile file(
      "cart.sdf", obstacle("true", "<loop>false</loop><trajectory id='0' type='' tension='1'>" +
                                       waypoint(0, "0 0 0 0.1 0 0") + waypoint(4, "2 0 1 0 0 0") + "</trajectory>"));
  const ModelDescription read = read_scene(file.path()).models.at(0);
  ASSERT_TRUE(read.script);
  EXPECT_FALSE(read.script->loop);
  EXPECT_EQ(read.pose, Pose(1, 0, 0.5, 0.1, 0, 0)) << "as written, without standing upright";
  EXPECT_EQ(read.script->trajectories[0].waypoints[1].pose.position, Vector3(3, 0, 1.5));
}

TEST(ScriptOfAModel, IsOfAStaticOneWithWaypoints) {
  const auto problem = [](const std::string& text) -> std::string {
    const TemporaryFile file("cart.sdf", text);
    try {
      read_scene(file.path());
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const std::string one = "<trajectory id='0' type=''>" + waypoint(1, "0 0 0 0 0 0") + "</trajectory>";
  EXPECT_NE(problem(obstacle("false", one)).find("a model with a script must be static"), std::string::npos);
  EXPECT_NE(problem(obstacle("true", "<loop>true</loop>")).find("<bubblesim:script> has no <waypoint>"),
            std::string::npos);
}

TEST(Actor, ReportsNumbersThatCannotBeUsed) {
  const auto problem = [](const std::string& trajectory) -> std::string {
    try {
      loaded("<script>" + trajectory + "</script>");
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(problem("<trajectory id='0' type='w' tension='tight'>" + waypoint(1, "0 0 0 0 0 0") + "</trajectory>")
                .find("the attribute tension of <trajectory> is 'tight', it must be a number"),
            std::string::npos);
  EXPECT_NE(problem("<trajectory id='0' type='w' tension='3'>" + waypoint(1, "0 0 0 0 0 0") + "</trajectory>")
                .find("tension"),
            std::string::npos);
}

}  // namespace
}  // namespace bubblesim::test::test_actors
