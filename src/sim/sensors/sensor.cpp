// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/sensor.hpp"

#include <utility>

#include "bubblesim/sensor_definition.hpp"
#include "bubblesim/state_archive.hpp"
#include "scene/record_state.hpp"

namespace bubblesim {

Sensor::Sensor(Measurement empty) : empty_(std::move(empty)), reading_(std::make_shared<Reading>()) {
  reading_->measurement = empty_;
}

void Sensor::update(const MeasurementContext& context) {
  if (reading_.use_count() > 1) {  // a caller holds the last one
    reading_ = std::make_shared<Reading>();
    reading_->measurement = empty_;
  }
  reading_->time = context.time;
  measure(context, reading_->measurement);
}

void Sensor::reset() {
  if (reading_.use_count() > 1) reading_ = std::make_shared<Reading>();  // a caller holds the last one
  reading_->time = 0;
  reading_->measurement = empty_;
}

void Sensor::replace(double time, Measurement measurement) {
  reading_ = std::make_shared<Reading>();
  reading_->time = time;
  reading_->measurement = std::move(measurement);
}

void Sensor::transfer(StateArchive& archive) {
  if (archive.restores() && reading_.use_count() > 1) {  // a caller holds the last one
    reading_ = std::make_shared<Reading>();
    reading_->measurement = empty_;
  }
  archive(reading_->time);
  transfer_record(archive, reading_->measurement);
}

std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, const Environment& environment, ObjectId id,
                                    const World& world) {
  return definition_of(description.kind).make_sensor(description.kind, {id, world, environment});
}

}  // namespace bubblesim
