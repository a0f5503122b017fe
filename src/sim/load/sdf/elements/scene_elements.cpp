// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/scene_elements.hpp"

#include <set>

#include "load/sdf/elements/element_kinds.hpp"

namespace bubblesim {
namespace {

std::string effect_name(Effect effect) {
  switch (effect) {
    case Effect::kRead:
      return "read";
    case Effect::kNone:
      return "none";
    case Effect::kLeftOut:
      break;
  }
  return "left out";
}

void list_below(const ElementKind& kind, const std::string& path, std::set<const ElementKind*>& seen,
                std::vector<SceneElement>& all) {
  for (const AttributeKind& attribute : kind.attributes) {
    all.push_back({path + "@" + attribute.name, type_name(attribute.type), attribute.default_text, "read", ""});
  }
  for (const ElementKind* child : kind.children) {
    if (!seen.insert(child).second) continue;
    all.push_back(
        {path + child->name, type_name(child->type), child->default_text, effect_name(child->effect), child->reason});
    if (child->effect == Effect::kRead) list_below(*child, path + child->name + "/", seen, all);
  }
}

}  // namespace

std::vector<SceneElement> scene_elements() {
  std::vector<SceneElement> all;
  std::set<const ElementKind*> seen;
  list_below(sdf_kind(), "", seen, all);
  return all;
}

}  // namespace bubblesim
