// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/scene_tree.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"

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

// Free places that are kept, so that handles come back late.
constexpr std::size_t kMostFree = 1024;
// The last generation is left to handles that the scripts' side makes itself: of dummies.
constexpr std::uint32_t kGenerations = (1U << 11U) - 1;

}  // namespace

std::string_view kind_name(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::kModel:
      return "model";
    case ObjectKind::kLink:
      return "link";
    case ObjectKind::kJoint:
      return "joint";
    case ObjectKind::kSensor:
      return "sensor";
    case ObjectKind::kFrame:
      return "frame";
  }
  return "object";
}

std::string as_path(std::string scoped_name) {
  for (std::size_t i = scoped_name.find("::"); i != std::string::npos; i = scoped_name.find("::", i)) {
    scoped_name.replace(i, 2, "/");
  }
  return scoped_name;
}

ObjectId SceneTree::add(ObjectKind kind, std::string name, ObjectId part_of, std::size_t index, std::string alias) {
  if (part_of != kNoObject) at(part_of);  // throws
  const bool is_full = places_.size() >> kIndexBits != 0;
  if (is_full && free_.empty()) throw InvalidInput("a scene has at most a million objects");
  std::size_t taken = places_.size();
  if (is_full || free_.size() > kMostFree) {
    taken = free_.front();
    free_.pop_front();
  } else {
    places_.emplace_back();
  }
  Place& place = places_[taken];
  const auto id = static_cast<ObjectId>(taken | (place.generation << kIndexBits));
  (part_of == kNoObject ? roots_ : object(part_of).children).push_back(id);
  if (alias.empty()) alias = name;
  by_alias_[alias].push_back(id);
  Object added;
  added.id = id;
  added.kind = kind;
  added.name = std::move(name);
  added.alias = std::move(alias);
  added.parent = part_of;
  added.is_model_base = kind == ObjectKind::kModel;
  if (part_of != kNoObject) {
    const Object& whole = at(part_of);
    const bool is_model = whole.kind == ObjectKind::kModel;
    added.model = is_model ? part_of : whole.model;
    if (!is_model) added.carrier = part_of;
  }
  added.index = index;
  if (added.is_outermost_model()) models_.push_back(id);
  place.object = std::move(added);
  place.first_alias.clear();
  place.added = added_++;
  ++size_;
  if (const ObjectId whole = outermost_model_of(id); whole != kNoObject) parts_[whole].push_back(id);
  return id;
}

void SceneTree::remove(ObjectId id) {
  const ObjectId whole = outermost_model_of(id);
  std::vector<ObjectId> kept;
  std::vector<std::pair<ObjectId, std::string>> gone;  // with their paths
  for (const ObjectId each : whole == kNoObject ? std::vector<ObjectId>{id} : parts_.at(whole)) {
    if (is_part_of(at(each), id)) {
      const Object& object = at(each);
      gone.emplace_back(each, (object.parent == kNoObject ? "" : path(object.parent)) + "/" + object.alias);
    } else {
      kept.push_back(each);
    }
  }
  for (const auto& each : gone) {
    for (const ObjectId child : std::vector<ObjectId>(at(each.first).children)) {
      const bool stays = std::none_of(gone.begin(), gone.end(), [child](const auto& g) { return g.first == child; });
      if (stays) set_parent(child, kNoObject);
    }
    detach(at(each.first));
  }
  if (id == whole) {
    models_.erase(std::find(models_.begin(), models_.end(), id));
    parts_.erase(whole);
  } else if (whole != kNoObject) {
    parts_[whole] = std::move(kept);
  }
  for (auto& [each, was] : gone) free(each, std::move(was));
}

/// Takes an object out of its parent's children.
void SceneTree::detach(const Object& object) {
  if (object.is_hidden) return;
  std::vector<ObjectId>& siblings = object.parent == kNoObject ? roots_ : this->object(object.parent).children;
  siblings.erase(std::find(siblings.begin(), siblings.end(), object.id));
}

void SceneTree::forget_name(const Object& object) {
  const auto named = by_alias_.find(object.alias);
  if (named == by_alias_.end()) return;
  std::vector<ObjectId>& ids = named->second;
  ids.erase(std::remove(ids.begin(), ids.end(), object.id), ids.end());
  if (ids.empty()) by_alias_.erase(named);
}

/// Whether an object is `whole` or, by the physical structure, a part of it.
bool SceneTree::is_part_of(const Object& object, ObjectId whole) const {
  const Object* level = &object;
  while (level->id != whole) {
    const ObjectId above = level->carrier != kNoObject ? level->carrier : level->model;
    if (above == kNoObject) return false;
    level = &at(above);
  }
  return true;
}

void SceneTree::free(ObjectId id, std::string path) {
  Place& place = places_[index_of(id)];
  forget_name(place.object);
  place.object = Object();
  place.object.name = std::move(path);
  place.generation = (place.generation + 1) % kGenerations;
  free_.push_back(index_of(id));
  --size_;
}

