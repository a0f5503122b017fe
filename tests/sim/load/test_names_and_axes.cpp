// SPDX-License-Identifier: BSD-3-Clause
// <bubblesim:alias> and <bubblesim:axis_convention>.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_names_and_axes {
namespace {

const std::string kCar = R"(
  <model name='Car_1'>
    <bubblesim:alias>Car</bubblesim:alias>
    <link name='base'>
      <bubblesim:alias>body</bubblesim:alias>
      <sensor name='eye_0' type='sonar'>
        <bubblesim:alias>eye</bubblesim:alias><sonar><min>0</min><max>1</max><radius>0</radius></sonar>
      </sensor>
      <sensor name='eye_1' type='sonar'>
        <bubblesim:alias>eye</bubblesim:alias><sonar><min>0</min><max>1</max><radius>0</radius></sonar>
      </sensor>
    </link>
    <link name='wheel'/>
    <joint name='axle_1' type='revolute'>
      <bubblesim:alias>axle</bubblesim:alias>
      <parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis>
    </joint>
    <model name='trailer_1'><bubblesim:alias>trailer</bubblesim:alias><link name='box'/></model>
  </model>)";

SceneDescription load(const std::string& world) {
  const TemporaryFile file("names.sdf", in_world(world));
  return read_scene(file.path());
}

TEST(NamesAndAxes, ObjectsOfEachKindHaveAnAlias) {
  const TemporaryFile file("names.sdf", in_world(kCar));
  const Simulation simulation(load_scene(file.path()));
  const SceneTree& tree = simulation.world().tree();
  EXPECT_EQ(tree.path(tree.find("/Car/body/eye[1]")), "/Car/body/eye[1]");
  EXPECT_EQ(tree.at(tree.find("/Car/eye", kNoObject, 1)).name, "eye_1");
  EXPECT_EQ(tree.at(tree.find("/Car/axle")).kind, ObjectKind::kJoint);
  EXPECT_EQ(tree.path(tree.find("/trailer/box")), "/Car/trailer/box");
  EXPECT_EQ(tree.find("/Car_1/base/eye_0"), tree.find("/Car/body/eye[0]")) << "the file's names lead there, too";
}

TEST(NamesAndAxes, AnIncludeNamesAndTurnsItsModel) {
  const SceneDescription scene = load(
      "<include><uri>model://table</uri><name>Table_7</name><bubblesim:alias>Table</bubblesim:alias>"
      "<bubblesim:axis_convention>coppeliasim</bubblesim:axis_convention></include>"
      "<include><uri>model://table</uri></include>");
  EXPECT_EQ(scene.models[0].name, "Table_7");
  EXPECT_EQ(scene.models[0].alias, "Table");
  EXPECT_EQ(scene.models[0].axes, AxisConvention::kCoppeliaSim);
  EXPECT_EQ(scene.models[1].alias, "");
  EXPECT_EQ(scene.models[1].axes, AxisConvention::kSdformat);
}

TEST(NamesAndAxes, AModelMayDifferFromTheConventionOfItsWorld) {
  const SceneDescription scene = load(
      "<bubblesim:axis_convention>coppeliasim</bubblesim:axis_convention>" + kCar +
      "<model name='other'><bubblesim:axis_convention>sdformat</bubblesim:axis_convention><link name='a'/></model>");
  EXPECT_EQ(scene.models[0].axes, AxisConvention::kCoppeliaSim);
  EXPECT_EQ(scene.models[1].axes, AxisConvention::kSdformat);
}

}  // namespace
}  // namespace bubblesim::test::test_names_and_axes
