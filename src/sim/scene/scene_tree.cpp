// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/scene_tree.hpp"

#include <algorithm>
#include <utility>

#include "bubblesim/error.hpp"

namespace bubblesim {
namespace {

// Free places that are kept, so that handles come back late.
constexpr std::size_t kMostFree = 1024;
// The last generation is left to handles that scripts use for other things: collections.
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
  const std::vector<ObjectId> alone{id};
  std::vector<ObjectId> kept;
  std::vector<std::pair<ObjectId, std::string>> gone;  // with their paths
  for (const ObjectId each : whole == kNoObject ? alone : parts_.at(whole)) {
    if (is_part_of(at(each), id)) {
      const Object& object = at(each);
      gone.emplace_back(each, (object.parent == kNoObject ? "" : path(object.parent)) + "/" + object.alias);
    } else {
      kept.push_back(each);
    }
  }
  for (const auto& each : gone) {
    for (const ObjectId child : std::vector<ObjectId>(at(each.first).children)) {
      if (!is_part_of(at(child), id)) set_parent(child, kNoObject);
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

bool SceneTree::forget_name(const Object& object) {
  const auto named = by_alias_.find(object.alias);
  if (named == by_alias_.end()) return false;
  std::vector<ObjectId>& ids = named->second;
  const auto found = std::find(ids.begin(), ids.end(), object.id);
  if (found == ids.end()) return false;
  ids.erase(found);
  if (ids.empty()) by_alias_.erase(named);
  return true;
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
  const bool is_found = forget_name(named);
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

}  // namespace bubblesim
