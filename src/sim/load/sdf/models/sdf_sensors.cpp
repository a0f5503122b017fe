// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_sensors.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"
#include "load/sdf/models/sdf_plugins.hpp"
#include "load/sdf/models/sdf_tree.hpp"

namespace bubblesim {
namespace {

/// The types of all kinds, as files have them.
std::vector<std::string> simulated_types() {
  std::vector<std::string> types;
  for (const SensorDefinition* kind : sensor_definitions()) {
    types.insert(types.end(), kind->types.begin(), kind->types.end());
  }
  return types;
}

bool is_left_out(const std::string& type) {
  static const std::set<std::string> types = {"air_speed",
                                              "boundingbox_camera",
                                              "custom",
                                              "dvl",
                                              "multicamera",
                                              "rfid",
                                              "rfidtag",
                                              "thermal_camera",
                                              "wide_angle_camera",
                                              "wireless_receiver",
                                              "wireless_transmitter"};
  return types.count(type) > 0;
}

/// The type by its newest name.
std::string type_of(const SdfElement& sensor) {
  static const std::map<std::string, std::string> left_out = {
      {"boundingbox", "boundingbox_camera"},
      {"thermal", "thermal_camera"},
      {"wideanglecamera", "wide_angle_camera"},
  };
  const std::string type = sensor.attribute("type");
  for (const SensorDefinition* kind : sensor_definitions()) {
    if (const auto found = kind->renamed.find(type); found != kind->renamed.end()) return found->second;
  }
  const auto found = left_out.find(type);
  return found != left_out.end() ? found->second : type;
}

/// The kind with a type by its newest name. Null when it is unknown or not simulated; the reason is reported.
const SensorDefinition* find_kind(const SdfElement& sensor, const std::string& type, const std::string& path,
                                  LoadContext& context) {
  for (const SensorDefinition* kind : sensor_definitions()) {
    if (std::find(kind->types.begin(), kind->types.end(), type) != kind->types.end()) return kind;
  }
  if (is_left_out(type)) {
    context.warn(sensor.source(), path,
                 "sensors of type '" + type + "' are not simulated: this sensor is ignored; simulated types: " +
                     joined(simulated_types(), ", "));
  } else {
    context.report(sensor.source(), path,
                   "SDFormat has no sensor type '" + type + "'" + did_you_mean(type, simulated_types()));
  }
  return nullptr;
}

/// The text of the first of these elements that has one.
std::string first_text(const SdfElement& parent, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (parent.has(name) && !parent.text(name).empty()) return parent.text(name);
  }
  return "";
}

GzTopic read_gz_topic(const SdfElement& sensor) {
  const SdfElement camera = sensor.child("camera");
  GzTopic gz;
  for (const SdfElement& element : {sensor.child("contact"), sensor}) {
    gz.topic = first_text(element, {"topic"});
    if (gz.topic.rfind("__default", 0) == 0) gz.topic.clear();  // SDFormat's defaults
    if (!gz.topic.empty()) break;
  }
  gz.info_topic = first_text(camera, {"camera_info_topic"});
  gz.frame = first_text(camera, {"optical_frame_id"});
  if (gz.frame.empty()) gz.frame = first_text(sensor, {"gz_frame_id", "ignition_frame_id", "frame_id"});
  return gz;
}

/// All but the kind.
SensorDescription read_common(const SdfElement& sensor, const std::string& name, const std::string& path,
                              LoadContext& context) {
  SensorDescription description;
  description.name = name;
  description.alias = read_alias(sensor, path, context);
  description.place = read_place(sensor);
  description.type = type_of(sensor);
  description.gz = read_gz_topic(sensor);
  description.source = sensor.source();
  description.update_rate = sensor.number("update_rate");
  description.plugins = read_plugins(sensor);
  description.topic = own_text(sensor, "bubblesim:topic").value_or("");
  description.frame = own_text(sensor, "bubblesim:frame").value_or("");
  return description;
}

/// Reads the kind and pose of a sensor whose other values were read. Returns whether that was possible.
bool read_kind(const SensorDefinition& kind, SensorElement element, const Pose& pose, SensorDescription& description) {
  std::optional<SensorKind> found = kind.read_kind(element);
  if (!found) return false;
  description.kind = std::move(*found);
  description.pose = element.offset() ? pose * *element.offset() : pose;
  return true;
}

}  // namespace

std::optional<SensorDescription> read_sensor(const SdfElement& sensor, const std::string& name,
                                             const std::string& carrier_path, const Pose& pose, LoadContext& context) {
  const std::string path = carrier_path + "/" + name;
  SensorDescription description = read_common(sensor, name, path, context);
  const SensorDefinition* kind = find_kind(sensor, description.type, path, context);
  if (kind == nullptr) return std::nullopt;
  if (!read_kind(*kind, {sensor, description.type, path, context}, pose, description)) return std::nullopt;
  return description;
}

bool is_multicamera(const SdfElement& sensor) { return type_of(sensor) == "multicamera"; }

std::vector<SensorDescription> read_multicamera(const SdfElement& sensor, const std::string& name,
                                                const std::string& carrier_path, const Pose& pose,
                                                LoadContext& context) {
  const std::string path = carrier_path + "/" + name;
  const SensorDescription common = read_common(sensor, name, path, context);
  const SensorDefinition& kind = *find_kind(sensor, "camera", path, context);
  std::vector<SensorDescription> all;
  for (const SdfElement& camera : sensor.children("camera")) {
    SensorDescription& description = all.emplace_back(common);
    const std::string suffix = camera.name().empty() ? std::to_string(all.size()) : camera.name();
    description.name += "_" + suffix;
    for (std::string* topic : {&description.topic, &description.gz.topic}) {
      if (!topic->empty()) *topic += "/" + suffix;
    }
    read_kind(kind, {sensor, common.type, path, context, &camera}, pose, description);
  }
  if (all.empty()) {
    context.report(sensor.source(), path, "a multicamera needs a <camera> for each of its cameras");
  }
  return all;
}

}  // namespace bubblesim