void SceneTree::set_parent(ObjectId id, ObjectId parent) {
  Object& moved = object(id);
  for (ObjectId above = parent; above != kNoObject; above = at(above).parent) {
    if (above == id) throw InvalidInput(path(id) + " cannot be attached to itself or to what is attached to it");
  }
  detach(moved);
  moved.parent = parent;
  if (std::exchange(moved.is_hidden, false)) {
    for (const ObjectId each : subtree(id)) by_alias_[at(each).alias].push_back(each);
  }
  (parent == kNoObject ? roots_ : object(parent).children).push_back(id);
}

void SceneTree::set_alias(ObjectId id, std::string alias) {
  Object& named = object(id);
  const bool is_found = [&] {
    const auto known = by_alias_.find(named.alias);
    return known != by_alias_.end() && std::find(known->second.begin(), known->second.end(), id) != known->second.end();
  }();
  forget_name(named);
  std::string& first = places_[index_of(id)].first_alias;
  if (first.empty()) first = named.alias;
  named.alias = std::move(alias);
  named.is_renamed = named.alias != first;
  if (is_found) by_alias_[named.alias].push_back(id);
}

void SceneTree::hide(ObjectId id) {
  Object& hidden = object(id);
  if (hidden.is_hidden) return;
  for (const ObjectId each : subtree(id)) forget_name(at(each));
  detach(hidden);
  hidden.parent = kNoObject;
  hidden.is_hidden = true;
}

std::vector<ObjectId> SceneTree::subtree(ObjectId id) const {
  std::vector<ObjectId> found;
  std::vector<ObjectId> open{id};
  while (!open.empty()) {
    const Object& object = at(open.back());
    open.pop_back();
    found.push_back(object.id);
    open.insert(open.end(), object.children.rbegin(), object.children.rend());
  }
  return found;
}

void SceneTree::throw_missing(ObjectId id) const {
  const std::string handle = std::to_string(id);
  const std::size_t index = index_of(id);
  if (id < 0 || index >= places_.size()) throw NoSuchObject("no object has the handle " + handle);
  const Place& place = places_[index];
  const std::uint32_t generation = static_cast<std::uint32_t>(id) >> kIndexBits;
  if (generation >= place.generation) throw NoSuchObject("no object has the handle " + handle);
  const bool is_last = place.object.id == kNoObject && generation + 1 == place.generation;
  throw NoSuchObject("the object with the handle " + handle + (is_last ? " (" + place.object.name + ")" : "") +
                     " was removed");
}

std::vector<ObjectId> SceneTree::objects() const {
  std::vector<ObjectId> ids;
  ids.reserve(size_);
  for (const Place& place : places_) {
    if (place.object.id != kNoObject) ids.push_back(place.object.id);
  }
  std::sort(ids.begin(), ids.end(),
            [this](ObjectId a, ObjectId b) { return places_[index_of(a)].added < places_[index_of(b)].added; });
  return ids;
}

const std::vector<ObjectId>& SceneTree::all_parts(ObjectId model) const {
  if (!at(model).is_outermost_model()) throw WrongObject(path(model) + " is not an outermost model");
  return parts_.at(model);
}

std::vector<ObjectId> SceneTree::parts(ObjectId model, ObjectKind kind) const {
  std::vector<ObjectId> ids;
  if (at(model).kind != ObjectKind::kModel) return ids;
  for (const ObjectId id : parts_.at(outermost_model_of(model))) {
    const Object& object = at(id);
    if (object.kind == kind && !object.is_second_axis() && is_part_of(object, model)) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end(), [this](ObjectId a, ObjectId b) { return at(a).index < at(b).index; });
  return ids;
}

ObjectId SceneTree::model_base_of(ObjectId id) const {
  const Object* object = &at(id);
  while (!object->is_model_base && object->parent != kNoObject) object = &at(object->parent);
  return object->id;
}

ObjectId SceneTree::model_of(ObjectId id) const {
  const Object& object = at(id);
  return object.kind == ObjectKind::kModel ? id : object.model;
}

ObjectId SceneTree::outermost_model_of(ObjectId id) const {
  const Object* object = &at(id);
  while (object->model != kNoObject) object = &at(object->model);
  return object->kind == ObjectKind::kModel ? object->id : kNoObject;
}

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
  for (const ObjectId id : objects()) {
    if (by_alias_.count(at(id).alias) == 0) continue;  // hidden
    known.push_back(this->path(id));
    known.push_back("/" + at(id).alias);
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  const bool is_path = !path.empty() && (path.front() == '/' || path.front() == '.' || path.front() == ':');
  throw NoSuchObject("no object matches '" + shown + "'" +
                     (is_path ? "" : " (a path starts with '/', './', '../', ':/' or '::/')") +
                     did_you_mean("/" + shown.substr(std::min(shown.find_first_not_of("./:"), shown.size())), known));
}

}  // namespace bubblesim
