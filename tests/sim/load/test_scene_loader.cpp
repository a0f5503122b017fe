// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/world.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_scene_loader {
namespace {

const fs::path kBadScenes = BUBBLESIM_TEST_SCENES;
const fs::path kScenes = BUBBLESIM_SCENES;

/// The problems of a scene, as strings without the file: `12: /Robot: ...`.
std::vector<std::string> problems(const std::string& name_or_path) {
  try {
    read_scene(name_or_path);
  } catch (const SceneError& error) {
    std::vector<std::string> strings;
    for (const Problem& problem : error.problems) {
      const std::string object = problem.object.empty() ? "" : problem.object + ": ";
      strings.push_back(std::to_string(problem.line) + ": " + object + problem.message);
    }
    return strings;
  }
  return {"it loads"};
}

std::string all_problems(const std::string& name_or_path) {
  std::string all;
  for (const std::string& text : problems(name_or_path)) all += text + "\n";
  return all;
}

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class BadScene : public ::testing::TestWithParam<fs::path> {};

/// Each file has its expected problems in comments: `expect: LINE: TEXT`, where LINE is 0 if only the file is known.
TEST_P(BadScene, EveryProblemIsReportedInItsPlaceAndNoOther) {
  static const std::regex pattern("<!-- expect: (\\d+: )(.*?) -->");
  const std::string text = content(GetParam());
  std::vector<std::string> found = problems(GetParam().string());
  int expected = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern); match != std::sregex_iterator(); ++match) {
    ++expected;
    const auto fits = std::find_if(found.begin(), found.end(), [&](const std::string& problem) {
      return problem.rfind(match->str(1), 0) == 0 && problem.find(match->str(2)) != std::string::npos;
    });
    if (fits == found.end()) {
      ADD_FAILURE() << "not reported: " << match->str(1) << match->str(2);
    } else {
      found.erase(fits);
    }
  }
  EXPECT_GT(expected, 0) << "the file expects nothing";
  for (const std::string& problem : found) ADD_FAILURE() << "not expected: " << problem;
}

std::vector<fs::path> bad_scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kBadScenes)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

INSTANTIATE_TEST_SUITE_P(Files, BadScene, ::testing::ValuesIn(bad_scenes()),
                         [](const auto& info) { return info.param.stem().string(); });

TEST(SceneError, TextIsAsEditorsReadIt) {
  const fs::path file = kBadScenes / "own_unknown.sdf";
  try {
    read_scene(file.string());
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.what(), file.string() +
                                ":3: unknown element <bubblesim:time_stop>; did you mean bubblesim:time_step, "
                                "bubblesim:motor?");
  }
}

TEST(SceneFile, EmptyFileIsReportedAsEmpty) {
  EXPECT_EQ(all_problems(TemporaryFile("empty.sdf", "").path()), "0: is empty\n");
}

TEST(SceneFile, FolderIsNoScene) { EXPECT_EQ(all_problems(kBadScenes.string()), "0: is a folder, not a scene\n"); }

TEST(SceneFile, MissingFileIsNamed) {
  try {
    read_scene("nowhere/robot.sdf");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()),
              "nowhere/robot.sdf: file not found: there is no folder " + std::filesystem::absolute("nowhere").string());
  }
}

TEST(SceneFile, SimilarFilesBesideAMissingOneAreNamed) {
  const TemporaryFile file("robot.sdf", "");
  const std::filesystem::path wanted = std::filesystem::path(file.folder()) / "robto.sdf";
  try {
    read_scene(wanted.string());
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()),
              wanted.string() + ": file not found; did you mean robot.sdf? (in " + wanted.parent_path().string() + ")");
  }
}

TEST(SceneFile, BinaryFileIsNoScene) {
  const std::string bytes(
      "\x7f"
      "ELF\0\1\2\3\xff\xfe<",
      11);
  EXPECT_NE(all_problems(TemporaryFile("binary.sdf", bytes).path()), "it loads\n");
}

TEST(SceneName, UnknownNameSuggestsAKnownOne) {
  EXPECT_NE(all_problems("trycicle").find("scene not found: 'trycicle'; did you mean tricycle?"), std::string::npos);
  EXPECT_NE(all_problems("").find("scene not found: ''"), std::string::npos);
}

TEST(SceneName, ShippedScenesAreFoundByName) {
  const std::vector<std::string> names = scene_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const auto& entry : fs::directory_iterator(kScenes)) {
    if (entry.path().extension() != ".sdf") continue;
    const std::string name = entry.path().stem().string();
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    const SceneDescription scene = read_scene(name);
    EXPECT_EQ(scene.name, name);
    EXPECT_TRUE(fs::equivalent(scene.file, entry.path()));
    EXPECT_NO_THROW(World(scene, 0));
  }
}

