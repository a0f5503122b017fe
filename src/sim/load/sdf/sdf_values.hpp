// SPDX-License-Identifier: BSD-3-Clause
// Replaces texts of elements that SDFormat would reject together with the whole file.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "load/load_context.hpp"

namespace bubblesim {

/// Replaces invalid values in the <sdf> of `file`, so that the rest can be read: by Gazebo's interpretation, with a
/// warning, or by the default, with a problem. Returns whether anything changed.
bool replace_bad_values(tinyxml2::XMLElement& sdf, const std::string& file, LoadContext& reading);

/// The same for an element in a <gazebo> of URDF: `parent` is its parent in SDFormat, "link" or "model".
bool replace_bad_values(tinyxml2::XMLElement& element, const std::string& parent, const std::string& file,
                        LoadContext& reading);

}  // namespace bubblesim
