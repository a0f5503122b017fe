// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "load/ttt/old_path.hpp"
#include "load/ttt/write_joints.hpp"
#include "load/ttt/write_parts.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

const char* frame_kind(const Object& object) {
  if (object.as<Shape>() != nullptr) return "shape";
  if (object.as<Lamp>() != nullptr) return "light";
  if (object.as<Joint>() != nullptr) return "joint";
  if (object.tag == "CMA") return "camera";
  if (object.tag == "GRH") return "graph";
  if (object.tag == "SCT") return "script";
  return "dummy";
}

const char* what_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::kObject:
      return "object";
    case ElementKind::kTree:
      return "tree";
    case ElementKind::kChain:
      return "chain";
    case ElementKind::kAll:
      return "all";
  }
  return nullptr;
}

/// The joint of an object that nothing simulates.
void write_kinematic(pugi::xml_node object, const Joint& described, const Conversion& conversion) {
  pugi::xml_node joint = object.append_child("joint");
  joint.append_attribute("type").set_value(type_of(described));
  if (described.type == JointType::kSpherical) return;
  put(joint, "position", described.position);
  if (!described.is_cyclic) {
    put(joint, "lower", described.lower);
    put(joint, "upper", described.upper);
  }
  if (described.lead != 0) put(joint, "screw_thread_pitch", 2 * M_PI * described.lead);
  const auto leader = conversion.joints.find(conversion.structure.place(described.leader));
  if (!described.is_dependent || leader == conversion.joints.end()) return;
  pugi::xml_node mimic = joint.append_child("mimic");
  mimic.append_attribute("joint").set_value(leader->second.c_str());
  put(mimic, "multiplier", described.factor);
  put(mimic, "offset", described.offset);
}

std::string to_base64(const std::string& bytes) {
  constexpr char kSigns[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(i + k > bytes.size() ? '=' : kSigns[bits >> (18 - 6 * k) & 0x3fU]);
    }
  }
  return text;
}

/// Text in one line, of signs that XML may have.
std::string plain_text(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char sign) { return sign < ' '; }, ' ');
  return text;
}

}  // namespace

void write_place(pugi::xml_node element, int i, Conversion& conversion) {
  if (!conversion.placed.insert(i).second) return;
  const Object& object = conversion.object(i);
  const int parent = conversion.node(i).parent;
  pugi::xml_node place = element.append_child("bubblesim:place");
  put(place, "id", object.handle);
  if (parent != kNone) put(place, "parent", conversion.object(parent).handle);
  put(place, "order", conversion.node(i).number);
  if (object.is_model) put(place, "model", "true");
  const auto script = conversion.scripts.find(i);
  if (script != conversion.scripts.end()) put(place, "script", script->second);
  if (!object.old_name.empty()) put(place, "old_name", path_name(object.old_name));
  std::vector<Parameter> parameters = object.parameters;
  if (const auto own = conversion.parameters.find(i); own != conversion.parameters.end()) {
    parameters.insert(parameters.end(), own->second.begin(), own->second.end());
  }
  for (const Parameter& parameter : parameters) {
    pugi::xml_node element = named(place, "parameter", plain_text(parameter.name));
    element.append_attribute("unit").set_value(plain_text(parameter.unit).c_str());
    element.text().set(plain_text(parameter.value).c_str());
  }
  std::map<std::string, std::string> data = object.data;
  if (const auto* path = object.as<Path>()) data.merge(data_of(*path));
  for (const auto& [name, bytes] : data) named(place, "data", plain_text(name)).text().set(to_base64(bytes).c_str());
}

void write_frame(pugi::xml_node owner, int i, const std::string& link, const Pose& link_pose, Conversion& conversion) {
  const Object& object = conversion.object(i);
  const std::string alias = path_name(object.alias);
  const auto joint = conversion.joints.find(i);
  const std::string name = joint == conversion.joints.end() ? conversion.names.take(alias) : joint->second;
  pugi::xml_node element = named(owner, "bubblesim:object", name);
  put(element, "kind", frame_kind(object));
  if (!link.empty()) put(element, "link", link);
  if (const Joint* joint_of = object.as<Joint>()) write_kinematic(element, *joint_of, conversion);
  put_pose(element, link_pose.inverse() * conversion.node(i).world);
  if (name != alias) put(element, "bubblesim:alias", alias);
  write_place(element, i, conversion);
}

void write_collections(pugi::xml_node world, const SceneFile& file) {
  for (const Collection& collection : file.collections) {
    pugi::xml_node element = named(world, "bubblesim:collection", plain_text(collection.name));
    for (const Collection::Element& each : collection.elements) {
      const char* what = what_of(each.kind);
      if (what == nullptr) continue;
      pugi::xml_node item = element.append_child("item");
      put(item, "what", what);
      if (each.kind != ElementKind::kAll) put(item, "id", each.object);
      if (!each.adds) put(item, "removes", "true");
    }
  }
}

}  // namespace bubblesim::ttt
