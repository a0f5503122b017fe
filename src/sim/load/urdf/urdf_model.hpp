// SPDX-License-Identifier: BSD-3-Clause
// Robots in URDF.
#pragma once

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// The model that Gazebo makes of a <robot>: links at fixed joints are one link, and <gazebo> elements apply. Names of
/// links, joints and shapes are Gazebo's. Throws SceneError with all problems up to then when the robot has some.
ModelDescription read_urdf(const XmlElement& robot, LoadContext& context);

}  // namespace bubblesim
