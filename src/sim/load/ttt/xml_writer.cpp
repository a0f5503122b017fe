// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/xml_writer.hpp"

#include <algorithm>

#include "scene/describe.hpp"

namespace bubblesim::ttt {

std::string exact(std::initializer_list<double> values) {
  std::string all;
  for (const double value : values) all += (all.empty() ? "" : " ") + bubblesim::exact(value);
  return all;
}

void put(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

void put(pugi::xml_node parent, const char* name, double value) { put(parent, name, bubblesim::exact(value)); }

void put_pose(pugi::xml_node parent, const Pose& pose) {
  pugi::xml_node element = parent.append_child("pose");
  element.append_attribute("rotation_format").set_value("quat_xyzw");
  const Vector3& p = pose.position;
  const Quaternion& q = pose.orientation;
  element.text().set(exact({p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}).c_str());
}

std::string color_text(const Rgb& color) {
  const auto part = [&color](std::size_t i) { return std::clamp(color[i], 0.0, 1.0); };
  return exact({part(0), part(1), part(2), 1});
}

pugi::xml_node named(pugi::xml_node parent, const char* element, const std::string& name) {
  pugi::xml_node node = parent.append_child(element);
  node.append_attribute("name").set_value(name.c_str());
  return node;
}

}  // namespace bubblesim::ttt
