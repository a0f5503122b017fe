// SPDX-License-Identifier: BSD-3-Clause
// Magnetometer: the magnetic field of the world, which is uniform.
#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

class Magnetometer final : public Sensor {
 public:
  Magnetometer(const MagnetometerDescription& description, const Vector3& field, ObjectId id)
      : Sensor(MagnetometerReading{}), description_(description), field_(field), id_(id) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    MagnetometerReading reading{context.world.pose(id_).orientation.conjugate() * field_};
    distort(reading.field, description_.field_noise, context, id_, 0);
    measurement = reading;
  }

  MagnetometerDescription description_;
  Vector3 field_;  // T, world axes
  ObjectId id_;
};

}  // namespace

const MemberTable& MagnetometerDescription::members() {
  static const MemberTable table = member_table<MagnetometerDescription>(
      "MagnetometerDescription", "Measures the magnetic field.",
      {
          member<&MagnetometerDescription::field_noise>("field_noise", "T", "noise along x, y, z"),
      });
  return table;
}

const MemberTable& MagnetometerReading::members() {
  static const MemberTable table = member_table<MagnetometerReading>(
      "MagnetometerReading", "Reading of a magnetometer, in its own frame.",
      {
          member<&MagnetometerReading::field>("field", "T", "magnetic field").with_quantity("magnetic_field"),
      });
  return table;
}

class MagnetometerKind final : public SensorDefinitionOf<MagnetometerDescription, MagnetometerReading> {
 public:
  MagnetometerKind() : SensorDefinitionOf("magnetometer", {"magnetometer"}) {
    elements = R"(
  magnetometer none
    &axes_with_noise
)";
  }

  std::optional<MagnetometerDescription> read(SensorElement& sensor) const override {
    return MagnetometerDescription{sensor.noise_of_axes("magnetometer")};
  }

  std::unique_ptr<Sensor> make(const MagnetometerDescription& description, const SensorSite& site) const override {
    return std::make_unique<Magnetometer>(description, site.environment.magnetic_field, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<MagnetometerKind>();

}  // namespace bubblesim