TEST(SceneName, FoldersOfTheEnvironmentComeFirst) {
  const TemporaryFile own("tricycle.sdf", in_world("<model name='Mine'><link name='l'/></model>"));
  ::setenv("BUBBLESIM_SCENE_PATH", ("/nowhere::" + own.folder()).c_str(), 1);
  const std::vector<fs::path> folders = scene_folders();
  const SceneDescription scene = read_scene("tricycle");
  ::unsetenv("BUBBLESIM_SCENE_PATH");
  ASSERT_GE(folders.size(), 3u);
  EXPECT_EQ(folders[0], "/nowhere");
  EXPECT_EQ(folders[1], own.folder());
  ASSERT_EQ(scene.models.size(), 1u);
  EXPECT_EQ(scene.models[0].name, "Mine");
}

TEST(LoadedScene, FileWithAModelAloneGetsGround) {
  const TemporaryFile file("robot.sdf",
                           "<sdf version='1.9'><model name='Ball'><pose>0 0 0.6 0 0 0</pose><link name='l'>"
                           "<collision name='c'><geometry><sphere><radius>0.5</radius></sphere></geometry></collision>"
                           "</link></model></sdf>");
  World world(read_scene(file.path()), 0);
  world.advance(2, 0.001);
  EXPECT_NEAR(world.pose(world.tree().find("/Ball")).position.z(), 0.5, 0.003);
}

