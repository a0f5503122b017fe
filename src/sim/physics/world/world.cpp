// SPDX-License-Identifier: BSD-3-Clause
// Construction, reset, and adding and removing models; world_step.cpp advances time, world_objects.cpp and
// world_joints.cpp read and write the objects.
#include "bubblesim/world.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "bubblesim/device.hpp"
#include "bubblesim/error.hpp"
#include "check/scene_check.hpp"
#include "physics/world/state.hpp"
#include "scene/fnv1a.hpp"
#include "scene/prepared.hpp"
#include "scene/scene_hash.hpp"
#include "scene/unit_rotations.hpp"

namespace bubblesim {
namespace {

void check_not_diverged(const World::State& state) {
  if (state.diverged) throw Diverged("the physics diverged earlier; reset the world or load the scene again");
}

/// Moves the static models, whose places in the list are free, with their spaces.
void take_statics(World::State& state, World::State& from) {
  state.statics = std::move(from.statics);
  state.planes = std::move(from.planes);
  state.model_at.resize(state.tree().places());
  for (std::size_t i = 0; i < state.models.size(); ++i) {
    if (state.models[i] != nullptr) continue;
    state.models[i] = std::move(from.models[i]);
    for (Collider& collider : state.models[i]->colliders) collider.own_surface.reset();
    state.model_at[SceneTree::index_of(state.models[i]->object)] = state.models[i].get();
  }
}

}  // namespace

void World::Discard::operator()(State* state) const {
  // When ODE was left in the middle of a step, its spaces may be locked, and destroying them would fail its assertions.
  if (!state->interrupted) std::default_delete<State>()(state);
}

World::World(const Scene& scene, std::uint64_t seed) {
  build(scene, seed);
  start_ = scene.prepared().start([&] {
    std::string saved;
    StateArchive archive(saved);
    transfer_physics(archive, *state_);
    return saved;
  });
}

void World::build(const Scene& scene, std::uint64_t seed) {
  state_.reset(std::make_unique<State>(scene.description().gravity, seed).release());
  state_->shared_tree = scene.tree();
  for (std::size_t i = 0; i < scene.prepared().models.size(); ++i) {
    place_model(*state_, scene.tree()->models()[i], scene.prepared().models[i]);
  }
  gather_statics(*state_);
  list_moving(*state_);
}

void World::rebuild(const Scene& scene) {
  std::vector<DeviceSlot> devices = std::move(state_->devices);
  build(scene, state_->seed);
  state_->devices = std::move(devices);
  ++revision_;
  has_scene_models_ = true;
}

void World::set_seed(std::uint64_t seed) {
  state_->seed = seed;
  state_->random = static_cast<std::uint32_t>(seed);
}

World::World(SceneDescription scene, std::uint64_t seed) : World(Scene(std::move(scene)), seed) {}

World::~World() = default;

void World::reset() {
  if (has_scene_models_ && !state_->interrupted) {
    state_->random = static_cast<std::uint32_t>(state_->seed);
    StateArchive archive(std::string_view{*start_});
    transfer_physics(archive, *state_);
    reset_devices(*this, std::move(state_->devices), *state_);
    return;
  }
  // Moving models are rebuilt, because ODE keeps more state than poses and velocities: forces of the last step, the
  // order of its lists. Static models have no state.
  const bool keeps_statics = !state_->interrupted;
  std::unique_ptr<State, Discard> built(std::make_unique<State>(state_->first_gravity, state_->seed).release());
  built->shared_tree = state_->shared_tree;
  for (const auto& model : state_->models) {
    if (keeps_statics && model->space == nullptr) {
      built->models.push_back(nullptr);
    } else {
      place_model(*built, model->object, model->prepared);
    }
  }
  if (keeps_statics) take_statics(*built, *state_);
  if (!keeps_statics || state_->statics_stale) gather_statics(*built);
  list_moving(*built);
  std::vector<DeviceSlot> devices = std::move(state_->devices);
  state_ = std::move(built);
  reset_devices(*this, std::move(devices), *state_);
}

ObjectId World::add_model(ModelDescription model, std::vector<Problem>* warnings) {
  check_not_diverged(*state_);
  std::vector<Problem> problems = check_model(model);
  for (const ObjectId id : state_->tree().models()) {
    if (state_->tree().at(id).name != model.name) continue;
    problems.push_back({model.source.file, model.source.line, "/" + model.name,
                        "a model with this name exists already; choose another name, or remove that model first"});
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
  ode::prepare_this_thread();
  make_rotations_unit(model);
  const bool is_static = model.is_static;
  const auto prepared = prepare_model(std::make_shared<const ModelDescription>(std::move(model)), warnings);
  prepared->added_hash = hash_of(*prepared->description);
  // The scene and its other simulations keep their tree.
  auto tree = std::make_shared<SceneTree>(*state_->shared_tree);
  const ObjectId id = enter_model(*tree, *prepared->description);
  const std::shared_ptr<const SceneTree> before = std::exchange(state_->shared_tree, std::move(tree));
  try {
    place_model(*state_, id, prepared);
  } catch (...) {
    state_->shared_tree = before;
    throw;
  }
  if (is_static) gather_statics(*state_);
  list_moving(*state_);
  ++revision_;
  has_scene_models_ = false;
  return id;
}

void World::check_removable(ObjectId model) const {
  const std::vector<ObjectId>& lost = state_->lost_models;
  if (state_->interrupted || std::find(lost.begin(), lost.end(), model) == lost.end()) check_not_diverged(*state_);
  const Object& object = state_->tree().at(model);
  if (object.kind != ObjectKind::kModel || object.parent != kNoObject) {
    throw WrongObject(state_->shown(model) + " is a " + std::string(kind_name(object.kind)) +
                      ": it cannot be removed on its own; remove its model");
  }
}

void World::remove_model(ObjectId model) {
  check_removable(model);
  dJointGroupEmpty(state_->contacts.get());  // contacts of the last step may refer to the model's bodies
  forget_touches(*state_);                   // and these refer to its shapes
  forget_contacts(*state_, model);
  state_->found.clear();
  auto tree = std::make_shared<SceneTree>(*state_->shared_tree);
  tree->remove(model);
  state_->statics_stale = state_->statics_stale || description(model).is_static;
  const auto is_it = [model](const auto& placed) { return placed->object == model; };
  state_->models.erase(std::find_if(state_->models.begin(), state_->models.end(), is_it));
  state_->model_at[SceneTree::index_of(model)] = nullptr;
  state_->shared_tree = std::move(tree);
  remove_devices(*state_, model);
  forget_wrenches(*state_);
  std::vector<ObjectId>& lost = state_->lost_models;
  lost.erase(std::remove(lost.begin(), lost.end(), model), lost.end());
  if (lost.empty()) state_->diverged = state_->interrupted;
  list_moving(*state_);
  wake(*state_);
  ++revision_;
  has_scene_models_ = false;
}

const ModelDescription& World::description(ObjectId model) const { return state_->model_of(model).description; }

const SensorDescription& World::sensor_description(ObjectId sensor) const {
  const Object& object = state_->tree().at(sensor);
  if (object.kind != ObjectKind::kSensor) {
    throw WrongObject(state_->shown(sensor) + " is a " + std::string(kind_name(object.kind)) + ", not a sensor");
  }
  const Object& carrier = state_->tree().at(object.parent);
  const ModelDescription& model = state_->model_of(sensor).description;
  const std::vector<SensorDescription>& sensors =
      carrier.kind == ObjectKind::kJoint ? model.joints[carrier.index].sensors : model.links[carrier.index].sensors;
  const std::vector<ObjectId> below = state_->tree().children(carrier.id, ObjectKind::kSensor);
  return sensors[static_cast<std::size_t>(std::find(below.begin(), below.end(), sensor) - below.begin())];
}

const SceneTree& World::tree() const { return state_->tree(); }

std::vector<PlacedShape> World::shapes() const {
  std::vector<PlacedShape> shapes;
  for (const auto& model : state_->models) {
    for (const Collider& collider : model->colliders) {
      shapes.push_back({collider.link->object, model->description.is_static, collider.geometry,
                        link_pose(*collider.link) * collider.in_link});
    }
  }
  return shapes;
}

namespace {

void add_wrenches(Fnv1a& hash, const Wrenches& wrenches) {
  for (const auto& [link, wrench] : wrenches) {
    const double values[] = {wrench.force.x(),  wrench.force.y(),  wrench.force.z(),
                             wrench.torque.x(), wrench.torque.y(), wrench.torque.z()};
    hash.add(static_cast<std::uint64_t>(link));
    hash.add(values, 6);
  }
}

void add_scheduled(Fnv1a& hash, const DeviceSlot& slot) {
  const double schedule[] = {slot.period, slot.ahead};
  hash.add(schedule, 2);
  hash.add(static_cast<std::uint64_t>(slot.substeps));
  std::string saved;
  StateArchive archive(saved);
  slot.device->transfer(archive);
  hash.add(std::string_view(saved));
  add_wrenches(hash, slot.wrenches);
}

void add_planar_motor(Fnv1a& hash, const PlanarMotor& motor) {
  if (motor.linear == nullptr) return;
  const double velocity[] = {dJointGetLMotorParam(motor.linear.get(), dParamVel),
                             dJointGetLMotorParam(motor.linear.get(), dParamVel2),
                             dJointGetAMotorParam(motor.angular.get(), dParamVel)};
  hash.add(velocity, 3);
}

}  // namespace

std::uint64_t World::state_hash() const {
  Fnv1a hash;
  for (const auto& model : state_->models) {
    for (const Link& link : model->links) {
      dBodyID body = link.body.get();
      if (body == nullptr) continue;
      hash.add(dBodyGetPosition(body), 3);
      hash.add(dBodyGetQuaternion(body), 4);
      hash.add(dBodyGetLinearVel(body), 3);
      hash.add(dBodyGetAngularVel(body), 3);
      hash.add(static_cast<std::uint64_t>(dBodyIsEnabled(body)));
    }
    for (const Rotation& rotation : model->rotations) {
      const double ahead[] = {rotation.ahead().x(), rotation.ahead().y(), rotation.ahead().z()};
      hash.add(ahead, 3);
    }
    add_planar_motor(hash, model->planar_motor);
    add_rest(hash, *model);
  }
  for (const auto& model : state_->models) {
    for (const PlacedJoint& placed : model->joints) {
      for (int axis = 0; placed.joint && axis < placed.joint->axis_count(); ++axis) {
        const double targets[] = {placed.joint->target_position(axis), placed.joint->target_velocity(axis),
                                  placed.joint->target_effort(axis), placed.joint->axis(axis).max_force,
                                  placed.joint->motor_gain(axis)};
        hash.add(targets, 5);
        hash.add(static_cast<std::uint64_t>(placed.joint->axis(axis).motor));
      }
    }
  }
  state_->memory.add_to(hash);
  add_wrenches(hash, state_->wrenches);
  for (const DeviceSlot& slot : state_->devices) add_scheduled(hash, slot);
  hash.add(state_->seed);
  hash.add(static_cast<std::uint64_t>(state_->random));
  return hash.value();
}

}  // namespace bubblesim
