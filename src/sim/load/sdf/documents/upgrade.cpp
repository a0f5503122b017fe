// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/documents/upgrade.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "load/sdf/elements/element_kinds.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// Versions are compared as numbers: 1.10 is newer than 1.9.
struct Version {
  int major = 0;
  int minor = 0;
};

constexpr int kNewestMinor = 12;

bool older(const Version& version, int minor) { return version.major == 1 && version.minor < minor; }

Version version_of(const XmlElement& sdf) {
  const std::string* text = sdf.attribute("version");
  if (text == nullptr) {
    throw SceneError(
        {{*sdf.file, sdf.line, "", "<" + sdf.name + "> has no version: use <" + sdf.name + " version=\"1.6\">"}});
  }
  const std::string given = trimmed(*text);
  char* end = nullptr;
  const long major = std::strtol(given.c_str(), &end, 10);
  const bool has_minor = end != given.c_str() && *end == '.' && std::isdigit(static_cast<unsigned char>(end[1])) != 0;
  if (!has_minor) {
    throw SceneError({{*sdf.file, sdf.line, "", "invalid version '" + *text + "': expected a version such as 1.6"}});
  }
  return {static_cast<int>(major), static_cast<int>(std::strtol(end + 1, nullptr, 10))};
}

template <class Visit>
void visit_all(XmlElement& element, const Visit& visit) {
  if (element.name == "plugin") return;  // its content is not SDFormat
  visit(element);
  for (XmlElement& child : element.children) visit_all(child, visit);
}

constexpr std::array<const char*, 6> kValueAttributes = {"xyz", "rgba", "angle", "enabled", "link", "pose"};

/// The same for elements that the table does not have any more.
void turn_all_attributes_into_elements(XmlElement& element) {
  for (XmlElement& child : element.children) turn_all_attributes_into_elements(child);
  for (const XmlAttribute& each : std::exchange(element.attributes, {})) {
    const bool is_value =
        std::find(kValueAttributes.begin(), kValueAttributes.end(), each.name) != kValueAttributes.end();
    if (is_value && element.text.empty()) {
      element.text = each.value;
    } else {
      element.add_child(each.name, each.value);
    }
  }
}

/// Before 1.3, values were attributes: <mass> was mass="1", <pose> was <origin pose="..."/>, <parent> was
/// <parent link="..."/>.
void turn_attributes_into_elements(XmlElement& element, const ElementKind& kind) {
  for (XmlElement& child : element.children) {
    if (child.name == "origin" && kind.child("pose") != nullptr) child.name = "pose";
    const ElementKind* known = kind.child(child.name);
    if (element.name == "physics" && (known == nullptr || known->type == ValueType::kAny)) {
      turn_all_attributes_into_elements(child);
    }
    if (known == nullptr || known->type == ValueType::kAny) continue;
    for (const char* name : kValueAttributes) {
      const std::string* value = child.attribute(name);
      const bool is_value = known->type != ValueType::kNone || known->attribute(name) != nullptr;
      if (value == nullptr || !is_value || !child.text.empty() || known->child(name) != nullptr) continue;
      child.text = *value;
      child.remove_attribute(name);
    }
    turn_attributes_into_elements(child, *known);
  }
  const std::vector<XmlAttribute> attributes = element.attributes;
  for (const XmlAttribute& each : attributes) {
    std::string name = each.name;
    if (name == "filename" && kind.child("uri") != nullptr) name = "uri";
    if (kind.attribute(name) != nullptr || kind.child(name) == nullptr || element.child(name) != nullptr) continue;
    element.add_child(name, each.value);
    element.remove_attribute(each.name);
  }
  XmlElement* script = element.name == "material" ? element.child("script") : nullptr;
  if (script != nullptr && !script->text.empty()) {
    script->add_child("name", std::move(script->text));
    script->text.clear();
  }
  if (element.name == "heightmap") {
    if (const std::string* origin = element.attribute("origin")) element.add_child("pos", *origin);
  }
}

