// SPDX-License-Identifier: BSD-3-Clause
// Sensors, dummies and lights.
#include <algorithm>

#include "load/ttt/read_objects.hpp"

namespace bubblesim::ttt {
namespace {

constexpr int kMostPixels = 8192;

VolumeKind volume_of_type(int type) {
  switch (type) {
    case 30:
      return VolumeKind::kPyramid;
    case 31:
      return VolumeKind::kCylinder;
    case 32:
      return VolumeKind::kDisc;
    case 33:
      return VolumeKind::kCone;
    default:
      return VolumeKind::kRay;
  }
}

/// Whether one of the filters that are enabled does more than pass the image on: from the view, to the output.
bool changes_image(const TagList& filters) {
  constexpr int kFromView = 1;
  constexpr int kToOutput = 4;
  for (const Item& item : filters.items()) {
    if (item.tag != "Sfr") continue;
    Bytes bytes = item.content;
    const TagList filter(bytes);
    const int kind = filter.integer("Sft", kFromView);
    const bool is_enabled = (filter.u8("Sfe").value_or(1) & 1U) != 0;
    if (is_enabled && kind != kFromView && kind != kToOutput) return true;
  }
  return false;
}

}  // namespace

ProximitySensor read_proximity_sensor(const TagList& list) {
  ProximitySensor sensor;
  sensor.volume = volume_of_type(list.integer("Snt", 34));
  sensor.entity = list.integer("Sox", -1);
  const TagList volume = list.list("Vod");
  const bool are_doubles = volume.has("_s3");
  if (auto bytes = volume.item(are_doubles ? "_s3" : "Ss3"); bytes && bytes->left() >= (are_doubles ? 72 : 36)) {
    const auto n = bytes->unset_numbers(9, are_doubles);  // a ray has no radius, a cone no size
    sensor.offset = n[0];
    sensor.range = n[1];
    sensor.far_size = {n[4], n[5], 0};
    sensor.near_radius = n[6];
    sensor.far_radius = n[7];
    sensor.angle = n[8];
  }
  // Old items count only if a bit is set; the new ones always do.
  const bool has_distance = (volume.u8("Par").value_or(0) & 1U) != 0;
  if (const auto distance = volume.number("", "at2")) {
    sensor.min_distance = *distance;
  } else if (has_distance) {
    sensor.min_distance = volume.number("Wtf", "_tf").value_or(0);
  }
  const bool has_angle = (list.u8("Pr4").value_or(0) & 4U) != 0;
  if (const auto angle = list.number("", "al3")) {
    sensor.max_normal_angle = *angle;
  } else if (has_angle) {
    sensor.max_normal_angle = list.number("Al2", "_l2").value_or(0);
  }
  return sensor;
}

VisionSensor read_vision_sensor(const TagList& list) {
  VisionSensor sensor;
  if (const auto n = list.numbers("Ccp", "_cp", 4); !n.empty()) {
    sensor.width = n[0];
    sensor.angle = n[1];
    sensor.near = n[2];
    sensor.far = n[3];
  }
  if (auto bytes = list.item("Res")) {
    note_damage(list.damage(), [&] {
      const std::size_t start = bytes->offset();
      const int columns = bytes->i32();
      const int rows = bytes->i32();
      if (std::min(columns, rows) < 1 || std::max(columns, rows) > kMostPixels) {
        fail_at(start, "the resolution of a vision sensor is not from 1 to 8192 pixels");
      }
      sensor.columns = columns;
      sensor.rows = rows;
    });
  }
  sensor.is_perspective = (list.u8("Va3").value_or(list.u8("Var").value_or(1)) & 1U) != 0;
  sensor.has_filters = changes_image(list.list("Cfr"));
  return sensor;
}

ForceSensor read_force_sensor(const TagList& list) { return {(list.u8("Vab").value_or(0) & 3U) != 0}; }

Dummy read_dummy(const TagList& list) { return {list.integer("Lli", -1), list.integer("Dl2", 8)}; }

Collection read_collection(const TagList& list) {
  Collection collection;
  collection.handle = list.integer("Gix", -1);
  collection.name = list.text("Grn").value_or("");
  for (const Item& item : list.items()) {
    if (item.tag != "Asg") continue;
    Bytes bytes = item.content;
    const TagList own(bytes);
    Collection::Element& element = collection.elements.emplace_back();
    element.kind = static_cast<ElementKind>(own.u8("Gty").value_or(0));
    element.object = own.integer("Obj", -1);
    element.adds = (own.u8("Var").value_or(1) & 1U) != 0;
  }
  return collection;
}

Lamp read_lamp(const TagList& list) {
  Lamp lamp;
  if (auto bytes = list.item(list.has("_p2") ? "_p2" : "Cp2")) {
    const int kind = bytes->left() >= sizeof(std::int32_t) ? bytes->i32() : 1;
    if (kind >= 1 && kind <= 3) lamp.kind = static_cast<LampKind>(kind);
  }
  lamp.cutoff = list.number("Cp3", "_p3").value_or(lamp.cutoff);
  if (const auto n = list.numbers("Caf", "_af", 3); !n.empty()) lamp.attenuation = {n[0], n[1], n[2]};
  lamp.is_on = (list.u8("Cas").value_or(1) & 1U) != 0;
  const TagList color = list.list("Cl2");
  for (const char* tag : {"Cl3", "Cl2"}) {
    if (const auto n = color.numbers(tag, "", 15); !n.empty()) {
      lamp.diffuse = {n[3], n[4], n[5]};
      break;
    }
  }
  return lamp;
}

}  // namespace bubblesim::ttt
