// SPDX-License-Identifier: BSD-3-Clause
// Air pressure sensor: the pressure of the standard atmosphere at its height.
#include <cmath>

#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

// U.S. Standard Atmosphere, 1976, up to 11 km:
constexpr double kEarthRadius = 6356766;    // m
constexpr double kSeaPressure = 101325;     // Pa
constexpr double kSeaTemperature = 288.15;  // K
constexpr double kLapse = 0.0065;           // K/m
constexpr double kExponent = 5.2558797;     // g M / (R lapse)
constexpr double kLeastTemperature = 1e-3;  // K

/// Pa, at a height above the sea in m.
double pressure_at(double altitude) {
  const double geopotential = kEarthRadius * altitude / (kEarthRadius + altitude);
  const double temperature = std::fmax(kSeaTemperature - kLapse * geopotential, kLeastTemperature);
  return kSeaPressure * std::pow(temperature / kSeaTemperature, kExponent);
}

class AirPressureSensor final : public Sensor {
 public:
  AirPressureSensor(const AirPressureDescription& description, ObjectId id)
      : Sensor(AirPressureReading{}), description_(description), id_(id) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    const double altitude = description_.reference_altitude + context.world.pose(id_).position.z();
    AirPressureReading reading{pressure_at(altitude)};
    distort(reading.pressure, description_.pressure_noise, context, id_, 0);
    measurement = reading;
  }

  AirPressureDescription description_;
  ObjectId id_;
};

}  // namespace

const MemberTable& AirPressureDescription::members() {
  static const MemberTable table = member_table<AirPressureDescription>(
      "AirPressureDescription", "Measures the pressure of the standard atmosphere at its height.",
      {
          member<&AirPressureDescription::reference_altitude>("reference_altitude", "m",
                                                              "height of the world's origin above the sea"),
          member<&AirPressureDescription::pressure_noise>("pressure_noise", "Pa", "noise of the pressure"),
      });
  return table;
}

const MemberTable& AirPressureReading::members() {
  static const MemberTable table = member_table<AirPressureReading>(
      "AirPressureReading", "Reading of an air pressure sensor.",
      {
          member<&AirPressureReading::pressure>("pressure", "Pa", "of the air").with_quantity("pressure"),
      });
  return table;
}

class AirPressureKind final : public SensorDefinitionOf<AirPressureDescription, AirPressureReading> {
 public:
  AirPressureKind() : SensorDefinitionOf("air pressure sensor", {"air_pressure"}) {
    elements = R"(
  air_pressure none
    reference_altitude number 0
    pressure none
      noise none
        &noise
)";
  }

  std::optional<AirPressureDescription> read(SensorElement& sensor) const override {
    return AirPressureDescription{sensor.number("air_pressure/reference_altitude"),
                                  sensor.noise("air_pressure/pressure/noise")};
  }

  std::unique_ptr<Sensor> make(const AirPressureDescription& description, const SensorSite& site) const override {
    return std::make_unique<AirPressureSensor>(description, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<AirPressureKind>();

}  // namespace bubblesim
