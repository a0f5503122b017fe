// SPDX-License-Identifier: BSD-3-Clause
#include "scene/model_tree.hpp"

#include <map>
#include <string>

namespace bubblesim {

ObjectId enter_model(SceneTree& tree, const ModelDescription& model) {
  const ObjectId id = tree.add(ObjectKind::kModel, model.name, kNoObject, 0, model.alias);
  std::map<std::string, ObjectId> models{{"", id}};  // the outermost model, and nested models by name
  // `a::b` becomes `b` below `a`.
  const auto add = [&](ObjectKind kind, const auto& part, std::size_t index) {
    const std::string& name = part.name;
    const std::size_t split = name.rfind("::");
    const auto outer = models.find(split == std::string::npos ? "" : name.substr(0, split));
    if (split == std::string::npos || outer == models.end()) return tree.add(kind, name, id, index, part.alias);
    return tree.add(kind, name.substr(split + 2), outer->second, index, part.alias);
  };
  for (std::size_t i = 0; i < model.nested.size(); ++i) {
    models[model.nested[i].name] = add(ObjectKind::kModel, model.nested[i], i);
  }
  std::size_t sensors = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const ObjectId link = add(ObjectKind::kLink, model.links[i], i);
    for (const SensorDescription& sensor : model.links[i].sensors) {
      tree.add(ObjectKind::kSensor, sensor.name, link, sensors++, sensor.alias);
    }
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const ObjectId joint = add(ObjectKind::kJoint, model.joints[i], i);
    for (const SensorDescription& sensor : model.joints[i].sensors) {
      tree.add(ObjectKind::kSensor, sensor.name, joint, sensors++, sensor.alias);
    }
    // The second axis of a steered wheel is a separate object, so that scripts can refer to it.
    for (std::size_t axis = 1; axis < model.joints[i].axes.size(); ++axis) {
      tree.add(ObjectKind::kJoint, "axis" + std::to_string(axis + 1), joint, i);
    }
  }
  return id;
}

}  // namespace bubblesim
