// SPDX-License-Identifier: BSD-3-Clause
// A kind of sensor that is not one of bubblesim's own, in one file: it measures the angular velocity about its z axis.
#include <cmath>
#include <vector>

#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

namespace bubblesim {

struct RateOfTurnDescription {
  NoiseDescription noise;
  double max_rate = 10;

  static const MemberTable& members() {
    static const MemberTable table = member_table<RateOfTurnDescription>(
        "RateOfTurnDescription", "Measures the angular velocity about its z axis.",
        {
            member<&RateOfTurnDescription::noise>("noise", "rad/s", "noise of the rate"),
            member<&RateOfTurnDescription::max_rate>("max_rate", "rad/s", "larger rates are cut off")
                .with_limits(0, 100, "0 to 100 rad/s"),
        });
    return table;
  }
};

struct RateOfTurnReading {
  double rate = 0;
  bool cut_off = false;
  Vector3 axis;
  std::vector<float> rates;

  static const MemberTable& members() {
    static const MemberTable table = member_table<RateOfTurnReading>(
        "RateOfTurnReading", "Reading of a rate-of-turn sensor.",
        {
            member<&RateOfTurnReading::rate>("rate", "rad/s", "about the sensor's z axis")
                .with_quantity("rate_of_turn"),
            member<&RateOfTurnReading::cut_off>("cut_off", "", "whether the rate was too large"),
            member<&RateOfTurnReading::axis>("axis", "", "the sensor's z axis in the world").with_quantity("turn_axis"),
            member<&RateOfTurnReading::rates>("rates", "rad/s", "about x, y and z of the sensor, without noise"),
        });
    return table;
  }
};

namespace {

class RateOfTurn final : public Sensor {
 public:
  RateOfTurn(const RateOfTurnDescription& description, ObjectId id)
      : Sensor(RateOfTurnReading{}), description_(description), id_(id) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    auto& reading = measurement.get<RateOfTurnReading>();
    const Quaternion axes = context.world.pose(id_).orientation;
    const Vector3 rates = axes.conjugate() * context.world.velocity(id_).angular;
    reading.axis = axes * Vector3::UnitZ();
    reading.rates = {static_cast<float>(rates.x()), static_cast<float>(rates.y()), static_cast<float>(rates.z())};
    reading.rate = rates.z();
    distort(reading.rate, description_.noise, context, id_, 0);
    reading.cut_off = std::abs(reading.rate) > description_.max_rate;
    if (reading.cut_off) reading.rate = std::copysign(description_.max_rate, reading.rate);
  }

  RateOfTurnDescription description_;
  ObjectId id_;
};

}  // namespace

class RateOfTurnKind final : public SensorDefinitionOf<RateOfTurnDescription, RateOfTurnReading> {
 public:
  RateOfTurnKind() : SensorDefinitionOf("rate-of-turn sensor", {"rate_of_turn"}) {
    elements = R"(
  rate_of_turn none
    max_rate number 10
    noise none
      &noise
)";
  }

  std::optional<RateOfTurnDescription> read(SensorElement& sensor) const override {
    return RateOfTurnDescription{sensor.noise("rate_of_turn/noise"), sensor.number("rate_of_turn/max_rate")};
  }

  std::unique_ptr<Sensor> make(const RateOfTurnDescription& description, const SensorSite& site) const override {
    return std::make_unique<RateOfTurn>(description, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<RateOfTurnKind>();

}  // namespace bubblesim
