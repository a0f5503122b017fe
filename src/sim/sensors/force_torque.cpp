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
    for (std::size_t axis = 0; axis < 3; ++axis) {
      distort(reading.force[axis], description_.force_noise[axis], moment, id_, axis);
      distort(reading.torque[axis], description_.torque_noise[axis], moment, id_, 3 + axis);
    }
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
