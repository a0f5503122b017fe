// SPDX-License-Identifier: BSD-3-Clause
// Elements of SDFormat with numbers that are read back to the last bit.
#pragma once

#include <initializer_list>
#include <pugixml.hpp>
#include <string>

#include "bubblesim/math.hpp"
#include "load/ttt/scene_file.hpp"

namespace bubblesim::ttt {

/// Separated by spaces.
std::string exact(std::initializer_list<double> values);
/// An element with text.
void put(pugi::xml_node parent, const char* name, const std::string& text);
void put(pugi::xml_node parent, const char* name, double value);
/// A <pose> with a quaternion.
void put_pose(pugi::xml_node parent, const Pose& pose);
/// r g b 1, each from 0 to 1.
std::string color_text(const Rgb& color);
/// An element with a name.
pugi::xml_node named(pugi::xml_node parent, const char* element, const std::string& name);

}  // namespace bubblesim::ttt
