// SPDX-License-Identifier: BSD-3-Clause
// Inertial measurement unit: angular velocity and specific force.
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"

namespace bubblesim {
namespace {

class Imu final : public Sensor {
 public:
  Imu(const ImuDescription& description, ObjectId id) : Sensor(ImuReading{}), description_(description), id_(id) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    const World& world = moment.world;
    ImuReading reading;
    reading.orientation = world.pose(id_).orientation;
    const Inertial motion = world.sensor_motion(id_);
    reading.angular_velocity = motion.angular_velocity;
    reading.linear_acceleration = motion.specific_force;
    distort(reading.angular_velocity, description_.angular_velocity_noise, moment, id_, 0);
    distort(reading.linear_acceleration, description_.linear_acceleration_noise, moment, id_, 3);
    measurement = reading;
  }

  ImuDescription description_;
  ObjectId id_;
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const ImuDescription& description, const SensorSite& site) {
  return std::make_unique<Imu>(description, site.id);
}

}  // namespace bubblesim
