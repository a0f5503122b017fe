// SPDX-License-Identifier: BSD-3-Clause
// Transmissions of URDF, kept as data for ros_control.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/source.hpp"

namespace bubblesim {

struct TransmissionJoint {
  std::string name;
  std::vector<std::string> hardware_interfaces;           ///< such as hardware_interface/EffortJointInterface
  std::optional<double> initial_position = std::nullopt;  ///< rad or m, of the position's state in a <ros2_control>
};

struct TransmissionActuator {
  std::string name;
  double mechanical_reduction = 1;  ///< motor angle = reduction * joint angle
  std::vector<std::string> hardware_interfaces;
};

/// A <transmission> or <ros2_control> of URDF: the interfaces of joints for ros_control, without effect on the physics.
struct TransmissionDescription {
  std::string name;
  std::string type;  ///< such as transmission_interface/SimpleTransmission, or ros2_control
  std::vector<TransmissionJoint> joints;
  std::vector<TransmissionActuator> actuators;
  Source source;
};

}  // namespace bubblesim
