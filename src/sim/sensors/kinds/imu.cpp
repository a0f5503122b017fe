// SPDX-License-Identifier: BSD-3-Clause
// Inertial measurement unit: angular velocity and specific force.
#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

class Imu final : public Sensor {
 public:
  Imu(const ImuDescription& description, ObjectId id) : Sensor(ImuReading{}), description_(description), id_(id) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    const World& world = context.world;
    ImuReading reading;
    reading.orientation = world.pose(id_).orientation;
    const Inertial motion = world.measurements().sensor_motion(id_);
    reading.angular_velocity = motion.angular_velocity;
    reading.linear_acceleration = motion.specific_force;
    distort(reading.angular_velocity, description_.angular_velocity_noise, context, id_, 0);
    distort(reading.linear_acceleration, description_.linear_acceleration_noise, context, id_, 3);
    measurement = reading;
  }

  ImuDescription description_;
  ObjectId id_;
};

}  // namespace

const MemberTable& ImuDescription::members() {
  static const MemberTable table = member_table<ImuDescription>(
      "ImuDescription", "An inertial measurement unit.",
      {
          member<&ImuDescription::angular_velocity_noise>("angular_velocity_noise", "rad/s", "noise along x, y, z"),
          member<&ImuDescription::linear_acceleration_noise>("linear_acceleration_noise", "m/s^2",
                                                             "noise along x, y, z"),
          member<&ImuDescription::bandwidth>("bandwidth", "Hz", "of a first-order low-pass filter; 0: none")
              .with_limits(0, 1e6, "0 (no filter) to 1e6 Hz"),
      });
  return table;
}

const MemberTable& ImuReading::members() {
  static const MemberTable table = member_table<ImuReading>(
      "ImuReading", "Reading of an IMU, in its own frame (REP 145).",
      {
          member<&ImuReading::orientation>("orientation", "", "of the sensor in the world, exact"),
          member<&ImuReading::angular_velocity>("angular_velocity", "rad/s", "about the sensor's axes")
              .with_quantity("gyroscope"),
          member<&ImuReading::linear_acceleration>(
              "linear_acceleration", "m/s^2",
              "proper acceleration, the mean over the last step or filtered; at rest, gravity's magnitude upwards")
              .with_quantity("accelerometer"),
      });
  return table;
}

class ImuKind final : public SensorDefinitionOf<ImuDescription, ImuReading> {
 public:
  ImuKind() : SensorDefinitionOf("IMU", {"imu"}) {
    elements = R"(
  imu none
    angular_velocity none
      &axes_with_noise
    linear_acceleration none
      &axes_with_noise
    orientation_reference_frame any ~ the orientation is that in the world
    enable_orientation flag true ~ the orientation is measured always
    topic any ~ plugins publish
    bubblesim:bandwidth number
)";
  }

  std::optional<ImuDescription> read(SensorElement& sensor) const override {
    return ImuDescription{sensor.noise_of_axes("imu/angular_velocity"), sensor.noise_of_axes("imu/linear_acceleration"),
                          sensor.own_number("imu/bubblesim:bandwidth")};
  }

  std::unique_ptr<Sensor> make(const ImuDescription& description, const SensorSite& site) const override {
    return std::make_unique<Imu>(description, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<ImuKind>();

}  // namespace bubblesim
