// SPDX-License-Identifier: BSD-3-Clause
// The elements of scene files, for documentation.
#pragma once

#include <string>
#include <vector>

namespace bubblesim {

/// A line of the table of elements.
struct SceneElement {
  std::string path;          ///< from the root: world/model/link/inertial/mass; of an attribute: world/light/@type
  std::string type;          ///< none, any, text, flag, integer, number, vector2, vector3, color or pose
  std::string default_text;  ///< empty: none
  std::string effect;        ///< read, none or left out
  std::string reason;        ///< why it is not read
};

/// All elements of SDFormat 1.0 to 1.12 that may be in a scene file, and those of bubblesim. What several elements have
/// in common, such as a geometry, is listed below the first of them.
std::vector<SceneElement> scene_elements();

}  // namespace bubblesim
