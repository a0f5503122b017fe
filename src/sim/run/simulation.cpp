// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/grasp.hpp"
#include "bubblesim/randomization.hpp"
#include "bubblesim/scripted_motion.hpp"
#include "bubblesim/velocity_decay.hpp"
#include "rays/ray_scene.hpp"
#include "run/sensor_slot.hpp"
#include "scene/describe.hpp"
#include "scene/fnv1a.hpp"
#include "validation/limits.hpp"

namespace bubblesim {

void System::actuate(World&, double) {}
void System::sense(const World&, double) {}
void System::publish(const World&, double) {}
void System::model_added(World&, ObjectId) {}
void System::model_removing(World&, ObjectId) {}

Simulation::Simulation(std::shared_ptr<const Scene> scene, std::uint64_t seed)
    : scene_(std::move(scene)),
      seed_(seed),
      world_(*scene_, seed),
      wind_(std::make_shared<Wind>(scene_->description().environment.wind, seed)),
      rays_(std::make_unique<RayScene>(scene_)),
      time_step_(scene_->description().time_step) {
  world_.devices().add(wind_);
  world_.devices().add(std::make_shared<VelocityDecay>());
  for (const ObjectId model : world_.tree().models()) {
    make_sensors(model);
    make_devices(model);
  }
  index_sensors();
  const std::vector<RandomQuantity>& randomized = this->scene().randomized;
  if (!randomized.empty()) randomization_ = std::make_unique<const Randomization>(*this, randomized);
  randomize();
}

Simulation::Simulation(SceneDescription scene, std::uint64_t seed)
    : Simulation(std::make_shared<const Scene>(std::move(scene)), seed) {}

Simulation::~Simulation() = default;

void Simulation::add(System& system) { systems_.push_back(&system); }

void Simulation::stop_systems() {
  for (System* system : systems_) system->stop();
}

void Simulation::start_systems() {
  for (System* system : systems_) system->start();
}

void Simulation::process_input() {
  world_.access().check_not_claimed();
  for (System* system : systems_) system->process_input();
}

namespace {

/// Sets a flag during its lifetime.
class Noted {
 public:
  explicit Noted(bool& flag) : flag_(flag) { flag_ = true; }
  ~Noted() { flag_ = false; }
  Noted(const Noted&) = delete;
  Noted& operator=(const Noted&) = delete;

