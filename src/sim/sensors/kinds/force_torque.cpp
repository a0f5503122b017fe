// SPDX-License-Identifier: BSD-3-Clause
// Force-torque sensor: wrench of a joint's child on its parent, or of the parent on the child.
#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

class ForceTorque final : public Sensor {
 public:
  ForceTorque(const ForceTorqueDescription& description, ObjectId id)
      : Sensor(ForceTorqueReading{}), description_(description), id_(id) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    const Wrench wrench = context.world.measurements().sensor_wrench(id_);
    ForceTorqueReading reading{wrench.force, wrench.torque};
    distort(reading.force, description_.force_noise, context, id_, 0);
    distort(reading.torque, description_.torque_noise, context, id_, 3);
    measurement = reading;
  }

  ForceTorqueDescription description_;
  ObjectId id_;
};

}  // namespace

const MemberTable& ForceTorqueDescription::members() {
  static const MemberTable table = member_table<ForceTorqueDescription>(
      "ForceTorqueDescription", "Measures the force and torque that a joint transmits.",
      {
          member<&ForceTorqueDescription::frame>("frame", "", "axes of the readings")
              .with_choices({"child", "parent", "sensor"}),
          member<&ForceTorqueDescription::of_child>(
              "of_child", "", "wrench of the child on the parent, otherwise of the parent on the child"),
          member<&ForceTorqueDescription::force_noise>("force_noise", "N", "noise along x, y, z"),
          member<&ForceTorqueDescription::torque_noise>("torque_noise", "N m", "noise about x, y, z"),
          member<&ForceTorqueDescription::bandwidth>("bandwidth", "Hz", "of a first-order low-pass filter; 0: none")
              .with_limits(0, 1e6, "0 (no filter) to 1e6 Hz"),
      });
  return table;
}

const MemberTable& ForceTorqueReading::members() {
  static const MemberTable table = member_table<ForceTorqueReading>(
      "ForceTorqueReading", "Force and torque that a joint transmits, the mean over the last step or filtered.",
      {
          member<&ForceTorqueReading::force>("force", "N", "along the axes of the description's frame"),
          member<&ForceTorqueReading::torque>("torque", "N m", "about the sensor's origin"),
      });
  return table;
}

class ForceTorqueKind final : public SensorDefinitionOf<ForceTorqueDescription, ForceTorqueReading> {
 public:
  ForceTorqueKind() : SensorDefinitionOf("force-torque sensor", {"force_torque"}) {
    of_joint = true;
    elements = R"(
  force_torque none
    frame text child
    measure_direction text child_to_parent
    force none
      &axes_with_noise
    torque none
      &axes_with_noise
    bubblesim:bandwidth number
)";
    observe("wrench", "N, N m", "force and torque", Sizes{6}, [](const ForceTorqueReading& reading, Row& row) {
      row.put(reading.force);
      row.put(reading.torque);
    });
  }

  std::optional<ForceTorqueDescription> read(SensorElement& sensor) const override {
    ForceTorqueDescription description;
    const std::vector<std::string>& frames = ForceTorqueDescription::members().find("frame")->choices;
    description.bandwidth = sensor.own_number("force_torque/bubblesim:bandwidth");
    description.frame =
        static_cast<ForceTorqueDescription::Frame>(sensor.choice("force_torque/frame", frames).value_or(0));
    description.of_child =
        sensor.choice("force_torque/measure_direction", {"child_to_parent", "parent_to_child"}).value_or(0) == 0;
    description.force_noise = sensor.noise_of_axes("force_torque/force");
    description.torque_noise = sensor.noise_of_axes("force_torque/torque");
    return description;
  }

  std::unique_ptr<Sensor> make(const ForceTorqueDescription& description, const SensorSite& site) const override {
    return std::make_unique<ForceTorque>(description, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<ForceTorqueKind>();

}  // namespace bubblesim
