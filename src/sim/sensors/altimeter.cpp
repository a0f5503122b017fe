// SPDX-License-Identifier: BSD-3-Clause
// Altimeter: height above its start position, and vertical velocity.
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"

namespace bubblesim {
namespace {

class Altimeter final : public Sensor {
 public:
  Altimeter(const AltimeterDescription& description, ObjectId id, double start)
      : Sensor(AltimeterReading{}), description_(description), id_(id), start_(start) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    AltimeterReading reading{moment.world.pose(id_).position.z() - start_, moment.world.velocity(id_).linear.z()};
    distort(reading.height, description_.position_noise, moment, id_, 0);
    distort(reading.velocity, description_.velocity_noise, moment, id_, 1);
    measurement = reading;
  }

  AltimeterDescription description_;
  ObjectId id_;
  double start_;  // m
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const AltimeterDescription& description, const SensorSite& site) {
  return std::make_unique<Altimeter>(description, site.id, site.world.pose(site.id).position.z());
}

}  // namespace bubblesim