 private:
  bool& flag_;
};

/// Duration of a physics substep in s. After a change of the time step, a step consists of a whole number of substeps.
double substep(const SceneDescription& scene, double time_step) {
  if (time_step == scene.time_step) return scene.substep;
  constexpr double kRounding = 1e-6;
  return time_step / std::max(1.0, std::ceil(time_step / scene.substep - kRounding));
}

}  // namespace

void Simulation::set_time_step(double seconds) {
  if (!(seconds >= kMinTimeStep && seconds <= kMaxTimeStep)) {
    throw InvalidInput("a time step of " + text(seconds) + " s is not usable: it must be from 1e-4 to 10 s");
  }
  time_before_ = state_time();
  steps_before_ = steps_;
  time_step_ = seconds;
}

void Simulation::step() {
  if (stepping_.is_mine()) {
    throw std::logic_error("step() cannot be called during a step");
  }
  const AccessLock::Hold alone(stepping_);
  process_input();
  const AccessLock::Hold hold(world_.access());
  const Noted in_step(in_step_);
  step_start_ = state_time();  // process_input() may reset it
  {
    const Noted actuates(actuates_);
    for (System* system : systems_) system->actuate(world_, step_start_);
  }
  advance_physics(substep(scene(), time_step_));
  ++steps_;  // the world shows the end of the step from here on
  const Noted after_physics(after_physics_);
  const double end = state_time();
  update_sensors();
  for (System* system : systems_) system->sense(world_, end);
  for (System* system : systems_) system->publish(world_, end);
}

void Simulation::check_may_change() const {
  if (!in_step_) return;
  if (!stepping_.is_mine()) {
    throw std::logic_error("cannot change the simulation: another thread is running a step; change it between steps");
  }
  throw std::logic_error("cannot change the world in this phase of a step; change it between steps");
}

void Simulation::check_may_change_models() const {
  if (actuates_ && (stepping_.is_mine() || stand_in_ == std::this_thread::get_id())) return;
  check_may_change();
}

void Simulation::reset_world() {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  world_.reset();
  randomize();
  restart_sensors();
  for (System* system : systems_) system->reset();
}

void Simulation::reset() {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  world_.reset();
  steps_ = steps_before_ = 0;
  time_before_ = 0;
  time_step_ = scene().time_step;
  randomize();
  reset_sensors();
  for (System* system : systems_) system->reset();
}

void Simulation::reset_to_scene(std::uint64_t seed) {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  if (!world_.has_scene_models()) {
    const std::vector<ObjectId> before = world_.tree().models();
    world_.rebuild(*scene_);
    rays_ = std::make_unique<RayScene>(scene_);
    sensors_.clear();
    for (const ObjectId model : world_.tree().models()) {
      make_sensors(model);
      const bool is_new = std::find(before.begin(), before.end(), model) == before.end();
      if (is_new) make_devices(model);  // the devices of the others are there
    }
    index_sensors();
  }
  set_seed(seed);
  reset();
}

/// Adds those for each <gripper> of a model, and for its script.
void Simulation::make_devices(ObjectId model) {
  const ModelDescription& description = world_.models().description(model);
  if (description.script) world_.devices().add(std::make_shared<ScriptedMotion>(world_, model), model);
  if (description.grippers.empty() || description.is_static) return;
  const std::vector<ObjectId> links = world_.tree().parts(model, ObjectKind::kLink);
  const auto link_named = [&](const std::string& name) {
    return *std::find_if(links.begin(), links.end(),
                         [&](ObjectId link) { return description.links[world_.tree().at(link).index].name == name; });
  };
  for (const GripperDescription& gripper : description.grippers) {
    GraspDescription grasp;
    grasp.palm = link_named(gripper.palm);
    for (const std::string& finger : gripper.fingers) grasp.fingers.push_back(link_named(finger));
    grasp.min_contacts = gripper.min_contacts;
    grasp.attach_updates = gripper.attach_steps;
    grasp.detach_updates = gripper.detach_steps;
    world_.devices().add(std::make_shared<Grasp>(world_, std::move(grasp)), model);
  }
}

/// Puts back brightness and noise, and draws what the scene randomizes, as long as it has its own models.
void Simulation::randomize() {
  brightness_ = 1;
  for (SensorSlot& slot : sensors_) slot.noise_scale = 1;
  if (randomization_ != nullptr && has_scene_models()) randomization_->apply(*this);
}

void Simulation::set_seed(std::uint64_t seed) {
  seed_ = seed;
  world_.set_seed(seed);
  wind_->set_seed(seed);
}

ObjectId Simulation::add_model(ModelDescription model, std::vector<Problem>* warnings) {
  std::vector<ModelDescription> one;
  one.push_back(std::move(model));
  return add_models(std::move(one), warnings).front();
}

std::vector<ObjectId> Simulation::add_models(std::vector<ModelDescription> models, std::vector<Problem>* warnings) {
  const AccessLock::Hold hold(world_.access());
  check_may_change_models();
  const std::vector<ObjectId> ids = world_.models().add(std::move(models), warnings);
  for (const ObjectId id : ids) {
    rays_->add_model(world_, id, world_.models().description(id));
    make_sensors(id);
    make_devices(id);
  }
  index_sensors();
  for (const ObjectId id : ids) {
    for (System* system : systems_) system->model_added(world_, id);
  }
  return ids;
}

void Simulation::remove_model(ObjectId model) {
  const AccessLock::Hold hold(world_.access());
  check_may_change_models();
  world_.models().check_removable(model);
  remove_model_now(model);
}

void Simulation::remove_model_now(ObjectId model) {
  for (System* system : systems_) system->model_removing(world_, model);
  const auto gone = [&](const SensorSlot& slot) { return world_.tree().outermost_model_of(slot.id) == model; };
  sensors_.erase(std::remove_if(sensors_.begin(), sensors_.end(), gone), sensors_.end());
  index_sensors();
  rays_->remove_model(model);
  world_.models().remove(model);
}

std::uint64_t Simulation::state_hash() const {
  Fnv1a hash;
  hash.add(steps_);
  hash.add(seed_);
  hash.add(world_.state_hash());
  return hash.value();
}

}  // namespace bubblesim
