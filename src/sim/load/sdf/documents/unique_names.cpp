// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/documents/unique_names.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "load/sdf/documents/documents.hpp"

namespace bubblesim {
namespace {

using Names = std::set<std::string>;

/// The kinds of objects that share their names; an <include> that is left is a robot.
bool is_model(const XmlElement& element) {
  return element.name == "model" || element.name == "include" || element.name == kForeignInclude;
}

/// Numbers the elements of a kind that have a name already taken: name_2, name_3. `place_of` gives that of the child at
/// an index.
template <class IsOfKind, class PlaceOf>
void number(std::vector<XmlElement>& children, const IsOfKind& is_of_kind, const PlaceOf& place_of,
            const std::string& kind, const std::string& path, LoadContext& context) {
  Names taken;
  for (const XmlElement& child : children) {
    if (is_of_kind(child)) taken.insert(child.given_name());
  }
  Names seen;
  std::map<std::string, int> last;
  for (std::size_t i = 0; i < children.size(); ++i) {
    if (!is_of_kind(children[i])) continue;
    const std::string name = children[i].given_name();
    if (seen.insert(name).second) continue;
    int& count = last.try_emplace(name, 1).first->second;
    std::string numbered;
    do {
      numbered = name + "_" + std::to_string(++count);
    } while (!taken.insert(numbered).second);
    children[i].set_attribute("name", numbered);
    context.warn(place_of(i), path + "/" + numbered, "renamed: another " + kind + " has the name '" + name + "'");
  }
}

void number(XmlElement& owner, const std::string& path, const std::string& kind, LoadContext& context) {
  const auto is_of_kind = [&kind](const XmlElement& child) { return child.name == kind; };
  const auto place_of = [&owner](std::size_t i) { return owner.children[i].source(); };
  number(owner.children, is_of_kind, place_of, kind, path, context);
}

/// Joints and frames share their names with links and models.
void rename_joints_and_frames(XmlElement& model, const std::string& path, LoadContext& context) {
  Names taken;
  for (const XmlElement& child : model.children) {
    if (child.name == "link" || is_model(child)) taken.insert(child.given_name());
  }
  for (const char* kind : {"joint", "frame"}) {
    for (XmlElement& child : model.children) {
      if (child.name != kind) continue;
      const std::string name = child.given_name();
      if (taken.count(name) == 0) continue;
      const std::string renamed = name + "_" + kind;
      child.set_attribute("name", renamed);
      context.warn(child.source(), path + "/" + renamed, "renamed: a link, joint or model has the name '" + name + "'");
    }
    for (const XmlElement& child : model.children) {
      if (child.name == kind) taken.insert(child.given_name());
    }
  }
}

void keep_first_lights(XmlElement& owner, const std::string& path, LoadContext& context) {
  Names seen;
  const auto is_second = [&](const XmlElement& child) {
    if (child.name != "light" || seen.insert(child.given_name()).second) return false;
    context.warn(child.source(), path + "/" + child.given_name(), "ignored: another light has this name");
    return true;
  };
  owner.children.erase(std::remove_if(owner.children.begin(), owner.children.end(), is_second), owner.children.end());
}

/// Objects without a name get that of their kind, except links, joints and models, which others refer to.
void name_nameless(XmlElement& owner, const std::string& path, LoadContext& context) {
  static const std::vector<std::string> kNamed = {"model",     "link",   "joint",  "frame",
                                                  "collision", "visual", "sensor", "light"};
  for (XmlElement& child : owner.children) {
    if (std::find(kNamed.begin(), kNamed.end(), child.name) == kNamed.end() || !child.given_name().empty()) continue;
    const std::string message = "<" + child.name + "> has no name";
    const bool is_referred_to = child.name == "model" || child.name == "link" || child.name == "joint";
    if (is_referred_to) {
      context.report(child.source(), path, message + ": add the attribute name");
    } else {
      context.warn(child.source(), path, message + ": named " + child.name);
    }
    child.set_attribute("name", child.name);
  }
}

}  // namespace

void number_models(std::vector<XmlElement>& children, const std::vector<Source>& places, const std::string& path,
                   LoadContext& context) {
  number(
      children, is_model, [&places](std::size_t i) { return places[i]; }, "model", path, context);
}

void make_names_unique(XmlElement& owner, const std::string& path, LoadContext& context) {
  name_nameless(owner, path, context);
  if (owner.name != "sdf") keep_first_lights(owner, path, context);
  if (owner.name == "model") {
    number(owner, path, "joint", context);
    rename_joints_and_frames(owner, path, context);
  }
  if (owner.name == "link" || owner.name == "joint") {
    for (const char* kind : {"collision", "visual", "sensor"}) number(owner, path, kind, context);
  }
  for (XmlElement& child : owner.children) {
    if (child.name == "world") make_names_unique(child, path, context);
    if (child.name == "model" || child.name == "link" || child.name == "joint") {
      make_names_unique(child, path + "/" + child.given_name(), context);
    }
  }
}

}  // namespace bubblesim
