// SPDX-License-Identifier: BSD-3-Clause
// Reading <plugin>.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_scene_plugins {
namespace {

std::string plugin(const std::string& name) {
  return "\n<plugin name='" + name + "' filename='lib" + name +
         ".so'><wheel_radius>0.1</wheel_radius>"
         "<noise><mean>  0 </mean></noise></plugin>";
}

void expect_plugin(const std::vector<PluginDescription>& plugins, const std::string& name, int line) {
  ASSERT_EQ(plugins.size(), 1U);
  EXPECT_EQ(plugins[0].name, name);
  EXPECT_EQ(plugins[0].filename, "lib" + name + ".so");
  EXPECT_EQ(plugins[0].source.line, line);
  ASSERT_EQ(plugins[0].parameters.size(), 2U);
  EXPECT_EQ(plugins[0].parameters[0].name, "wheel_radius");
  EXPECT_EQ(plugins[0].parameters[0].text, "0.1");
  ASSERT_EQ(plugins[0].parameters[1].children.size(), 1U);
  EXPECT_EQ(plugins[0].parameters[1].children[0].name, "mean");
}

TEST(Plugins, StandInWorldsModelsAndSensors) {
  const TemporaryFile file("plugins.sdf", in_world(plugin("world") + "<model name='m'>" + plugin("drive") +
                                                   "<link name='l'><sensor name='s' type='imu'>" + plugin("imu") +
                                                   "</sensor></link></model>"));
  const SceneDescription scene = read_scene(file.path());
  expect_plugin(scene.plugins, "world", 2);
  expect_plugin(scene.models.at(0).plugins, "drive", 3);
  expect_plugin(scene.models.at(0).links.at(0).sensors.at(0).plugins, "imu", 4);
}

TEST(Plugins, OfAUrdfRobotAreThoseOfItsExtensions) {
  const ModelDescription model = load_model(
      "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
      "ixz='0' iyz='0'/></inertial></link><gazebo>" +
          plugin("drive") + "</gazebo></robot>",
      ".");
  ASSERT_EQ(model.plugins.size(), 1U);
  EXPECT_EQ(model.plugins[0].filename, "libdrive.so");
  ASSERT_EQ(model.plugins[0].parameters.size(), 2U);
  EXPECT_EQ(model.plugins[0].parameters[0].text, "0.1");
}

}  // namespace
}  // namespace bubblesim::test::test_scene_plugins
