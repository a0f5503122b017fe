// SPDX-License-Identifier: BSD-3-Clause
// Robots that a test writes.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "load/load_context.hpp"
#include "load/urdf/urdf_model.hpp"
#include "load/xml/xml_parser.hpp"
#include "scene_files.hpp"

namespace bubblesim::test {

const std::string kUnitInertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>";
const std::string kUnitInertial = "<inertial><mass value='1'/>" + kUnitInertia + "</inertial>";
const std::string kUnitBox = "<geometry><box size='1 1 1'/></geometry>";
const std::string kTurning = "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='2' velocity='3'/>";

inline std::string robot(const std::string& parts) { return "<robot name='r'>" + parts + "</robot>"; }
inline std::string link_text(const std::string& name, const std::string& parts = kUnitInertial) {
  return "<link name='" + name + "'>" + parts + "</link>";
}
inline std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                              const std::string& child, const std::string& parts = "<origin xyz='0 0 1'/>" + kTurning) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         parts + "</joint>";
}
inline std::string gazebo(const std::string& reference, const std::string& parts) {
  return "<gazebo reference='" + reference + "'>" + parts + "</gazebo>";
}

inline ModelDescription read(const std::string& text, std::string* warnings = nullptr) {
  LoadContext context("r.urdf", ".");
  const XmlElement root = parse_xml(text, "r.urdf", context.warnings());
  ModelDescription model = read_urdf(root, context);
  if (!context.problems().empty()) throw SceneError(context.problems());
  if (warnings != nullptr) *warnings = lines_of(context.warnings());
  return model;
}

inline std::string warnings_about(const std::string& text) {
  std::string warnings;
  read(text, &warnings);
  return warnings;
}

inline std::string problems_of(const std::string& text) {
  try {
    read(text);
  } catch (const SceneError& error) {
    return lines_of(error.problems);
  }
  return "it loads";
}

inline bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline std::vector<std::string> names_of_links(const ModelDescription& model) {
  std::vector<std::string> names;
  for (const LinkDescription& each : model.links) names.push_back(each.name);
  return names;
}

}  // namespace bubblesim::test
