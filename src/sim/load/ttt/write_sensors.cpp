// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "load/ttt/write_parts.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

constexpr double kWidest = 1.5;  // rad, half angle of a volume or of a view

/// Sensors look along z with y up in the file, along x with z up in SDFormat.
Pose looking_along_x(const Pose& along_z) {
  return {along_z.position, along_z.orientation * Quaternion(0.5, 0.5, 0.5, 0.5).conjugate()};
}

pugi::xml_node add(pugi::xml_node link, const char* type, int sensor, const Pose& link_pose, Conversion& conversion) {
  const std::string alias = path_name(conversion.object(sensor).alias);
  const std::string name = conversion.names.take(alias);
  pugi::xml_node element = named(link, "sensor", name);
  element.append_attribute("type").set_value(type);
  put_pose(element, looking_along_x(link_pose.inverse() * conversion.node(sensor).world));
  if (alias != name) put(element, "bubblesim:alias", alias);
  write_place(element, sensor, conversion);
  return element;
}

const char* volume_name(VolumeKind volume) {
  switch (volume) {
    case VolumeKind::kPyramid:
      return "pyramid";
    case VolumeKind::kCylinder:
      return "cylinder";
    case VolumeKind::kDisc:
      return "disc";
    case VolumeKind::kCone:
      return "cone";
    default:
      return "ray";
  }
}

/// Half the opening of the volume, seen from the sensor.
double half_angle(const ProximitySensor& sensor, double range) {
  switch (sensor.volume) {
    case VolumeKind::kCone:
    case VolumeKind::kDisc:
      return sensor.angle / 2;
    case VolumeKind::kPyramid:
      return std::atan2(std::max(sensor.far_size.x(), sensor.far_size.y()) / 2, range);
    case VolumeKind::kCylinder:
      return std::atan2(sensor.far_radius, range);
    default:
      return 0;
  }
}

void write_proximity(pugi::xml_node link, int i, const ProximitySensor& sensor, const Pose& link_pose,
                     Conversion& conversion) {
  const bool has_apex = sensor.volume == VolumeKind::kCone || sensor.volume == VolumeKind::kDisc;
  const double near = has_apex ? sensor.near_radius : sensor.offset;
  const double range = near + sensor.range;
  const double least = std::max({sensor.min_distance, near, 0.0});
  if (!(sensor.range > 0) || !(least < range)) {
    conversion.left_out.add("proximity sensor without a range: left out", conversion.object(i).alias);
    return;
  }
  pugi::xml_node sonar = add(link, "sonar", i, link_pose, conversion).append_child("sonar");
  put(sonar, "min", least);
  put(sonar, "max", range);
  put(sonar, "radius", range * std::tan(std::clamp(half_angle(sensor, range), 0.0, kWidest)));
  put(sonar, "bubblesim:volume", volume_name(sensor.volume));
  if (sensor.max_normal_angle > 0) put(sonar, "bubblesim:max_normal_angle", std::min(sensor.max_normal_angle, M_PI));
  if (sensor.entity != -1) conversion.entities.emplace_back(i, sonar);
}

/// The objects that an object or collection stands for; nothing if there is none of that handle.
std::optional<std::set<int>> objects_of(int entity, const Conversion& conversion) {
  const Structure& structure = conversion.structure;
  if (const int place = structure.place(entity); place != kNone) return std::set<int>{place};
  const std::vector<Collection>& all = conversion.file.collections;
  const auto found =
      std::find_if(all.begin(), all.end(), [entity](const Collection& each) { return each.handle == entity; });
  if (found == all.end()) return std::nullopt;
  std::set<int> objects;
  for (const Collection::Element& element : found->elements) {
    std::vector<int> meant;
    if (element.kind == ElementKind::kAll) {
      for (int i = 0; i < static_cast<int>(structure.nodes.size()); ++i) meant.push_back(i);
    } else if (const int place = structure.place(element.object); place != kNone) {
      meant.push_back(place);
      for (std::size_t i = 0; i < meant.size() && element.kind == ElementKind::kTree; ++i) {
        const std::vector<int>& children = conversion.node(meant[i]).children;
        meant.insert(meant.end(), children.begin(), children.end());
      }
    }
    for (const int each : meant) {
      if (element.adds) {
        objects.insert(each);
      } else {
        objects.erase(each);
      }
    }
  }
  return objects;
}

