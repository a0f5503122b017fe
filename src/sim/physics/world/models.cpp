// SPDX-License-Identifier: BSD-3-Clause
// Adds and removes models.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/world_models.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/described_tree.hpp"
#include "scene/scene_hash.hpp"
#include "scene/unit_rotations.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {

void forget_contacts(WorldState& state, ObjectId model) {
  const auto belongs = [&](const Collider& shape) {
    return state.tree().outermost_model_of(shape.link->object) == model;
  };
  for (ContactMemory* memory : {&state.contacts.memory, &state.contacts.asleep}) forget_contacts(*memory, belongs);
}

ObjectId WorldModels::add(ModelDescription model, std::vector<Problem>* warnings) {
  std::vector<ModelDescription> one;
  one.push_back(std::move(model));
  return add(std::move(one), warnings).front();
}

std::vector<ObjectId> WorldModels::add(std::vector<ModelDescription> models, std::vector<Problem>* warnings) {
  check_not_diverged(state());
  std::vector<Problem> problems;
  for (const ModelDescription& model : models) {
    for (Problem& problem : check_model(model)) problems.push_back(std::move(problem));
    for (const ObjectId id : state().tree().models()) {
      if (state().tree().at(id).name != model.name) continue;
      problems.push_back({model.source.file, model.source.line, "/" + model.name,
                          "a model with this name exists already; choose another name, or remove that model first"});
    }
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
  ode::prepare_this_thread();
  std::vector<std::shared_ptr<PreparedModel>> prepared;
  for (ModelDescription& model : models) {
    make_rotations_unit(model);
    prepared.push_back(prepare_model(std::make_shared<const ModelDescription>(std::move(model)), warnings));
    prepared.back()->added_hash = hash_of(*prepared.back()->description);
  }
  SceneTree& tree = changing_tree(state());
  DescribedTree described(tree);
  std::vector<ObjectId> ids;
  ids.reserve(prepared.size());
  for (const auto& model : prepared) ids.push_back(described.add(*model->description));
  described.arrange();
  std::size_t placed = 0;
  try {
    for (; placed < ids.size(); ++placed) place_model(state(), ids[placed], prepared[placed]);
  } catch (...) {  // all of them or none
    for (std::size_t i = 0; i < ids.size(); ++i) i < placed ? remove(ids[i]) : tree.remove(ids[i]);
    throw;
  }
  const auto is_static = [](const auto& model) { return model->description->is_static; };
  if (std::any_of(prepared.begin(), prepared.end(), is_static)) gather_statics(state());
  list_moving(state());
  for (std::size_t i = state().models.size() - ids.size(); i < state().models.size(); ++i) {
    attach_statics(state(), *state().models[i]);
  }
  find_leaders(state());
  ++state().revision;
  state().has_scene_models = false;
  return ids;
}

void WorldModels::check_removable(ObjectId model) const {
  const std::vector<ObjectId>& lost = state().lost_models;
  if (state().interrupted || std::find(lost.begin(), lost.end(), model) == lost.end()) check_not_diverged(state());
  const Object& object = state().tree().at(model);
  if (!object.is_outermost_model()) {
    throw WrongObject(state().shown(model) + " is a " + std::string(kind_name(object.kind)) +
                      ": it cannot be removed on its own; remove its model");
  }
}

void WorldModels::remove(ObjectId model) {
  check_removable(model);
  dJointGroupEmpty(state().ode.contact_joints.get());  // contacts of the last step may refer to the model's bodies
  state().touches.clear();                             // and these refer to its shapes
  forget_contacts(state(), model);
  state().contacts.found.clear();
  forget_frames(state(), model);
  forget_holds(state(), model);
  state().statics_stale = state().statics_stale || description(model).is_static;
  const auto is_it = [model](const auto& placed) { return placed->object == model; };
  state().models.erase(std::find_if(state().models.begin(), state().models.end(), is_it));
  state().model_at[SceneTree::index_of(model)] = nullptr;
  changing_tree(state()).remove(model);
  remove_devices(state(), model);
  forget_wrenches(state());
  std::vector<ObjectId>& lost = state().lost_models;
  lost.erase(std::remove(lost.begin(), lost.end(), model), lost.end());
  if (lost.empty()) state().diverged = state().interrupted;
  list_moving(state());
  wake_all(state());
  ++state().revision;
  state().has_scene_models = false;
}

const ModelDescription& WorldModels::description(ObjectId model) const { return state().model_of(model).description; }

const SensorDescription& WorldModels::sensor_description(ObjectId sensor) const {
  const Object& object = state().tree().at(sensor);
  if (object.kind != ObjectKind::kSensor) {
    throw WrongObject(state().shown(sensor) + " is a " + std::string(kind_name(object.kind)) + ", not a sensor");
  }
  return *state().model_of(sensor).described_sensors[object.index];
}

}  // namespace bubblesim