/// Moves the element at a path below `parent` to a child of another name, unless that exists.
void move(XmlElement& parent, const std::vector<std::string>& path, const std::string& name) {
  XmlElement* from = &parent;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    from = from->child(path[i]);
    if (from == nullptr) return;
  }
  const XmlElement* found = from->child(path.back());
  if (found == nullptr) return;
  XmlElement moved = *found;
  from->remove_children(path.back());
  moved.name = name;
  if (parent.child(name) == nullptr) parent.children.push_back(std::move(moved));
}

void move_physics_step(XmlElement& element) {
  if (element.name != "physics") return;
  move(element, {"update_rate"}, "real_time_update_rate");
  move(element, {"ode", "solver", "dt"}, "max_step_size");
  move(element, {"bullet", "dt"}, "max_step_size");
}

void express_axes_in_model(XmlElement& element) {
  if (element.name != "axis" && element.name != "axis2") return;
  if (element.child("use_parent_model_frame") == nullptr) element.add_child("use_parent_model_frame", "true");
}

/// <noise> with <rate> and <accel> becomes a noise for each axis.
void divide_imu_noise(XmlElement& imu) {
  const XmlElement* found = imu.name == "imu" ? imu.child("noise") : nullptr;
  if (found == nullptr) return;
  const XmlElement noise = *found;
  imu.remove_children("noise");
  const std::array<std::pair<const char*, const char*>, 2> halves = {
      {{"rate", "angular_velocity"}, {"accel", "linear_acceleration"}}};
  for (const auto& [old_name, new_name] : halves) {
    const XmlElement* half = noise.child(old_name);
    XmlElement& sensing = imu.add_child(new_name);
    for (const char* axis : {"x", "y", "z"}) {
      XmlElement of_axis = noise;
      of_axis.children.clear();
      if (half != nullptr) of_axis.children = half->children;
      of_axis.set_attribute("type", noise.child_text("type"));
      sensing.add_child(axis).children.push_back(std::move(of_axis));
    }
  }
}

void express_axes_by_attribute(XmlElement& element) {
  if (element.name != "axis" && element.name != "axis2") return;
  const std::string& flag = element.child_text("use_parent_model_frame");
  XmlElement* direction = element.child("xyz");
  if (direction != nullptr && (flag == "true" || flag == "True" || flag == "TRUE" || flag == "1")) {
    direction->set_attribute("expressed_in", "__model__");
  }
  element.remove_children("use_parent_model_frame");
}

/// <pose frame="..."> is of 1.5 and 1.6 only.
void forget_frame_attribute(XmlElement& element) {
  if (element.name == "pose") element.remove_attribute("frame");
}

}  // namespace

void upgrade(XmlElement& sdf, LoadContext& context) {
  const Version version = version_of(sdf);
  sdf.name = "sdf";
  if (version.major > 1 || (version.major == 1 && version.minor > kNewestMinor)) {
    context.warn(sdf.source(), "",
                 "SDFormat " + *sdf.attribute("version") + " is newer than 1." + std::to_string(kNewestMinor) +
                     ", the newest that is known: read like that");
  }
  if (older(version, 3)) turn_attributes_into_elements(sdf, sdf_kind());
  if (older(version, 4)) visit_all(sdf, move_physics_step);
  if (older(version, 5)) visit_all(sdf, express_axes_in_model);
  if (older(version, 6)) {
    for (XmlElement& world : sdf.children) {
      if (world.name != "world") continue;
      move(world, {"physics", "gravity"}, "gravity");
      move(world, {"physics", "magnetic_field"}, "magnetic_field");
    }
    visit_all(sdf, divide_imu_noise);
  }
  visit_all(sdf, older(version, 7) ? express_axes_by_attribute : forget_frame_attribute);
}

}  // namespace bubblesim
