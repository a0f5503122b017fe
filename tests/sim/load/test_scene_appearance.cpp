// SPDX-License-Identifier: BSD-3-Clause
// Reading <visual>, <material>, <scene> and <light>.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_scene_appearance {
namespace {

const char* const kSphere = "<geometry><sphere><radius>2</radius></sphere></geometry>";

std::vector<VisualDescription> visuals(const std::string& link, bool is_static = false) {
  const TemporaryFile file("model.sdf",
                           in_world(std::string("<model name='m'><static>") + (is_static ? "true" : "false") +
                                    "</static><link name='l'>" + link + "</link></model>"));
  return read_scene(file.path()).models.at(0).links.at(0).visuals;
}

Material material(const std::string& text) {
  return visuals(std::string("<visual name='v'>") + kSphere + "<material>" + text + "</material></visual>")
      .at(0)
      .material;
}

Environment environment(const std::string& text) {
  const TemporaryFile file("world.sdf", in_world(text));
  return read_scene(file.path()).environment;
}

void expect_color(const Color& color, float r, float g, float b) {
  EXPECT_FLOAT_EQ(color.r, r);
  EXPECT_FLOAT_EQ(color.g, g);
  EXPECT_FLOAT_EQ(color.b, b);
}

TEST(Visual, HoldsWhatTheFileStates) {
  const auto read = visuals(std::string("<visual name='v'><pose>1 2 3 0 0 0.5</pose><laser_retro>9</laser_retro>") +
                            kSphere + "</visual>");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].name, "v");
  EXPECT_EQ(read[0].pose, Pose(1, 2, 3, 0, 0, 0.5));
  EXPECT_EQ(read[0].laser_retro, 9);
  EXPECT_EQ(std::get<Sphere>(read[0].geometry).radius, 2);
}

TEST(Visual, OfAMeshShowsTheCollisionShapesInItsColor) {
  const auto read = visuals(
      "<visual name='v'><geometry><mesh><uri>file:///nowhere.dae</uri></mesh></geometry>"
      "<material><diffuse>0 1 0 1</diffuse></material></visual><collision name='c'><pose>0 0 1 0 0 0</pose>"
      "<geometry><box><size>1 2 3</size></box></geometry></collision>");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].pose.position, Vector3(0, 0, 1));
  EXPECT_EQ(std::get<Box>(read[0].geometry).size, Vector3(1, 2, 3));
  expect_color(read[0].material.diffuse, 0, 1, 0);
}

TEST(Visual, PlaneOfAMovingModelEndsSomewhere) {
  const char* const plane =
      "<visual name='v'><geometry><plane><normal>1 0 0</normal><size>2 4</size></plane></geometry></visual>";
  const auto moving = visuals(plane);
  const auto& box = std::get<Box>(moving.at(0).geometry);
  EXPECT_EQ(box.size.x(), 2);
  EXPECT_EQ(box.size.y(), 4);
  EXPECT_LT(((moving[0].pose.orientation * Vector3::UnitZ()) - Vector3::UnitX()).norm(), 1e-9);
  EXPECT_TRUE(std::holds_alternative<Plane>(visuals(plane, true).at(0).geometry));
}

TEST(Material, HasTheColorsGiven) {
  const Material read = material("<diffuse>0.1 0.2 0.3 1</diffuse><emissive>0.4 0.5 0.6 1</emissive>");
  expect_color(read.diffuse, 0.1F, 0.2F, 0.3F);
  expect_color(read.emissive, 0.4F, 0.5F, 0.6F);
}

TEST(Material, NamedByAScriptHasItsColor) {
  const auto named = [](const std::string& name) {
    return material("<script><uri>file://media/materials/scripts/gazebo.material</uri><name>" + name +
                    "</name></script>");
  };
  expect_color(named("Gazebo/Red").diffuse, 1, 0, 0);
  expect_color(named("Gazebo/Turquoise").diffuse, 0, 1, 1);
  expect_color(named("Gazebo/Grey").diffuse, 0.7F, 0.7F, 0.7F);
  expect_color(named("Gazebo/GreenGlow").emissive, 0, 1, 0);
  expect_color(named("Gazebo/Red").emissive, 0, 0, 0);
  expect_color(named("Own/Texture").diffuse, 0.7F, 0.7F, 0.7F);
}

TEST(Material, ColorGivenCountsMoreThanAScripts) {
  expect_color(material("<script><uri>u</uri><name>Gazebo/Red</name></script><diffuse>0 0 1 1</diffuse>").diffuse, 0, 0,
               1);
}

TEST(Material, MayBeACheckerboard) {
  const Material read = material(
      "<bubblesim:checker_size>0.5</bubblesim:checker_size>"
      "<bubblesim:checker_color>0.1 0.2 0.3</bubblesim:checker_color>");
  EXPECT_EQ(read.checker_size, 0.5);
  expect_color(read.checker_color, 0.1F, 0.2F, 0.3F);
}

TEST(Surroundings, HoldWhatTheFileStates) {
  const Environment read = environment(
      "<scene><ambient>0.1 0.2 0.3 1</ambient><background>0.4 0.5 0.6 1</background><shadows>false</shadows><sky/>"
      "</scene>");
  expect_color(read.ambient, 0.1F, 0.2F, 0.3F);
  expect_color(read.background, 0.4F, 0.5F, 0.6F);
  EXPECT_FALSE(read.shadows);
  EXPECT_TRUE(read.sky);
}

TEST(Light, ShinesAsItsPoseTurnsIt) {
  const Environment read = environment(
      "<light name='sun' type='directional'><pose>0 0 9 0 0 1.5707963267948966</pose><diffuse>0.2 0.4 0.6 1</diffuse>"
      "<direction>1 0 -1</direction><cast_shadows>true</cast_shadows><intensity>0.5</intensity></light>"
      "<light name='lamp' type='point'/>");
  ASSERT_EQ(read.lights.size(), 2U);
  EXPECT_LT((read.lights[0].direction.normalized() - Vector3(0, 1, -1).normalized()).norm(), 1e-9);
  expect_color(read.lights[0].diffuse, 0.1F, 0.2F, 0.3F);
  EXPECT_TRUE(read.lights[0].cast_shadows);
}

TEST(Light, IsThereWithoutBeingNamed) { EXPECT_EQ(environment("").lights.size(), 1U); }

}  // namespace
}  // namespace bubblesim::test::test_scene_appearance
