// SPDX-License-Identifier: BSD-3-Clause
// The <robot> of URDF as it is in the file, checked: links, joints and transmissions. Without <gazebo>.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/urdf/urdf_shapes.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// Mass and inertia, about the centre of mass along the axes of the link.
struct UrdfInertial {
  double mass = 0;  ///< kg
  Vector3 centre_of_mass;
  Matrix3 inertia = Matrix3::Zero();  ///< kg m^2

  /// Gazebo takes lighter links as links without mass.
  bool has_mass() const { return mass > 1e-6; }
};

struct UrdfLink {
  std::string name;
  UrdfInertial inertial;
  std::vector<UrdfShape> collisions;
  std::vector<UrdfShape> visuals;
  XmlElement place;  ///< an element without content, in the link's place
};

struct UrdfJoint {
  std::string name;
  std::string type;  ///< URDF's: revolute, continuous, prismatic, fixed, floating or planar
  std::string parent;
  std::string child;
  Pose pose;        ///< of the child, and of the joint, in the frame of the parent
  XmlElement axis;  ///< SDFormat's <axis> of a joint with an axis
  std::optional<MimicDescription> mimic;
  XmlElement place;  ///< an element without content, in the joint's place
};

struct UrdfRobot {
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::vector<TransmissionDescription> transmissions;
  Source source;
};

/// The link of this name is not a body: what is attached to it is attached to the world.
constexpr const char* kUrdfWorld = "world";

/// Reads a <robot> and reports all its problems: numbers that cannot be read, names that are missing, used twice or
/// unknown, and links and joints that are not a tree. Without a problem the links are a tree, whose root or inner node
/// may be the world.
UrdfRobot read_robot(const XmlElement& robot, LoadContext& context);

}  // namespace bubblesim
