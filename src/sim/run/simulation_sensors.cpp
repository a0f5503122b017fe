// SPDX-License-Identifier: BSD-3-Clause
// The sensors of a simulation: when they measure, and their readings.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "rays/ray_scene.hpp"
#include "run/sensor_slot.hpp"
#include "scene/describe.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {

void Simulation::make_sensors(ObjectId model) {
  for (const ObjectId id : world_.tree().parts(model, ObjectKind::kSensor)) {
    const SensorDescription& sensor = world_.models().sensor_description(id);
    SensorSlot& slot = sensors_.emplace_back();
    slot.id = id;
    slot.sensor = make_sensor(sensor, scene().environment, id, world_);
    slot.period = sensor.update_rate > 0 ? 1 / sensor.update_rate : 0;
    slot.time = state_time();
    slot.due = slot.time + slot.period;
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
  WorkerPool::shared().run(with_rays.size(),
                           [&](std::size_t i) { with_rays[i]->sensor->update(context_of(*with_rays[i])); });
  measurements_ += with_rays.size();
}

MeasurementContext Simulation::context_of(const SensorSlot& slot) {
  return {world_, *rays_, state_time(), seed_, slot.noise_scale, brightness_};
}

void Simulation::update(SensorSlot& slot) {
  slot.time = state_time();
  slot.sensor->update(context_of(slot));
  ++measurements_;
}

Simulation::SensorSlot& Simulation::slot(ObjectId sensor, const char* wanted) {
  const Object& object = world_.tree().at(sensor);
  const std::size_t index = slot_at_[SceneTree::index_of(sensor)];
  if (index < sensors_.size()) return sensors_[index];
  throw WrongObject(world_.tree().short_path(sensor) + " is " + with_article(kind_name(object.kind)) + ", not " +
                    with_article(wanted));
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
  const auto* image = found.sensor->reading()->measurement.get_if<CameraImage>();
  if (image == nullptr) {
    throw WrongObject(world_.tree().short_path(camera) + " is " + with_article(sensor_kind(camera)) + ", not a camera");
  }
  const std::size_t pixels = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
  const bool has_color = world_.models().sensor_description(camera).kind.get<CameraDescription>().color;
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

void Simulation::set_noise_scale(ObjectId sensor, double scale) {
  SensorSlot& found = slot(sensor);
  if (!(scale >= 0 && std::isfinite(scale))) {
    throw InvalidInput(world_.tree().short_path(sensor) + ": the noise scale " + text(scale) +
                       " is not usable: it must be 0 or more");
  }
  found.noise_scale = scale;
}

double Simulation::noise_scale(ObjectId sensor) { return slot(sensor).noise_scale; }

double Simulation::reading_time(ObjectId sensor) { return slot(sensor).time; }

std::string_view Simulation::sensor_kind(ObjectId sensor) {
  return definition_of(slot(sensor).sensor->reading()->measurement).name;
}

void Simulation::require_proximity(ObjectId sensor) {
  if (slot(sensor, "proximity sensor").sensor->reading()->measurement.holds<ProximityReading>()) return;
  throw WrongObject(world_.tree().short_path(sensor) + " is " + with_article(sensor_kind(sensor)) +
                    ", not a proximity sensor");
}

ProximityReading Simulation::read_proximity(ObjectId sensor) {
  require_proximity(sensor);
  return read(sensor)->measurement.get<ProximityReading>();
}

ProximityReading Simulation::measure_proximity(ObjectId sensor) {
  require_proximity(sensor);
  return measure(sensor)->measurement.get<ProximityReading>();
}

}  // namespace bubblesim
