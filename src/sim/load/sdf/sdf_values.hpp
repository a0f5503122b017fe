// SPDX-License-Identifier: BSD-3-Clause
// Texts of elements that SDFormat would refuse to read, and the whole file with them.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "load/load_context.hpp"

namespace bubblesim {

/// Replaces values in the <sdf> of `file` that its description does not allow, so that the rest can be read: by what
/// Gazebo takes, with a warning, or by the default, with a problem. True when it has changed anything.
bool replace_bad_values(tinyxml2::XMLElement& sdf, const std::string& file, LoadContext& reading);

/// The same of what stands in a <gazebo> of URDF: `parent` says where SDFormat has it, "link" or "model".
bool replace_bad_values(tinyxml2::XMLElement& element, const std::string& parent, const std::string& file,
                        LoadContext& reading);

}  // namespace bubblesim
