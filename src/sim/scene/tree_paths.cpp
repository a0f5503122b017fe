// SPDX-License-Identifier: BSD-3-Clause
// Paths of objects, and the search by them.
#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {
namespace {

/// One level of a path: `name`, `name[2]` or `name{2}`.
struct Segment {
  std::string_view name;
  std::optional<std::size_t> among_siblings;
  std::optional<std::size_t> in_scene;
};

Segment parse_segment(std::string_view text) {
  Segment segment{text, {}, {}};
  const std::size_t open = text.find_first_of("[{");
  if (open == std::string_view::npos || text.back() != (text[open] == '[' ? ']' : '}')) return segment;
  std::size_t number = 0;
  const char* end = text.data() + text.size() - 1;
  const auto parsed = std::from_chars(text.data() + open + 1, end, number);
  if (parsed.ec != std::errc() || parsed.ptr != end) return segment;
  segment.name = text.substr(0, open);
  (text[open] == '[' ? segment.among_siblings : segment.in_scene) = number;
  return segment;
}

/// Whether `name` matches `pattern`, in which `*` stands for any characters.
bool fits(std::string_view name, std::string_view pattern) {
  std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  if (name.substr(0, star) != pattern.substr(0, star)) return false;
  name.remove_prefix(star);
  pattern.remove_prefix(star + 1);
  // Match the text between two stars at its first occurrence: that leaves the most for the rest.
  while ((star = pattern.find('*')) != std::string_view::npos) {
    const std::size_t place = name.find(pattern.substr(0, star));
    if (place == std::string_view::npos) return false;
    name.remove_prefix(place + star);
    pattern.remove_prefix(star + 1);
  }
  return name.size() >= pattern.size() && name.substr(name.size() - pattern.size()) == pattern;
}

std::vector<std::string_view> split(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    if (slash > 0) parts.push_back(path.substr(0, slash));
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return parts;
}

}  // namespace

std::string SceneTree::indexed_name(const Object& object) const {
  std::size_t same_name = 0;
  std::size_t position = 0;
  for (const ObjectId sibling : children(object.parent)) {
    if (sibling == object.id) position = same_name;
    if (at(sibling).alias == object.alias) ++same_name;
  }
  return same_name > 1 ? object.alias + "[" + std::to_string(position) + "]" : object.alias;
}

std::string SceneTree::path(ObjectId id) const {
  const Object& object = at(id);
  return (object.parent == kNoObject ? "" : path(object.parent)) + "/" + indexed_name(object);
}

std::string SceneTree::short_path(ObjectId id) const {
  std::string ending;
  for (ObjectId level = id; level != kNoObject; level = at(level).parent) {
    ending = "/" + indexed_name(at(level)) + ending;
    const std::vector<ObjectId> found = matches(ending, kNoObject, &Object::alias);
    if (found.size() == 1 && found.front() == id) return ending;
  }
  return path(id);
}

std::vector<ObjectId> SceneTree::matches(std::string_view path, ObjectId from, std::string Object::*name) const {
  std::vector<std::string_view> parts = split(path);
  ObjectId start = kNoObject;  // the scene
  if (!path.empty() && path.front() != '/' && !parts.empty()) {
    const std::string_view anchor = parts.front();
    const bool of_scene = from == kNoObject;
    if (of_scene && anchor != "." && anchor != ":") return {};
    if (of_scene || anchor == ".") {
      start = from;
    } else if (anchor == "..") {
      start = at(from).parent;
    } else if (anchor == ":") {
      start = model_base_of(from);
    } else if (anchor == "::") {
      start = at(model_base_of(from)).parent;
      if (start != kNoObject) start = model_base_of(start);
    } else {
      return {};
    }
    const bool from_parent = anchor == "..";
    parts.erase(parts.begin());
    while (from_parent && !parts.empty() && parts.front() == "..") {
      if (start == kNoObject) return {};  // the scene has no parent
      start = at(start).parent;
      parts.erase(parts.begin());
    }
    if (parts.empty()) return start == kNoObject ? std::vector<ObjectId>{} : std::vector<ObjectId>{start};
  }
  if (parts.empty()) return {};

  std::vector<ObjectId> roots{start};
  for (const std::string_view part : parts) {
    const Segment segment = parse_segment(part);
    std::vector<ObjectId> found;
    for (const ObjectId root : roots) {
      // Breadth first, so that objects nearer to the root come first.
      std::vector<ObjectId> level = children(root);
      while (!level.empty()) {
        std::vector<ObjectId> next;
        ObjectId last_parent = kNoObject;
        std::size_t sibling = 0;
        for (const ObjectId id : level) {
          const Object& object = at(id);
          if (object.parent != last_parent) sibling = 0;
          last_parent = object.parent;
          const bool has_name = name == &Object::alias || !object.is_renamed;
          if (has_name && fits(object.*name, segment.name) &&
              (!segment.among_siblings || *segment.among_siblings == sibling++)) {
            found.push_back(id);
          }
          next.insert(next.end(), object.children.begin(), object.children.end());
        }
        level = std::move(next);
      }
    }
    if (segment.in_scene) {
      found =
          *segment.in_scene < found.size() ? std::vector<ObjectId>{found[*segment.in_scene]} : std::vector<ObjectId>{};
    }
    std::vector<ObjectId> unique;
    for (const ObjectId id : found) {
      if (std::find(unique.begin(), unique.end(), id) == unique.end()) unique.push_back(id);
    }
    roots = std::move(unique);
  }
  return roots;
}

ObjectId SceneTree::unique_match(std::string_view path) const {
  if (path.empty() || path.front() != '/' || path.find_first_of("*[{") != std::string_view::npos) return kNoObject;
  const std::vector<std::string_view> parts = split(path);
  const auto named = parts.empty() ? by_alias_.end() : by_alias_.find(std::string(parts.back()));
  if (named == by_alias_.end() || named->second.size() != 1) return kNoObject;
  // Each level of the path is the next ancestor of that name.
  ObjectId above = at(named->second.front()).parent;
  for (auto part = parts.rbegin() + 1; part != parts.rend(); ++part) {
    while (above != kNoObject && at(above).alias != *part) above = at(above).parent;
    if (above == kNoObject) return kNoObject;
    above = at(above).parent;
  }
  return named->second.front();
}

ObjectId SceneTree::find(std::string_view path, ObjectId from, std::size_t index) const {
  const ObjectId only = unique_match(path);
  if (only != kNoObject && index == 0) return only;
  std::vector<ObjectId> found = matches(path, from, &Object::alias);
  if (found.empty()) found = matches(path, from, &Object::name);
  if (index < found.size()) return found[index];

  const std::string shown(path);
  if (!found.empty()) {
    throw NoSuchObject("only " + std::to_string(found.size()) + " objects match '" + shown +
                       "': there is no match with index " + std::to_string(index));
  }
  std::vector<std::string> known;
  for (const ObjectId root : roots_) {
    for (const ObjectId id : subtree(root)) {
      known.push_back(this->path(id));
      known.push_back("/" + at(id).alias);
    }
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  const bool is_path = !path.empty() && (path.front() == '/' || path.front() == '.' || path.front() == ':');
  throw NoSuchObject("no object matches '" + shown + "'" +
                     (is_path ? "" : " (a path starts with '/', './', '../', ':/' or '::/')") +
                     did_you_mean("/" + shown.substr(std::min(shown.find_first_not_of("./:"), shown.size())), known));
}

}  // namespace bubblesim
