// SPDX-License-Identifier: BSD-3-Clause
// URDF's <transmission> is kept as data.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim::test::test_transmissions {
namespace {

ModelDescription robot_with(const std::string& transmission) {
  return load_model(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/></inertial></link>" +
          transmission + "</robot>",
      "/");
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

}  // namespace
}  // namespace bubblesim::test::test_transmissions
