// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the sensors of links and joints can be simulated.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "scene/describe.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

void check_members(Checker& checker, const MemberTable& table, const void* record);

void check_member(Checker& checker, const Member& member, const void* value) {
  if (member.records.table != nullptr) {
    for (std::size_t i = 0; i < member.records.size(value); ++i) {
      check_members(checker, member.records.table(), member.records.at(value, i));
    }
    return;
  }
  if (member.limits.empty() || member.type != MemberType::kNumber) return;
  const double number = *static_cast<const double*>(value);
  std::string title = member.title;
  if (title.empty()) {
    title = "the " + member.name;
    std::replace(title.begin(), title.end(), '_', ' ');
  }
  checker.require(number >= member.least && number <= member.most, title,
                  text(number) + (member.unit.empty() ? "" : " " + member.unit), member.limits);
}

/// The limits of the members, and of those of structs in them.
void check_members(Checker& checker, const MemberTable& table, const void* record) {
  for (const Member& member : table.members) {
    if (member.is_stored()) check_member(checker, member, member.get(record));
  }
}

std::string types_on_joints() {
  std::vector<std::string> types;
  for (const SensorDefinition* kind : sensor_definitions()) {
    if (kind->of_joint) types.insert(types.end(), kind->types.begin(), kind->types.end());
  }
  return joined(types, " or ");
}

/// `link` is null for a sensor of a joint.
void check_sensor(Checker& checker, const SensorDescription& sensor, const LinkDescription* link,
                  const std::string& path) {
  checker.at(sensor.source, path + "/" + sensor.name);
  checker.check_pose(sensor.pose);
  checker.require(sensor.update_rate >= 0 && within(sensor.update_rate, 1e5), "the update rate",
                  text(sensor.update_rate) + " Hz", "0 (every step) to 1e5 Hz");
  if (sensor.kind.table() == nullptr) return checker.report("the sensor has no kind");
  const SensorDefinition& kind = definition_of(sensor.kind);
  SensorCheck check(checker, link);
  kind.check_kind(check, sensor.kind);
  check_members(checker, *sensor.kind.table(), sensor.kind.data());
  if (kind.of_joint == (link == nullptr)) return;
  checker.report(link != nullptr
                     ? "a " + kind.types.front() + " sensor measures the forces of a joint: put it into a <joint>"
                     : "a joint can have sensors of type " + types_on_joints() +
                           " only: put this sensor into a <link>");
}

}  // namespace

void SensorCheck::require(bool fine, const std::string& what, const std::string& found, const std::string& wanted) {
  checker_.require(fine, what, found, wanted);
}

void SensorCheck::report(std::string message) { checker_.report(std::move(message)); }

void SensorCheck::require_ranges(double min_range, double max_range) {
  require(max_range > 0 && max_range <= kMaxSize, "the maximum range", text(max_range) + " m",
          "above 0 and at most 1e5 m");
  require(min_range >= 0 && min_range < max_range, "the minimum range", text(min_range) + " m",
          "0 or more and below the maximum range");
}

void check_sensors(Checker& checker, const LinkDescription& link, const std::string& path) {
  for (const SensorDescription& sensor : link.sensors) check_sensor(checker, sensor, &link, path);
}

void check_sensors(Checker& checker, const JointDescription& joint, const std::string& path) {
  for (const SensorDescription& sensor : joint.sensors) check_sensor(checker, sensor, nullptr, path);
}

}  // namespace bubblesim