TEST(LoadedScene, HoldsWhatTheFileStates) {
  const TemporaryFile file("all.sdf", in_world(R"(
    <gravity>1 2 -3</gravity>
    <physics name='p' type='ode'><max_step_size>0.002</max_step_size></physics>
    <bubblesim:time_step> 0.02 </bubblesim:time_step>
    <model name='R' canonical_link='b'>
      <pose>1 2 3 0 0 1.5</pose><self_collide>true</self_collide>
      <link name='a'>
        <inertial>
          <pose>0.1 0.2 0.3 0 0 1.5707963267948966</pose><mass>4</mass>
          <inertia><ixx>1</ixx><iyy>2</iyy><izz>2.5</izz><ixy>0.1</ixy></inertia>
        </inertial>
        <collision name='c'><pose>0 0 1 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry>
          <surface><friction><ode><mu>0.3</mu></ode></friction><contact><collide_bitmask>6</collide_bitmask></contact>
          </surface></collision>
        <sensor name='s' type='sonar'><update_rate>7</update_rate>
          <sonar><min>0.1</min><max>2</max><radius>2</radius></sonar></sensor>
      </link>
      <link name='b'><pose relative_to='a'>0 0 1 0 0 0</pose></link>
      <joint name='j' type='revolute'><parent>a</parent><child>b</child>
        <axis><xyz>0 0 -1</xyz><bubblesim:motor>position</bubblesim:motor>
          <limit><lower>-1</lower><upper>2</upper><effort>5</effort><velocity>6</velocity></limit>
          <dynamics><damping>0.7</damping><friction>0.8</friction></dynamics></axis></joint>
    </model>)"));
  const SceneDescription scene = read_scene(file.path());
  EXPECT_EQ(scene.name, "all");
  EXPECT_EQ(scene.gravity, Vector3(1, 2, -3));
  EXPECT_EQ(scene.substep, 0.002);
  EXPECT_EQ(scene.time_step, 0.02);
  ASSERT_EQ(scene.models.size(), 1u);
  const ModelDescription& robot = scene.models[0];
  EXPECT_EQ(robot.pose, Pose(1, 2, 3, 0, 0, 1.5));
  EXPECT_TRUE(robot.self_collide);
  EXPECT_FALSE(robot.is_static);
  EXPECT_EQ(robot.canonical_link, "b");
  const LinkDescription& a = robot.links[0];
  EXPECT_EQ(a.mass, 4);
  EXPECT_EQ(a.centre_of_mass, Vector3(0.1, 0.2, 0.3));
  // The inertia's frame is rotated by a quarter turn about z: x and y are exchanged, and the product changes its sign.
  EXPECT_LT((a.inertia_diagonal - Vector3(2, 1, 2.5)).norm(), 1e-12);
  EXPECT_LT((a.inertia_products - Vector3(-0.1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(std::get<Box>(a.collisions[0].geometry).size, Vector3(1, 2, 3));
  EXPECT_EQ(a.collisions[0].pose.position, Vector3(0, 0, 1));
  EXPECT_EQ(a.collisions[0].surface.mu, 0.3);
  EXPECT_EQ(a.collisions[0].surface.collide_bitmask, 6);
  const auto& cone = a.sensors[0].kind.get<SonarDescription>();
  EXPECT_EQ(a.sensors[0].update_rate, 7);
  EXPECT_EQ(cone.min_range, 0.1);
  EXPECT_EQ(cone.max_range, 2);
  EXPECT_NEAR(cone.half_angle, M_PI / 4, 1e-12);
  EXPECT_LT((robot.links[1].pose.position - Vector3(0, 0, 1)).norm(), 1e-12);
  const JointDescription& joint = robot.joints[0];
  EXPECT_EQ(joint.type, "revolute");
  EXPECT_LT((joint.pose.position - Vector3(0, 0, 1)).norm(), 1e-12) << "a joint's frame is its child's";
  const AxisDescription& axis = joint.axes[0];
  EXPECT_EQ(axis.direction, Vector3(0, 0, -1));
  EXPECT_EQ(axis.motor, MotorMode::kPosition);
  EXPECT_EQ(axis.lower, -1);
  EXPECT_EQ(axis.upper, 2);
  EXPECT_EQ(axis.max_force, 5);
  EXPECT_EQ(axis.max_velocity, 6);
  EXPECT_EQ(axis.damping, 0.7);
  EXPECT_EQ(axis.friction, 0.8);
}

TEST(LoadedScene, AxisWithoutLimitsHasNone) {
  const TemporaryFile file("free.sdf", in_world("<model name='R'><link name='a'/><link name='b'/>"
                                                "<joint name='j' type='revolute'><parent>a</parent><child>b</child>"
                                                "<axis><xyz>0 0 1</xyz></axis></joint></model>"));
  const AxisDescription axis = read_scene(file.path()).models[0].joints[0].axes[0];
  EXPECT_EQ(axis.lower, -kInfinity);
  EXPECT_EQ(axis.upper, kInfinity);
  EXPECT_EQ(axis.max_force, kInfinity);
  EXPECT_EQ(axis.max_velocity, kInfinity);
  EXPECT_EQ(axis.motor, MotorMode::kNone);
}

TEST(LoadedScene, FindsTheChildScriptBesideTheFile) {
  EXPECT_TRUE(fs::equivalent(read_scene("tricycle").models.back().child_script, kScenes / "tricycle.py"));
}

/// The same for the text of a model.
std::string problems_of_model(const std::string& text) {
  try {
    load_model(text, kScenes);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "it loads";
}

std::string sphere_model(const std::string& mass) {
  return "<sdf version='1.9'>\n<model name='Ball'><pose>1 2 3 0 0 0</pose><link name='l'>\n"
         "<inertial><mass>" +
         mass +
         "</mass></inertial>"
         "<collision name='c'><geometry><sphere><radius>0.5</radius></sphere></geometry></collision>"
         "</link></model></sdf>";
}

TEST(ModelText, IsReadAsAFileIs) {
  const ModelDescription ball = load_model(sphere_model("2"), kScenes);
  EXPECT_EQ(ball.name, "Ball");
  EXPECT_EQ(ball.pose.position, Vector3(1, 2, 3));
  EXPECT_EQ(ball.links.at(0).mass, 2);
  EXPECT_EQ(std::get<Sphere>(ball.links.at(0).collisions.at(0).geometry).radius, 0.5);
}

TEST(ModelText, MayBeUrdf) {
  const ModelDescription arm = load_model(R"(<?xml version="1.0"?>
    <robot name="Arm">
      <link name="base"><inertial><mass value="3"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
      <link name="tip"><inertial><origin xyz="0 0 0.5"/><mass value="1"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
      <joint name="swing" type="revolute"><parent link="base"/><child link="tip"/><origin xyz="0 0 2"/>
        <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="5" velocity="2"/></joint>
    </robot>)",
                                          kScenes);
  EXPECT_EQ(arm.name, "Arm");
  ASSERT_EQ(arm.links.size(), 2u);
  EXPECT_EQ(arm.links[0].mass, 3);
  EXPECT_EQ(arm.links[1].pose.position, Vector3(0, 0, 2));
  ASSERT_EQ(arm.joints.size(), 1u);
  EXPECT_EQ(arm.joints[0].axes.at(0).upper, 1);
}

TEST(ModelText, FindsItsChildScriptInTheFolder) {
  std::string text = sphere_model("1");
  text.replace(text.find("<link"), 0, "<bubblesim:child_script>tricycle.py</bubblesim:child_script>");
  EXPECT_TRUE(fs::equivalent(load_model(text, kScenes).child_script, kScenes / "tricycle.py"));
}

TEST(ModelText, ThatCannotBeUsedStatesWhere) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "<data-string>: is empty"},
      {"ball", "<data-string>"},
      {"<sdf version='1.9'>\n<model name='Ball'>\n<link></sdf>", "<data-string>:3: is not well-formed XML"},
      {"<html/>", "<data-string>:1: is not an SDFormat file"},
      {"<sdf version='1.9'/>", "<data-string>"},
      {"<sdf version='1.9'><world name='w'/></sdf>", "contains a <world>: expected a <model>"},
      {sphere_model("0"), "<data-string>:2: /Ball/l: the mass is 0 kg"},
      {sphere_model("heavy"), "<data-string>:3: /Ball/l: <mass> has the invalid value 'heavy': it must be a number"},
      {sphere_model("nan"), "<data-string>:2: /Ball/l: the mass is nan kg"},
      {"<sdf version='1.9'><model name='m'><link name='l'><collision name='c'><geometry><box><size>1 1</size></box>"
       "</geometry></collision></link></model></sdf>",
       "<size> has the invalid value '1 1': it must be three numbers, separated by spaces"},
      {"<robot name='r'><link name='world'/></robot>", "contains no <link> except the world"},
      {"<robot/>", "<data-string>: No name given for the robot."},
  };
  for (const auto& [text, expected] : cases) {
    const std::string error = problems_of_model(text);
    EXPECT_NE(error.find(expected), std::string::npos) << text << "\n" << error;
  }
}

}  // namespace
}  // namespace bubblesim::test::test_scene_loader
