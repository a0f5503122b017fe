// SPDX-License-Identifier: BSD-3-Clause
// Force-torque sensor: wrench of a joint's child on its parent, or of the parent on the child.
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"

namespace bubblesim {
namespace {

class ForceTorque final : public Sensor {
 public:
  ForceTorque(const ForceTorqueDescription& description, ObjectId id)
      : Sensor(ForceTorqueReading{}), description_(description), id_(id) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    const Wrench wrench = moment.world.sensor_wrench(id_);
    ForceTorqueReading reading{wrench.force, wrench.torque};
    distort(reading.force, description_.force_noise, moment, id_, 0);
    distort(reading.torque, description_.torque_noise, moment, id_, 3);
    measurement = reading;
  }

  ForceTorqueDescription description_;
  ObjectId id_;
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const ForceTorqueDescription& description, const SensorSite& site) {
  return std::make_unique<ForceTorque>(description, site.id);
}

}  // namespace bubblesim
