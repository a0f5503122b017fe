// SPDX-License-Identifier: BSD-3-Clause
// Altimeter: height above its start position, and vertical velocity.
#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

class Altimeter final : public Sensor {
 public:
  Altimeter(const AltimeterDescription& description, ObjectId id, double start)
      : Sensor(AltimeterReading{}), description_(description), id_(id), start_(start) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    AltimeterReading reading{context.world.pose(id_).position.z() - start_, context.world.velocity(id_).linear.z()};
    distort(reading.height, description_.position_noise, context, id_, 0);
    distort(reading.velocity, description_.velocity_noise, context, id_, 1);
    measurement = reading;
  }

  AltimeterDescription description_;
  ObjectId id_;
  double start_;  // m
};

}  // namespace

const MemberTable& AltimeterDescription::members() {
  static const MemberTable table = member_table<AltimeterDescription>(
      "AltimeterDescription", "Measures the height above its start position.",
      {
          member<&AltimeterDescription::position_noise>("position_noise", "m", "noise of the height"),
          member<&AltimeterDescription::velocity_noise>("velocity_noise", "m/s", "noise of the velocity"),
      });
  return table;
}

const MemberTable& AltimeterReading::members() {
  static const MemberTable table = member_table<AltimeterReading>(
      "AltimeterReading", "Reading of an altimeter.",
      {
          member<&AltimeterReading::height>("height", "m", "above the sensor's initial position")
              .with_quantity("height"),
          member<&AltimeterReading::velocity>("velocity", "m/s", "upwards"),
      });
  return table;
}

class AltimeterKind final : public SensorDefinitionOf<AltimeterDescription, AltimeterReading> {
 public:
  AltimeterKind() : SensorDefinitionOf("altimeter", {"altimeter"}) {
    elements = R"(
  altimeter none
    vertical_position none
      noise none
        &noise
    vertical_velocity none
      noise none
        &noise
)";
  }

  std::optional<AltimeterDescription> read(SensorElement& sensor) const override {
    return AltimeterDescription{sensor.noise("altimeter/vertical_position/noise"),
                                sensor.noise("altimeter/vertical_velocity/noise")};
  }

  std::unique_ptr<Sensor> make(const AltimeterDescription& description, const SensorSite& site) const override {
    return std::make_unique<Altimeter>(description, site.id, site.world.pose(site.id).position.z());
  }
};

template std::unique_ptr<SensorDefinition> define<AltimeterKind>();

}  // namespace bubblesim
