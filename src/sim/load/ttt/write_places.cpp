// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "load/ttt/write_parts.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

const char* frame_kind(const Object& object) {
  if (object.as<Shape>() != nullptr) return "shape";
  if (object.as<Lamp>() != nullptr) return "light";
  if (object.tag == "CMA") return "camera";
  if (object.tag == "GRH") return "graph";
  if (object.tag == "SCT") return "script";
  return "dummy";
}

}  // namespace

void write_place(pugi::xml_node element, int i, Conversion& conversion) {
  if (!conversion.placed.insert(i).second) return;
  const Object& object = conversion.object(i);
  const int parent = conversion.node(i).parent;
  const std::vector<int>& siblings = parent == kNone ? conversion.structure.roots : conversion.node(parent).children;
  pugi::xml_node place = element.append_child("bubblesim:place");
  put(place, "id", object.handle);
  if (parent != kNone) put(place, "parent", conversion.object(parent).handle);
  put(place, "order", static_cast<double>(std::find(siblings.begin(), siblings.end(), i) - siblings.begin()));
  if (object.is_model) put(place, "model", "true");
  const auto script = conversion.scripts.find(i);
  if (script != conversion.scripts.end()) put(place, "script", script->second);
}

void write_frame(pugi::xml_node owner, int i, const std::string& link, const Pose& link_pose, Conversion& conversion) {
  const Object& object = conversion.object(i);
  const std::string alias = plain_name(object.alias);
  const std::string name = conversion.names.take(alias);
  pugi::xml_node element = named(owner, "bubblesim:object", name);
  put(element, "kind", frame_kind(object));
  if (!link.empty()) put(element, "link", link);
  put_pose(element, link_pose.inverse() * conversion.node(i).world);
  if (name != alias) put(element, "bubblesim:alias", alias);
  write_place(element, i, conversion);
}

}  // namespace bubblesim::ttt
