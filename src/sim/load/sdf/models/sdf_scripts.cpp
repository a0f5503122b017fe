// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_scripts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

double attribute_number(const SdfElement& element, const char* name, LoadContext& context) {
  std::vector<double> numbers;
  const std::string text = element.attribute(name);
  if (read_numbers(text, numbers) && numbers.size() == 1 && std::isfinite(numbers.front())) return numbers.front();
  context.report(element.source(), "",
                 std::string("the attribute ") + name + " of <trajectory> is '" + text + "', it must be a number");
  return 0;
}

/// The waypoints at ascending times. Gazebo keeps the last one of equal times.
Trajectory read_trajectory(const SdfElement& trajectory, const PlaceWaypoint& place, LoadContext& context) {
  Trajectory read;
  read.tension = attribute_number(trajectory, "tension", context);
  for (const SdfElement& waypoint : trajectory.children("waypoint")) {
    const double time = waypoint.number("time");
    const Pose here = place(waypoint.child("pose").as_pose());
    std::vector<Waypoint>& points = read.waypoints;
    const auto at = std::lower_bound(points.begin(), points.end(), time,
                                     [](const Waypoint& each, double wanted) { return each.time < wanted; });
    if (at != points.end() && at->time == time) {
      at->pose = here;
    } else {
      points.insert(at, {time, here});
    }
  }
  return read;
}

}  // namespace

MotionScript read_script(const SdfElement& script, const PlaceWaypoint& place, LoadContext& context) {
  MotionScript read;
  read.loop = script.flag("loop");
  read.delay = script.number("delay_start");
  std::vector<std::pair<double, Trajectory>> all;  // by their ids
  for (const SdfElement& trajectory : script.children("trajectory")) {
    all.emplace_back(attribute_number(trajectory, "id", context), read_trajectory(trajectory, place, context));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [id, trajectory] : all) {
    if (!trajectory.waypoints.empty()) read.trajectories.push_back(std::move(trajectory));
  }
  return read;
}

}  // namespace bubblesim
