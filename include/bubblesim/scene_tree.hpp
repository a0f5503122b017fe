// SPDX-License-Identifier: BSD-3-Clause
// The objects of a scene: the tree that scripts and viewers see, with the search by name, and beside it the physical
// structure. In SDFormat they are the same: models at the top, their links, joints and nested models below, sensors
// below their link. In CoppeliaSim's scenes any object may be below any other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace bubblesim {

/// Handle of an object: the index of its place in the tree in the lower 20 bits, the generation of that place in the 11
/// bits above. The objects of a new tree have the handles 0, 1, 2 and so on. The place of a removed object is taken
/// again, with the next generation, after 1024 other objects were removed: a stale handle is detected, and a handle
/// comes back after two million removed objects at the earliest.
using ObjectId = std::int32_t;
constexpr ObjectId kNoObject = -1;

/// A frame is an object without physics, such as a dummy.
enum class ObjectKind { kModel, kLink, kJoint, kSensor, kFrame };
std::string_view kind_name(ObjectKind kind);

struct Object {
  ObjectId id = kNoObject;
  ObjectKind kind = ObjectKind::kModel;
  std::string name;
  std::string alias;        ///< the name in paths, which siblings may share; the name itself if the file has no other
  bool is_renamed = false;  ///< the alias was set since, so that the name of the file leads to it no more

  // The tree:
  ObjectId parent = kNoObject;  ///< kNoObject: top level, or hidden
  std::vector<ObjectId> children;
  bool is_model_base = false;  ///< models, and other objects that the file marks: where `:` in paths leads
  bool is_hidden = false;      ///< with what is below it, it is in no path and has no parent

  // The physical structure:
  ObjectId model = kNoObject;    ///< the innermost model of which it is a part; kNoObject: an outermost one, or none
  ObjectId carrier = kNoObject;  ///< of a sensor, its link or joint; of a joint's second axis, the joint
  std::size_t index = 0;  ///< among the objects of its kind in the outermost model, in the order of the scene file

  bool is_second_axis() const { return kind == ObjectKind::kJoint && carrier != kNoObject; }
  bool is_outermost_model() const { return kind == ObjectKind::kModel && model == kNoObject; }
};

/// Converts the SDFormat name of an object in a nested model, `inner::link`, to a relative path, `inner/link`.
std::string as_path(std::string scoped_name);

class SceneTree {
 public:
  /// Adds an object below the one that it is a part of, as SDFormat nests: a link, joint or frame below its model, a
  /// sensor below its link or joint, a second axis below its joint. Throws InvalidInput when there are a million
  /// objects. An empty alias stands for the name.
  ObjectId add(ObjectKind kind, std::string name, ObjectId part_of, std::size_t index, std::string alias = "");
  /// Removes an object and its parts. Other objects below them are at the top then. Throws NoSuchObject.
  void remove(ObjectId id);

  /// Makes an object the last child of another one, or of the scene (kNoObject). Throws InvalidInput when the parent is
  /// the object itself or below it.
  void set_parent(ObjectId id, ObjectId parent);
  /// From now on only this name leads to the object, until it is that of the file again.
  void set_alias(ObjectId id, std::string alias);
  void set_model_base(ObjectId id) { object(id).is_model_base = true; }
  /// Takes an object, with what is below it, out of the tree; the handles remain.
  void hide(ObjectId id);

  /// Throws NoSuchObject, with the path of the removed object if its place is still free.
  const Object& at(ObjectId id) const {
    if (!contains(id)) throw_missing(id);
    return places_[index_of(id)].object;
  }
  bool contains(ObjectId id) const {
    return id >= 0 && index_of(id) < places_.size() && places_[index_of(id)].object.id == id;
  }
  /// The place of an object: an index below places(), for tables by object.
  static std::size_t index_of(ObjectId id) { return static_cast<std::size_t>(id) & ((1U << kIndexBits) - 1); }
  std::size_t places() const { return places_.size(); }
  /// All objects, in the order in which they were added.
  std::vector<ObjectId> objects() const;
  std::size_t size() const { return size_; }
  /// The objects at the top of the tree.
  const std::vector<ObjectId>& roots() const { return roots_; }
  /// The children of an object; for kNoObject the roots.
  const std::vector<ObjectId>& children(ObjectId parent) const {
    return parent == kNoObject ? roots_ : at(parent).children;
  }
  /// An object and all below it, parents first.
  std::vector<ObjectId> subtree(ObjectId id) const;

  /// The outermost models, in the order in which they were added.
  const std::vector<ObjectId>& models() const { return models_; }
  /// The links, joints (without second axes), sensors or frames of a model and its nested models, in the order of
  /// Object::index.
  std::vector<ObjectId> parts(ObjectId model, ObjectKind kind) const;

  /// An outermost model with all its parts, each after what it is a part of. Throws WrongObject for other objects.
  const std::vector<ObjectId>& all_parts(ObjectId model) const;

  /// Finds an object by path. `/a/b` starts at the scene and may omit levels, so `/b` finds an object at any level;
  /// `./b`, `../b`, `:/b`, `::/b` start at `from`, its parent, its model, its model's parent; without `from`, `./b` and
  /// `:/b` start at the scene. A name is an object's alias, or its own name. `name[i]` selects the
  /// i-th of several siblings, `name{i}` the i-th in the scene, `*` matches any characters. Of several matches, the one
  /// nearest to the top is returned; `index` selects a later one. Throws NoSuchObject with similar names.
  ObjectId find(std::string_view path, ObjectId from = kNoObject, std::size_t index = 0) const;

  /// Full path with all levels, such as /Tricycle/Steering. Siblings with equal names get [i].
  std::string path(ObjectId id) const;
  /// The shortest suffix of path() that is unique in the scene, such as /Steering.
  std::string short_path(ObjectId id) const;
  /// The nearest model base above the object or itself; the object at the top of its branch if there is none.
  ObjectId model_base_of(ObjectId id) const;

  /// The innermost model of which the object is a part, or itself when it is a model; kNoObject for a frame of none.
  ObjectId model_of(ObjectId id) const;
  /// The outermost model of which the object is a part, or itself; kNoObject for a frame of none.
  ObjectId outermost_model_of(ObjectId id) const;

 private:
  static constexpr unsigned kIndexBits = 20;

  struct Place {
    Object object;  // when the place is free: without handle, with the path as its name
    std::uint32_t generation = 0;
    std::uint64_t added = 0;  // number of objects that were added before
    std::string first_alias;  // before the first set_alias()
  };

  [[noreturn]] void throw_missing(ObjectId id) const;
  Object& object(ObjectId id) {
    at(id);  // throws
    return places_[index_of(id)].object;
  }
  void detach(const Object& object);
  bool forget_name(const Object& object);
  bool is_part_of(const Object& object, ObjectId whole) const;
  void free(ObjectId id, std::string path);
  std::string indexed_name(const Object& object) const;
  /// `name`: the names that are compared.
  std::vector<ObjectId> matches(std::string_view path, ObjectId from, std::string Object::*name) const;
  /// The only match of an absolute path whose last name is unique, or kNoObject when the path must be searched.
  ObjectId unique_match(std::string_view path) const;

  std::vector<Place> places_;
  std::deque<std::size_t> free_;  // places, in the order in which they became free
  std::unordered_map<std::string, std::vector<ObjectId>> by_alias_;
  std::vector<ObjectId> roots_;
  std::vector<ObjectId> models_;
  std::unordered_map<ObjectId, std::vector<ObjectId>> parts_;  // by outermost model, with itself
  std::size_t size_ = 0;
  std::uint64_t added_ = 0;
};

}  // namespace bubblesim
