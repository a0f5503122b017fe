// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "check/checks.hpp"
#include "rays/ray_scene.hpp"
#include "scene/describe.hpp"
#include "scene/fnv1a.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {

void System::actuate(World&, double) {}
void System::sense(const World&, double) {}
void System::publish(const World&, double) {}
void System::model_added(World&, ObjectId) {}
void System::model_removing(World&, ObjectId) {}

struct Simulation::SensorSlot {
  ObjectId id = kNoObject;
  std::unique_ptr<Sensor> sensor;
  double period = 0;    // s
  double due = 0;       // s, state_time() of the next measurement
  double time = 0;      // s, state_time() when it was last due, or last measured on request; at first of its creation
  bool wanted = false;  // it was read since its last measurement
  bool measured = false;
  bool shows = false;  // the image was replaced by override_image()

  void reset(double now) {
    sensor->reset();
    time = now;
    due = now + period;
    wanted = measured = shows = false;
  }
};

Simulation::Simulation(std::shared_ptr<const Scene> scene, std::uint64_t seed)
    : scene_(std::move(scene)),
      seed_(seed),
      world_(*scene_, seed),
      rays_(std::make_unique<RayScene>(scene_)),
      time_step_(scene_->description().time_step) {
  for (const ObjectId model : world_.tree().models()) make_sensors(model);
  index_sensors();
}

Simulation::Simulation(SceneDescription scene, std::uint64_t seed)
    : Simulation(std::make_shared<const Scene>(std::move(scene)), seed) {}

void Simulation::make_sensors(ObjectId model) {
  const SceneTree& tree = world_.tree();
  const ModelDescription& description = world_.description(model);
  const auto make_below = [&](ObjectId carrier, const std::vector<SensorDescription>& sensors) {
    auto sensor = sensors.begin();
    for (const ObjectId id : tree.children(carrier, ObjectKind::kSensor)) {
      SensorSlot& slot = sensors_.emplace_back();
      slot.id = id;
      slot.sensor = make_sensor(*sensor, scene().environment, id, world_);
      slot.period = sensor->update_rate > 0 ? 1 / sensor->update_rate : 0;
      slot.time = state_time();
      slot.due = slot.time + slot.period;
      ++sensor;
    }
  };
  for (const ObjectId id : tree.parts(model, ObjectKind::kLink)) {
    make_below(id, description.links[tree.at(id).index].sensors);
  }
  for (const ObjectId id : tree.parts(model, ObjectKind::kJoint)) {
    make_below(id, description.joints[tree.at(id).index].sensors);
  }
}

/// Call it after sensors were added or removed.
void Simulation::index_sensors() {
  slot_at_.assign(world_.tree().places(), sensors_.size());
  for (std::size_t i = 0; i < sensors_.size(); ++i) slot_at_[SceneTree::index_of(sensors_[i].id)] = i;
}

void Simulation::reset_sensors() {
  for (SensorSlot& slot : sensors_) slot.reset(state_time());
}

/// After a world reset. The sensors keep their rates, because time goes on.
void Simulation::restart_sensors() {
  for (SensorSlot& slot : sensors_) {
    const double due = slot.due;
    const bool wanted = slot.wanted;
    slot.reset(state_time());
    slot.due = due;
    slot.wanted = wanted;
  }
}

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
  const Noted in_pass(in_step_);
  step_start_ = state_time();  // process_input() may reset it
  for (System* system : systems_) system->actuate(world_, step_start_);
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
  throw std::logic_error(
      "cannot change the world in this phase of a step; change it before the actuation or after the step");
}

void Simulation::reset_world() {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  world_.reset();
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
  reset_sensors();
  for (System* system : systems_) system->reset();
}

ObjectId Simulation::add_model(ModelDescription model, std::vector<Problem>* warnings) {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  const ObjectId id = world_.add_model(std::move(model), warnings);
  rays_->add_model(world_, id, world_.description(id));
  make_sensors(id);
  index_sensors();
  for (System* system : systems_) system->model_added(world_, id);
  return id;
}

void Simulation::remove_model(ObjectId model) {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  world_.check_removable(model);
  remove_model_now(model);
}

void Simulation::remove_model_now(ObjectId model) {
  for (System* system : systems_) system->model_removing(world_, model);
  const auto gone = [&](const SensorSlot& slot) { return world_.tree().outermost_model_of(slot.id) == model; };
  sensors_.erase(std::remove_if(sensors_.begin(), sensors_.end(), gone), sensors_.end());
  index_sensors();
  rays_->remove_model(model);
  world_.remove_model(model);
}

