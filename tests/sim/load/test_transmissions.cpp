// SPDX-License-Identifier: BSD-3-Clause
// URDF's <transmission> and <ros2_control> are kept as data.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "load/urdf/urdf_robot.hpp"
#include "load/xml/xml_parser.hpp"

namespace bubblesim::test::test_transmissions {
namespace {

ModelDescription robot_with(const std::string& transmission) {
  return load_model(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/></inertial></link>" +
          transmission + "</robot>",
      "/");
}

/// A robot whose <ros2_control> has one joint with one interface; what is wrong is in the context.
UrdfRobot robot_with_interface(const std::string& interface, LoadContext& context) {
  const XmlElement root = parse_xml("<robot name='r'><link name='a'/><ros2_control name='s'><joint name='j'>" +
                                        interface + "</joint></ros2_control></robot>",
                                    "r.urdf", context.warnings());
  return read_robot(root, context);
}

TEST(Transmission, HasItsJointsAndActuators) {
  const ModelDescription robot = robot_with(
      "<transmission name='t'><type>transmission_interface/SimpleTransmission</type><joint name='axle'>"
      "<hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint><actuator name='motor'>"
      "<mechanicalReduction>-20</mechanicalReduction></actuator></transmission>");
  ASSERT_EQ(robot.transmissions.size(), 1U);
  const TransmissionDescription& transmission = robot.transmissions[0];
  EXPECT_EQ(transmission.name, "t");
  EXPECT_EQ(transmission.type, "transmission_interface/SimpleTransmission");
  EXPECT_EQ(transmission.joints.at(0).name, "axle");
  EXPECT_EQ(transmission.joints.at(0).hardware_interfaces.at(0), "hardware_interface/VelocityJointInterface");
  EXPECT_EQ(transmission.actuators.at(0).mechanical_reduction, -20);
}

TEST(Ros2Control, GivesItsJointsTheInterfacesOfTheirCommands) {
  const ModelDescription robot = robot_with(
      "<ros2_control name='system' type='system'>"
      "<hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>"
      "<joint name='slide'><command_interface name='position'><param name='min'>-15</param></command_interface>"
      "<command_interface name='effort'/><state_interface name='position'/></joint>"
      "<joint name='passive'><state_interface name='velocity'/></joint></ros2_control>");
  ASSERT_EQ(robot.transmissions.size(), 1U);
  const TransmissionDescription& system = robot.transmissions[0];
  EXPECT_EQ(system.name, "system");
  EXPECT_EQ(system.type, "ros2_control");
  ASSERT_EQ(system.joints.size(), 2U);
  EXPECT_EQ(system.joints[0].name, "slide");
  EXPECT_EQ(system.joints[0].hardware_interfaces,
            (std::vector<std::string>{"hardware_interface/PositionJointInterface",
                                      "hardware_interface/EffortJointInterface"}));
  EXPECT_EQ(system.joints[1].name, "passive");
  EXPECT_TRUE(system.joints[1].hardware_interfaces.empty());
}

TEST(Ros2Control, StatesWhereAJointBegins) {
  const ModelDescription robot = robot_with(
      "<ros2_control name='s'><joint name='slide'><state_interface name='velocity'><param "
      "name='initial_value'>3</param>"
      "</state_interface><state_interface name='position'><param name='initial_value'> 0.25 </param></state_interface>"
      "</joint><joint name='swing'><state_interface name='position'/></joint></ros2_control>");
  const std::vector<TransmissionJoint>& joints = robot.transmissions.at(0).joints;
  EXPECT_EQ(joints.at(0).initial_position, 0.25);
  EXPECT_FALSE(joints.at(1).initial_position.has_value());
}

TEST(Ros2Control, RefusesAnInitialValueThatIsNoNumber) {
  LoadContext context("r.urdf", ".");
  const UrdfRobot robot = robot_with_interface(
      "<state_interface name='position'><param name='initial_value'>up</param></state_interface>", context);
  EXPECT_FALSE(robot.transmissions.at(0).joints.at(0).initial_position.has_value());
  ASSERT_EQ(context.problems().size(), 1U);
  EXPECT_NE(context.problems()[0].message.find("up"), std::string::npos);
}

TEST(Ros2Control, WarnsOfACommandInterfaceThatIsUnknown) {
  LoadContext context("r.urdf", ".");
  const UrdfRobot robot = robot_with_interface("<command_interface name='current'/>", context);
  EXPECT_TRUE(robot.transmissions.at(0).joints.at(0).hardware_interfaces.empty());
  ASSERT_EQ(context.warnings().size(), 1U);
  EXPECT_NE(context.warnings()[0].message.find("current"), std::string::npos);
}

}  // namespace
}  // namespace bubblesim::test::test_transmissions
