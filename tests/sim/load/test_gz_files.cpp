// SPDX-License-Identifier: BSD-3-Clause
// Worlds for gz-sim, and files of commercial robots.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_gz_files {
namespace {

SceneDescription loaded(const std::string& text, std::vector<Problem>* warnings = nullptr) {
  const TemporaryFile file("gz.sdf", text);
  return read_scene(file.path(), {}, warnings);
}

TEST(ModelOfAServer, IsLookedForByItsName) {
  const SceneDescription scene = loaded(
      in_world("<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane</uri></include>"
               "<include><name>g2</name><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground%20Plane/2</uri>"
               "</include>"));
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_TRUE(scene.models[0].is_static);
}

TEST(PbrMaterial, GivesItsAlbedoMap) {
  const TemporaryFile picture("albedo.ppm", std::string("P6 2 1 255\n\xff\0\0\0\xff\0", 17));
  const TemporaryFile file("pbr.sdf",
                           in_world("<model name='m'><static>1</static><link name='l'><visual name='v'>"
                                    "<geometry><box><size>1 1 1</size></box></geometry><material><pbr><metal>"
                                    "<albedo_map>albedo.ppm</albedo_map></metal></pbr></material></visual>"
                                    "</link></model>"));
  const Material material = read_scene(file.path()).models.at(0).links.at(0).visuals.at(0).material;
  ASSERT_NE(material.texture, nullptr);
  EXPECT_NEAR(material.diffuse.r, 0.5, 0.01);
}

TEST(Lidar, MayGoRoundByARoundedTurn) {
  const SceneDescription scene = loaded(
      in_world("<model name='m'><link name='l'><sensor name='s' type='ray'><ray><scan><horizontal><samples>9</samples>"
               "<min_angle>0</min_angle><max_angle>6.28319</max_angle></horizontal><vertical><samples>3</samples>"
               "<min_angle>-1.5708</min_angle><max_angle>1.5708</max_angle></vertical></scan><range><min>0.1</min>"
               "<max>9</max></range></ray></sensor></link></model>"));
  EXPECT_EQ(scene.models.at(0).links[0].sensors.size(), 1U);
}

TEST(Sensor, StatesWhereGzSimPublishesIt) {
  std::vector<Problem> warnings;
  const SceneDescription scene = loaded(
      in_world("<model name='m'><link name='l'><sensor name='camera' type='depth'><topic>depth</topic><gz_frame_id>eye"
               "</gz_frame_id><camera><camera_info_topic>optics</camera_info_topic><optical_frame_id>optical"
               "</optical_frame_id></camera></sensor><sensor name='imu' type='imu'><gz_frame_id>gyro</gz_frame_id>"
               "<topic>__default_topic__</topic></sensor><sensor name='touch' type='contact'><contact>"
               "<collision>c</collision><topic>bumps</topic></contact></sensor><collision name='c'><geometry><sphere>"
               "<radius>1</radius></sphere></geometry></collision></link></model>"),
      &warnings);
  const std::string reported = lines_of(warnings);
  EXPECT_EQ(reported.find("ignored"), std::string::npos) << reported;
  const std::vector<SensorDescription>& sensors = scene.models.at(0).links.at(0).sensors;
  ASSERT_EQ(sensors.size(), 3U);
  EXPECT_EQ(sensors[0].type, "depth_camera");
  EXPECT_EQ(sensors[0].gz.topic, "depth");
  EXPECT_EQ(sensors[0].gz.info_topic, "optics");
  EXPECT_EQ(sensors[0].gz.frame, "optical");
  EXPECT_EQ(sensors[1].gz.topic, "");
  EXPECT_EQ(sensors[1].gz.frame, "gyro");
  EXPECT_EQ(sensors[2].gz.topic, "bumps");
}

TEST(LaterVersions, AreNotReportedAsLeftOutWhereTheyAreRead) {
  const auto joint = [](const std::string& name, const std::string& child, const std::string& more) {
    return "<joint name='" + name + "' type='revolute'><parent>a</parent><child>" + child + "</child><axis><xyz>0 0 1" +
           "</xyz>" + more + "</axis></joint>";
  };
  std::vector<Problem> warnings;
  const SceneDescription scene =
      loaded("<sdf version='1.9'><world name='w'><model name='m'><link name='a'/><link name='b'/><link name='c'/>" +
                 joint("one", "b", "") + joint("two", "c", "<mimic joint='one'><multiplier>2</multiplier></mimic>") +
                 "</model></world></sdf>",
             &warnings);
  const std::string reported = lines_of(warnings);
  EXPECT_EQ(scene.models.at(0).joints.at(1).axes.at(0).mimic->multiplier, 2);
  EXPECT_EQ(reported.find("ignored"), std::string::npos) << reported;
}

TEST(Lights, OfOneNameAreOne) {
  const std::string lamp = "<light name='sun' type='directional'/>";
  EXPECT_EQ(loaded(in_world(lamp + lamp)).environment.lights.size(), 1U);
}

}  // namespace
}  // namespace bubblesim::test::test_gz_files
