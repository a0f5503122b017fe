// SPDX-License-Identifier: BSD-3-Clause
// The <visual>s, <collision>s and <material>s of URDF.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bubblesim/math.hpp"
#include "load/load_context.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// A shape of a link. <gazebo> can add SDFormat to it, so it is an element of SDFormat: <visual> or <collision>, with
/// <geometry> and <material>, in the place of that of URDF.
struct UrdfShape {
  std::string name;  ///< may be empty
  Pose pose;         ///< in the link's frame
  XmlElement element;
};

/// The materials of one robot, by name. The first definition counts: those of the robot, then those in visuals.
class UrdfMaterials {
 public:
  /// The definitions of a <robot>.
  UrdfMaterials(const XmlElement& robot, const std::string& path, LoadContext& context);

  /// The <material> of a visual, as SDFormat's; defines it if it is new. Empty when it has no appearance.
  std::optional<XmlElement> read(const XmlElement& material, const std::string& path, LoadContext& context);

 private:
  std::map<std::string, XmlElement> known_;
};

/// Reads a <visual> or <collision> of the link at a path; only visuals have materials. Empty when it has no geometry or
/// an unknown one, with a warning.
std::optional<UrdfShape> read_shape(const XmlElement& shape, UrdfMaterials& materials, const std::string& path,
                                    LoadContext& context);

}  // namespace bubblesim
