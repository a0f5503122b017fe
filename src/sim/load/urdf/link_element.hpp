// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "load/load_context.hpp"
#include "load/urdf/fixed_joint_lumping.hpp"
#include "load/urdf/gazebo_extensions.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// SDFormat's <link> of a body, with the path of the link: the shapes of its parts, and what <gazebo> adds to them. The
/// pose and the inertia are not in it.
XmlElement link_element(const LumpedLink& body, const GazeboExtensions& extensions, const std::string& path,
                        LoadContext& context);

}  // namespace bubblesim
