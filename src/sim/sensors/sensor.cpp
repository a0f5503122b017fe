// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/sensor.hpp"

#include <utility>

namespace bubblesim {

Sensor::Sensor(Measurement empty) : empty_(std::move(empty)), reading_(std::make_shared<Reading>()) {
  reading_->measurement = empty_;
}

std::string_view kind_name(const Measurement& measurement) {
  struct Name {
    std::string_view operator()(const ProximityReading&) const { return "proximity sensor"; }
    std::string_view operator()(const LidarScan&) const { return "lidar"; }
    std::string_view operator()(const CameraImage&) const { return "camera"; }
    std::string_view operator()(const ImuReading&) const { return "IMU"; }
    std::string_view operator()(const NavSatReading&) const { return "GPS receiver"; }
    std::string_view operator()(const AltimeterReading&) const { return "altimeter"; }
    std::string_view operator()(const MagnetometerReading&) const { return "magnetometer"; }
    std::string_view operator()(const ContactReading&) const { return "contact sensor"; }
    std::string_view operator()(const ForceTorqueReading&) const { return "force-torque sensor"; }
  };
  return std::visit(Name{}, measurement);
}

void Sensor::update(const MeasurementContext& moment) {
  if (reading_.use_count() > 1) {  // a caller holds the last one
    reading_ = std::make_shared<Reading>();
    reading_->measurement = empty_;
  }
  reading_->time = moment.time;
  measure(moment, reading_->measurement);
}

void Sensor::replace(double time, Measurement measurement) {
  reading_ = std::make_shared<Reading>();
  reading_->time = time;
  reading_->measurement = std::move(measurement);
}

}  // namespace bubblesim
