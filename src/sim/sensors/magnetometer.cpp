// SPDX-License-Identifier: BSD-3-Clause
// Magnetometer: the magnetic field of the world, which is uniform.
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"

namespace bubblesim {
namespace {

class Magnetometer final : public Sensor {
 public:
  Magnetometer(const MagnetometerDescription& description, const Vector3& field, ObjectId id)
      : Sensor(MagnetometerReading{}), description_(description), field_(field), id_(id) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    MagnetometerReading reading{moment.world.pose(id_).orientation.conjugate() * field_};
    distort(reading.field, description_.field_noise, moment, id_, 0);
    measurement = reading;
  }

  MagnetometerDescription description_;
  Vector3 field_;  // T, world axes
  ObjectId id_;
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const MagnetometerDescription& description, const SensorSite& site) {
  return std::make_unique<Magnetometer>(description, site.environment.magnetic_field, site.id);
}

}  // namespace bubblesim
