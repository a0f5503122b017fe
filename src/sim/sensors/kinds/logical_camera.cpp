// SPDX-License-Identifier: BSD-3-Clause
// Logical camera: the models in its field of view, with their poses.
#include <cmath>
#include <utility>

#include "sensors/define.hpp"

namespace bubblesim {
namespace {

class LogicalCamera final : public Sensor {
 public:
  LogicalCamera(const LogicalCameraDescription& description, ObjectId id, ObjectId own_model)
      : Sensor(LogicalCameraReading{}), description_(description), id_(id), own_model_(own_model) {}

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    LogicalCameraReading reading;
    const Pose to_sensor = context.world.pose(id_).inverse();
    for (const ObjectId model : context.world.tree().models()) {
      if (model == own_model_) continue;
      const Pose pose = to_sensor * context.world.pose(model);
      if (!is_in_view(pose.position)) continue;
      reading.models.push_back({model, context.world.tree().at(model).name, pose.position, pose.orientation});
    }
    measurement = std::move(reading);
  }

  /// The field of view is a pyramid along x.
  bool is_in_view(const Vector3& place) const {
    const double width = place.x() * std::tan(description_.horizontal_fov / 2);
    return place.x() >= description_.near && place.x() <= description_.far && std::abs(place.y()) <= width &&
           std::abs(place.z()) <= width / description_.aspect_ratio;
  }

  LogicalCameraDescription description_;
  ObjectId id_;
  ObjectId own_model_;
};

}  // namespace

const MemberTable& LogicalCameraDescription::members() {
  static const MemberTable table = member_table<LogicalCameraDescription>(
      "LogicalCameraDescription", "Finds the models whose origins are in its field of view, also hidden ones.",
      {
          member<&LogicalCameraDescription::near>("near", "m", "least distance ahead"),
          member<&LogicalCameraDescription::far>("far", "m", "greatest distance ahead"),
          member<&LogicalCameraDescription::aspect_ratio>("aspect_ratio", "",
                                                          "width of the field of view by its height"),
          member<&LogicalCameraDescription::horizontal_fov>("horizontal_fov", "rad", "angle of the field of view"),
      });
  return table;
}

const MemberTable& SeenModel::members() {
  static const MemberTable table =
      member_table<SeenModel>("SeenModel", "A model in the field of view of a logical camera, in the sensor's frame.",
                              {
                                  member<&SeenModel::model>("model", "", "its handle"),
                                  member<&SeenModel::name>("name", "", "its name"),
                                  member<&SeenModel::position>("position", "m", "of its origin"),
                                  member<&SeenModel::orientation>("orientation", "", "of its axes"),
                              });
  return table;
}

const MemberTable& LogicalCameraReading::members() {
  static const MemberTable table = member_table<LogicalCameraReading>(
      "LogicalCameraReading", "Reading of a logical camera.",
      {
          member<&LogicalCameraReading::models>("models", "", "those in view but its own, in their order in the world"),
      });
  return table;
}

class LogicalCameraKind final : public SensorDefinitionOf<LogicalCameraDescription, LogicalCameraReading> {
 public:
  LogicalCameraKind() : SensorDefinitionOf("logical camera", {"logical_camera"}) {
    elements = R"(
  logical_camera none
    near number 0 required
    far number 1 required
    aspect_ratio number 1 required
    horizontal_fov number 1 required
)";
    observe("models", "", "the number of models in view", Sizes{},
            [](const LogicalCameraReading& reading, Row& row) { row.put(static_cast<double>(reading.models.size())); });
  }

  std::optional<LogicalCameraDescription> read(SensorElement& sensor) const override {
    return LogicalCameraDescription{sensor.number("logical_camera/near"), sensor.number("logical_camera/far"),
                                    sensor.number("logical_camera/aspect_ratio"),
                                    sensor.number("logical_camera/horizontal_fov")};
  }

  void check(SensorCheck& check, const LogicalCameraDescription& camera) const override {
    if (!(camera.near >= 0 && camera.far > camera.near))
      check.report("the field of view must reach from <near>, 0 or more, to a greater <far>");
    if (!(camera.aspect_ratio > 0)) check.report("the aspect ratio must be above 0");
    if (!(camera.horizontal_fov > 0 && camera.horizontal_fov < M_PI))
      check.report("the field of view must be above 0 and below pi");
  }

  std::unique_ptr<Sensor> make(const LogicalCameraDescription& description, const SensorSite& site) const override {
    return std::make_unique<LogicalCamera>(description, site.id, site.world.tree().outermost_model_of(site.id));
  }
};

template std::unique_ptr<SensorDefinition> define<LogicalCameraKind>();

}  // namespace bubblesim
