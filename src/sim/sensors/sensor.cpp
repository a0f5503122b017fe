// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/sensor.hpp"

#include <utility>

namespace bubblesim {

Sensor::Sensor(Measurement empty) : empty_(std::move(empty)), reading_(std::make_shared<Reading>()) {
  reading_->measurement = empty_;
}

void Sensor::update(const Moment& moment) {
  if (reading_.use_count() > 1) {  // somebody holds the last one
    reading_ = std::make_shared<Reading>();
    reading_->measurement = empty_;
  }
  reading_->time = moment.time;
  measure(moment, reading_->measurement);
}

}  // namespace bubblesim
