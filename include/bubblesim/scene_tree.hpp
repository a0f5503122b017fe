// SPDX-License-Identifier: BSD-3-Clause
// The names of a scene's objects and how to find them. The tree mirrors SDFormat's nesting: models at the top, their
// links, joints and inner models below, sensors below their link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace bubblesim {

/// Handle of an object; counts up and is never used twice, so that of a removed object is noticed.
using ObjectId = std::int32_t;
constexpr ObjectId kNoObject = -1;

enum class ObjectKind { kModel, kLink, kJoint, kSensor };
std::string_view kind_name(ObjectKind kind);

struct Object {
  ObjectId id = kNoObject;
  ObjectKind kind = ObjectKind::kModel;
  std::string name;
  ObjectId parent = kNoObject;  ///< kNoObject: at the top of the scene
  std::vector<ObjectId> children;
  std::size_t index = 0;  ///< among the objects of its kind in its outermost model, in the order of the scene file
};

/// SDFormat's name of what stands in an inner model, `inner::link`, as the ending of a path: `inner/link`.
std::string as_path(std::string scoped_name);

class SceneTree {
 public:
  ObjectId add(ObjectKind kind, std::string name, ObjectId parent, std::size_t index);
  /// Removes an object with all that lies below it. Throws NoSuchObject.
  void remove(ObjectId id);

  /// Throws NoSuchObject.
  const Object& at(ObjectId id) const;
  /// All objects that are there, in the order in which they came.
  const std::map<ObjectId, Object>& objects() const { return objects_; }
  /// The models at the top of the scene, in the order in which they came.
  const std::vector<ObjectId>& models() const { return models_; }
  /// The objects of one kind directly below another, in the order of the scene file.
  std::vector<ObjectId> children(ObjectId parent, ObjectKind kind) const;

  /// The links or joints of a model and of the models in it, in the order of Object::index.
  std::vector<ObjectId> parts(ObjectId model, ObjectKind kind) const;

  /// Finds an object by path. `/a/b` starts at the scene and may leave out levels in between, so `/b` finds an object
  /// anywhere; `./b`, `../b`, `:/b`, `::/b` start at `from`, its parent, its model, its model's parent.
  /// `name[i]` picks the i-th of several siblings, `name{i}` the i-th in the scene, `*` stands for any characters.
  /// Of several matches the one nearest to the top counts; `index` picks a later one.
  /// Throws NoSuchObject naming similar objects.
  ObjectId find(std::string_view path, ObjectId from = kNoObject, std::size_t index = 0) const;

  /// All levels: /Tricycle/Steering. Siblings of one name get [i].
  std::string path(ObjectId id) const;
  /// The shortest ending of path() that names only this object: /Steering.
  std::string short_path(ObjectId id) const;
  /// The model that the object belongs to, or the object itself when it is one.
  ObjectId model_of(ObjectId id) const;
  /// The same of the outermost model, which is at the top of the scene.
  ObjectId outermost_model_of(ObjectId id) const;

 private:
  const std::vector<ObjectId>& level_below(ObjectId parent) const;
  std::string indexed_name(const Object& object) const;
  std::vector<ObjectId> matches(std::string_view path, ObjectId from) const;

  std::map<ObjectId, Object> objects_;
  std::vector<ObjectId> models_;
  ObjectId next_ = 0;
};

}  // namespace bubblesim
