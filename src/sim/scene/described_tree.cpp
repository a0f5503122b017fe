// SPDX-License-Identifier: BSD-3-Clause
#include "scene/described_tree.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace bubblesim {

std::string_view frame_kind_name(FrameKind kind) {
  switch (kind) {
    case FrameKind::kDummy:
      return "dummy";
    case FrameKind::kShape:
      return "shape";
    case FrameKind::kCamera:
      return "camera";
    case FrameKind::kLight:
      return "light";
    case FrameKind::kGraph:
      return "graph";
    case FrameKind::kScript:
      return "script";
    case FrameKind::kJoint:
      return "joint";
  }
  return "frame";
}

ObjectId DescribedTree::add(const ModelDescription& model) {
  const ObjectId id = tree_.add(ObjectKind::kModel, model.name, kNoObject, 0, model.alias);
  std::map<std::string, ObjectId> models{{"", id}};  // the outermost model, and nested models by name
  // `a::b` becomes `b` below `a`.
  const auto split = [&](const std::string& name) -> std::pair<ObjectId, std::string> {
    const std::size_t end = name.rfind("::");
    const auto outer = models.find(end == std::string::npos ? "" : name.substr(0, end));
    if (end == std::string::npos || outer == models.end()) return {id, name};
    return {outer->second, name.substr(end + 2)};
  };
  const auto add_part = [&](ObjectKind kind, const auto& part, std::size_t index) {
    auto [outer, name] = split(part.name);
    return add_placed(kind, std::move(name), outer, index, part);
  };
  for (std::size_t i = 0; i < model.nested.size(); ++i) {
    const auto [outer, name] = split(model.nested[i].name);
    models[model.nested[i].name] = tree_.add(ObjectKind::kModel, name, outer, i, model.nested[i].alias);
  }
  std::size_t sensors = 0;
  const auto add_sensors = [&](ObjectId carrier, const std::vector<SensorDescription>& described) {
    for (const SensorDescription& sensor : described) {
      add_placed(ObjectKind::kSensor, sensor.name, carrier, sensors++, sensor);
    }
  };
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    add_sensors(add_part(ObjectKind::kLink, model.links[i], i), model.links[i].sensors);
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const ObjectId joint = add_part(ObjectKind::kJoint, model.joints[i], i);
    add_sensors(joint, model.joints[i].sensors);
    // The second axis of a steered wheel is a separate object, so that scripts can refer to it.
    for (std::size_t axis = 1; axis < model.joints[i].axes.size(); ++axis) {
      tree_.add(ObjectKind::kJoint, "axis" + std::to_string(axis + 1), joint, i);
    }
  }
  for (std::size_t i = 0; i < model.frames.size(); ++i) add_part(ObjectKind::kFrame, model.frames[i], i);
  if (!model.is_object) hidden_.push_back(id);
  return id;
}

ObjectId DescribedTree::add(const FrameDescription& frame, std::size_t index) {
  return add_placed(ObjectKind::kFrame, frame.name, kNoObject, index, frame);
}

void DescribedTree::arrange() {
  std::stable_sort(placed_.begin(), placed_.end(),
                   [](const Placed& a, const Placed& b) { return a.place.order < b.place.order; });
  std::map<int, ObjectId> by_place;
  for (const Placed& placed : placed_) {
    by_place[placed.place.id] = placed.object;
    // Away from where SDFormat nests it, which may be below one of its own children.
    tree_.set_parent(placed.object, kNoObject);
    if (placed.place.is_model) tree_.set_model_base(placed.object);
  }
  for (const Placed& placed : placed_) {
    const auto parent = by_place.find(placed.place.parent);
    tree_.set_parent(placed.object, parent == by_place.end() ? kNoObject : parent->second);
  }
  for (const ObjectId model : hidden_) tree_.hide(model);
}

}  // namespace bubblesim