void write_vision(pugi::xml_node link, int i, const VisionSensor& sensor, const Pose& link_pose,
                  Conversion& conversion) {
  constexpr double kLeastFar = 0.1;  // SDFormat's
  constexpr double kLeastNear = 0.001;
  constexpr double kRate = 20;  // Hz, that of CoppeliaSim's default time step
  pugi::xml_node element = add(link, "camera", i, link_pose, conversion);
  put(element, "update_rate", kRate);
  pugi::xml_node camera = element.append_child("camera");
  const double far = std::max(sensor.far, kLeastFar);
  // The angle and the width are those of the larger side.
  const double part = std::min(1.0, static_cast<double>(sensor.columns) / sensor.rows);
  const double half = std::atan(part * std::tan(std::clamp(sensor.angle / 2, 0.0, kWidest)));
  put(camera, "horizontal_fov", 2 * std::clamp(half, 0.005, kWidest));
  if (!sensor.is_perspective && sensor.width > 0) put(camera, "bubblesim:orthographic_width", part * sensor.width);
  pugi::xml_node image = camera.append_child("image");
  put(image, "width", sensor.columns);
  put(image, "height", sensor.rows);
  pugi::xml_node clip = camera.append_child("clip");
  put(clip, "near", std::clamp(sensor.near, kLeastNear, far / 2));
  put(clip, "far", far);
}

}  // namespace

void write_sensor(pugi::xml_node link, int sensor, const Pose& link_pose, Conversion& conversion) {
  const Object& object = conversion.object(sensor);
  if (const auto* proximity = object.as<ProximitySensor>()) {
    write_proximity(link, sensor, *proximity, link_pose, conversion);
  }
  if (const auto* vision = object.as<VisionSensor>()) write_vision(link, sensor, *vision, link_pose, conversion);
}

void write_entities(Conversion& conversion) {
  for (auto& [sensor, sonar] : conversion.entities) {
    const auto objects = objects_of(conversion.object(sensor).as<ProximitySensor>()->entity, conversion);
    if (!objects) continue;  // all
    // The sensor's own model is not detected anyway.
    pugi::xml_node model = sonar;
    while (std::string_view(model.name()) != "model") model = model.parent();
    std::set<std::string> own;
    for (const pugi::xml_node link : model.children("link")) own.insert(link.attribute("name").value());
    std::set<std::string> detected;
    bool is_all = true;
    for (const auto& [object, link] : conversion.links) {
      if (objects->count(object) > 0) {
        detected.insert(link);
      } else if (own.count(link) == 0) {
        is_all = false;
      }
    }
    if (is_all) continue;
    std::string names;
    for (const std::string& link : detected) names += (names.empty() ? "" : " ") + link;
    put(sonar, "bubblesim:detects", names.empty() ? "-" : names);  // no link has that name
  }
}

void write_lamp(pugi::xml_node parent, int i, const Pose& parent_pose, Conversion& conversion) {
  const Lamp& lamp = *conversion.object(i).as<Lamp>();
  if (!lamp.is_on) return;
  pugi::xml_node light = named(parent, "light", conversion.names.take(conversion.object(i).alias));
  light.append_attribute("type").set_value(lamp.kind == LampKind::kPoint  ? "point"
                                           : lamp.kind == LampKind::kSpot ? "spot"
                                                                          : "directional");
  put_pose(light, parent_pose.inverse() * conversion.node(i).world);
  put(light, "diffuse", color_text(lamp.diffuse));
  put(light, "cast_shadows", "false");
  put(light, "direction", "0 0 1");
  if (lamp.kind == LampKind::kDirectional) return;
  constexpr double kReach = 1000;  // m
  pugi::xml_node attenuation = light.append_child("attenuation");
  put(attenuation, "range", kReach);
  put(attenuation, "constant", std::clamp(lamp.attenuation[0], 0.0, 1.0));
  put(attenuation, "linear", std::clamp(lamp.attenuation[1], 0.0, 1.0));
  put(attenuation, "quadratic", std::max(lamp.attenuation[2], 0.0));
  if (lamp.kind != LampKind::kSpot) return;
  pugi::xml_node spot = light.append_child("spot");
  put(spot, "inner_angle", lamp.cutoff);
  put(spot, "outer_angle", 2 * lamp.cutoff);
  put(spot, "falloff", 1.0);
}

}  // namespace bubblesim::ttt
