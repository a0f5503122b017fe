// SPDX-License-Identifier: BSD-3-Clause
// What the <gazebo> elements of a robot add to its links, joints and the model: SDFormat, and values for all shapes of
// a link.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "load/load_context.hpp"
#include "load/sdf/elements/element_kinds.hpp"
#include "load/urdf/urdf_robot.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// All <gazebo> of one link, checked. Their elements are parts of those of SDFormat.
struct LinkExtension {
  XmlElement content;           ///< <link>
  XmlElement collision;         ///< <collision>, of each collision without a name
  XmlElement visual;            ///< <visual>, of each visual without a name
  std::optional<bool> gravity;  ///< replaces that in the content
};

struct GazeboExtensions {
  std::map<std::string, LinkExtension> links;  ///< by link
  std::map<std::string, XmlElement> joints;    ///< by joint; part of SDFormat's <joint>
  XmlElement model;                            ///< part of SDFormat's <model>
  std::set<std::string> preserved_joints;      ///< fixed joints that stay
  std::set<std::string> unlumped_joints;       ///< fixed joints that become revolute ones with limits of 0
};

/// Reads all <gazebo> of a robot; warns about those of unknown links and joints.
GazeboExtensions read_extensions(const XmlElement& robot, const UrdfRobot& parts, LoadContext& context);

/// Adds the content of one element of SDFormat to another of its kind: children that have children are merged, others
/// are replaced. Unknown elements are left out.
void merge(const XmlElement& from, XmlElement& into, const ElementKind& kind);

}  // namespace bubblesim
