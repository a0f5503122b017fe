// SPDX-License-Identifier: BSD-3-Clause
// Files that Gazebo takes although they break SDFormat's rules: each is read, with a warning that states what was done.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_tolerance {
namespace {

struct Read {
  SceneDescription scene;
  std::string warnings;

  const ModelDescription& model() const { return scene.models.back(); }
};

Read read(const std::string& text) {
  const TemporaryFile file("odd.sdf", text);
  std::vector<Problem> warnings;
  Read read{read_scene(file.path(), {}, &warnings), ""};
  read.warnings = lines_of(warnings);
  return read;
}

Read read_model(const std::string& parts, const std::string& version = "1.6") {
  return read("<sdf version='" + version + "'>\n<model name='m'>\n" + parts + "</model></sdf>");
}

Read read_sensor(const std::string& type, const std::string& content) {
  return read_model("<link name='l'><sensor name='s' type='" + type + "'>" + content + "</sensor></link>");
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return "<joint name='" + name + "' type='fixed'><parent>" + parent + "</parent><child>" + child + "</child></joint>";
}

void expect_warning(const Read& found, const std::string& part) {
  EXPECT_NE(found.warnings.find(part), std::string::npos) << "no '" << part << "' in: " << found.warnings;
}

TEST(Gazebo, TakesAttributesWithoutQuotes) {
  const Read found =
      read("<sdf version=1.6>\n<model name=m>\n<link name=base><pose frame=>1 2 3 0 0 0</pose></link></model></sdf>");
  EXPECT_EQ(found.model().name, "m");
  EXPECT_EQ(found.model().links.at(0).pose.position, Vector3(1, 2, 3));
  expect_warning(found, "odd.sdf:3: an attribute has no quotes");
}

TEST(Gazebo, IgnoresAJointWhoseLinkDoesNotExist) {
  for (const char* end : {"parent", "child"}) {
    const bool is_parent = std::string(end) == "parent";
    const Read found =
        read_model("<link name='base'/>\n" + joint("j", is_parent ? "bass" : "base", is_parent ? "base" : "bass"));
    EXPECT_TRUE(found.model().joints.empty());
    expect_warning(found, "odd.sdf:4: /m/j: the " + std::string(end) +
                              " 'bass' is not a link of this model; did you mean base?: this joint is ignored");
  }
}

TEST(Gazebo, IgnoresAnIncludeThatDoesNotExist) {
  const Read found = read_model("<link name='base'/>\n<include><uri>model://nowhere</uri></include>");
  EXPECT_EQ(found.model().links.size(), 1U);
  expect_warning(found, "odd.sdf:4: model not found: 'model://nowhere', ignored");
}

TEST(Gazebo, TakesAJointNamedWorld) {
  const Read found = read_model("<link name='a'/>" + joint("world", "world", "a"));
  EXPECT_EQ(found.model().joints.at(0).name, "world");
  EXPECT_EQ(found.model().joints.at(0).parent, "world");
}

TEST(Gazebo, FindsLinksOfNestedModelsByTheEndOfTheirName) {
  const Read found =
      read_model("<link name='a'/><model name='arm'><link name='hand'/></model>" + joint("j", "a", "m::arm::hand"));
  EXPECT_EQ(found.model().joints.at(0).child, "arm::hand");
  expect_warning(found, "the child 'm::arm::hand' is not found: using arm::hand");
}

TEST(Gazebo, TakesFramesThatItDoesNotKnow) {
  const Read found = read_model("<link name='a'><pose frame='b::c'>1 0 0 0 0 0</pose></link>");
  EXPECT_EQ(found.model().links.at(0).pose.position, Vector3(1, 0, 0));
  expect_warning(found, "is relative to 'b::c', which is not a link");
}

TEST(Gazebo, TakesTwoSensorsOfOneName) {
  const Read found = read_model("<link name='l'><sensor name='s' type='imu'/><sensor name='s' type='imu'/></link>");
  ASSERT_EQ(found.model().links.at(0).sensors.size(), 2U);
  EXPECT_EQ(found.model().links.at(0).sensors[1].name, "s_2");
  expect_warning(found, "/m/l/s_2: renamed: another sensor has the name 's'");
}

TEST(Gazebo, TakesTwoJointsOfOneName) {
  const Read found =
      read_model("<link name='a'/><link name='b'/><link name='c'/>" + joint("j", "a", "b") + joint("j", "a", "c"));
  ASSERT_EQ(found.model().joints.size(), 2U);
  EXPECT_EQ(found.model().joints[1].name, "j_2");
}

TEST(Gazebo, TakesObjectsWithoutAName) {
  const Read found =
      read_model("<link name='l'><visual><geometry><box><size>1 1 1</size></box></geometry></visual></link>");
  EXPECT_EQ(found.model().links.at(0).visuals.at(0).name, "visual");
  expect_warning(found, "<visual> has no name: named visual");
}

TEST(Gazebo, ReadsTheNumberBeforeAUnit) {
  const Read found = read_model("<link name='l'><inertial><mass>2 kg</mass></inertial></link>");
  EXPECT_EQ(found.model().links.at(0).mass, 2);
  expect_warning(found, "odd.sdf:3: /m/l: <mass> is '2 kg': using 2");
}

TEST(Numbers, WithACommaAreWarnedOf) {
  const Read found = read_model("<link name='l'><inertial><mass>2,5</mass></inertial></link>");
  EXPECT_EQ(found.model().links.at(0).mass, 2);
  expect_warning(found, "<mass> is '2,5': using 2; numbers have a decimal point, as 0.5");
}

TEST(Gazebo, TurnsLasersRoundThatGoFromHighToLow) {
  const Read found =
      read_sensor("ray",
                  "<ray><scan><horizontal><samples>9</samples><min_angle>1</min_angle><max_angle>-1</max_angle>"
                  "</horizontal></scan><range><min>0.1</min><max>9</max></range></ray>");
  const auto& lidar = found.model().links.at(0).sensors.at(0).kind.get<LidarDescription>();
  EXPECT_EQ(lidar.horizontal.min, -1);
  EXPECT_EQ(lidar.horizontal.max, 1);
  expect_warning(found, "from low to high");
}

TEST(Gazebo, TakesANarrowFieldOfView) {
  const Read found = read_sensor("camera", "<camera><horizontal_fov>0.088</horizontal_fov></camera>");
  EXPECT_EQ(found.model().links.at(0).sensors.at(0).kind.get<CameraDescription>().horizontal_fov, 0.088);
}

TEST(Gazebo, TakesNegativeNumbersOfLights) {
  const Read found = read(
      "<sdf version='1.6'><world name='w'><light name='lamp' type='point'><attenuation><range>-1</range></attenuation>"
      "</light></world></sdf>");
  EXPECT_EQ(found.scene.environment.lights.at(0).range, 0);
  expect_warning(found, "/lamp: ");
}

TEST(Gazebo, ScalesMeshesByOneNumber) {
  const TemporaryFile mesh("wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Read found = read_model("<link name='l'><visual name='v'><geometry><mesh><uri>file://" + mesh.path() +
                                "</uri><scale>2</scale></mesh></geometry></visual></link>");
  expect_warning(found, "<scale> is '2': using 2 2 2");
}

TEST(Sdformat111, HasCones) {
  const Read found = read_model(
      "<link name='l'><collision name='c'><geometry><cone><radius>1</radius><length>2</length></cone></geometry>"
      "</collision></link>",
      "1.11");
  EXPECT_TRUE(std::holds_alternative<Mesh>(found.model().links.at(0).collisions.at(0).geometry));
}

}  // namespace
}  // namespace bubblesim::test::test_tolerance