void Simulation::update_sensors() {
  // Half a step of tolerance: rounding must not move a due time from one step to the next.
  const double now = state_time();
  const double until = now + time_step_ / 2;
  std::vector<SensorSlot*> with_rays;
  std::size_t rays = 0;
  for (SensorSlot& slot : sensors_) {
    if (slot.due > until) continue;
    slot.due = std::max(slot.due + slot.period, now);
    slot.time = now;
    if (slot.shows) continue;
    slot.measured = slot.wanted;  // without readers, it measures on the next read
    if (!std::exchange(slot.wanted, false)) continue;
    if (slot.sensor->ray_count() == 0) {
      update(slot);
    } else {
      with_rays.push_back(&slot);
      rays += slot.sensor->ray_count();
    }
  }
  if (rays < kRaysWorthThreads) {
    for (SensorSlot* slot : with_rays) update(*slot);
    return;
  }
  rays_->refresh(world_);
  WorkerPool::shared().run(with_rays.size(), [&](std::size_t i) {
    with_rays[i]->sensor->update({world_, *rays_, state_time(), seed_});
  });
  measurements_ += with_rays.size();
}

void Simulation::update(SensorSlot& slot) {
  slot.time = state_time();
  slot.sensor->update({world_, *rays_, slot.time, seed_});
  ++measurements_;
}

Simulation::SensorSlot& Simulation::slot(ObjectId sensor, const char* wanted) {
  const Object& object = world_.tree().at(sensor);
  const std::size_t index = slot_at_[SceneTree::index_of(sensor)];
  if (index < sensors_.size()) return sensors_[index];
  throw WrongObject(world_.tree().short_path(sensor) + " is a " + std::string(kind_name(object.kind)) + ", not a " +
                    wanted);
}

std::shared_ptr<const Reading> Simulation::read(ObjectId sensor) {
  SensorSlot& found = slot(sensor);
  if (!found.measured && !found.shows) update(found);
  found.measured = true;
  found.wanted = true;
  return found.sensor->reading();
}

std::shared_ptr<const Reading> Simulation::measure(ObjectId sensor) {
  SensorSlot& found = slot(sensor);
  if (found.shows) return found.sensor->reading();
  update(found);
  return found.sensor->reading();
}

void Simulation::override_image(ObjectId camera, const std::vector<std::uint8_t>& rgb) {
  SensorSlot& found = slot(camera, "camera");
  const auto* image = std::get_if<CameraImage>(&found.sensor->reading()->measurement);
  if (image == nullptr) {
    throw WrongObject(world_.tree().short_path(camera) + " is a " + std::string(sensor_kind(camera)) +
                      ", not a camera");
  }
  const std::size_t pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
  const bool has_color = std::get<CameraDescription>(world_.sensor_description(camera).kind).color;
  const std::size_t bytes = has_color ? 3 * pixels : 0;
  if (rgb.size() != bytes) {
    throw InvalidInput(world_.tree().short_path(camera) + " needs an image of " + std::to_string(image->width) + " x " +
                       std::to_string(image->height) + " pixels (" + std::to_string(bytes) + " bytes), not one of " +
                       std::to_string(rgb.size()) + " bytes");
  }
  CameraImage picture = *image;
  picture.rgb = rgb;
  picture.depth.resize(pixels);  // the camera may not have measured yet
  picture.objects.resize(pixels);
  found.time = state_time();
  found.sensor->replace(found.time, std::move(picture));
  found.shows = true;
}

double Simulation::reading_time(ObjectId sensor) { return slot(sensor).time; }

std::string_view Simulation::sensor_kind(ObjectId sensor) {
  return kind_name(slot(sensor).sensor->reading()->measurement);
}

void Simulation::require_proximity(ObjectId sensor) {
  if (std::holds_alternative<ProximityReading>(slot(sensor, "proximity sensor").sensor->reading()->measurement)) return;
  throw WrongObject(world_.tree().short_path(sensor) + " is a " + std::string(sensor_kind(sensor)) +
                    ", not a proximity sensor");
}

ProximityReading Simulation::read_proximity(ObjectId sensor) {
  require_proximity(sensor);
  return std::get<ProximityReading>(read(sensor)->measurement);
}

ProximityReading Simulation::measure_proximity(ObjectId sensor) {
  require_proximity(sensor);
  return std::get<ProximityReading>(measure(sensor)->measurement);
}

std::uint64_t Simulation::state_hash() const {
  Fnv1a hash;
  hash.add(steps_);
  hash.add(seed_);
  hash.add(world_.state_hash());
  return hash.value();
}

}  // namespace bubblesim
