// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/scripted_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bubblesim/error.hpp"

namespace bubblesim {
namespace {

using Waypoints = std::vector<Waypoint>;

/// The change of the position at a waypoint, per part of the way to the next one.
Vector3 tangent(const Waypoints& points, std::size_t at, double tension) {
  const std::size_t last = points.size() - 1;
  const bool is_closed = points.front().pose.position == points.back().pose.position;
  const bool is_end = at == 0 || at == last;
  std::size_t before = at == 0 ? 0 : at - 1;
  std::size_t after = std::min(at + 1, last);
  if (is_end && is_closed && last > 1) {
    before = last - 1;
    after = 1;
  }
  return (points[after].pose.position - points[before].pose.position) * ((1 - tension) / 2);
}

Pose pose_on(const Trajectory& trajectory, double time) {
  const Waypoints& points = trajectory.waypoints;
  const auto next = std::find_if(points.begin(), points.end(), [&](const Waypoint& each) { return each.time > time; });
  if (next == points.begin()) return points.front().pose;
  if (next == points.end()) return points.back().pose;
  const auto to = static_cast<std::size_t>(next - points.begin());
  const Waypoint& a = points[to - 1];
  const Waypoint& b = points[to];
  const double s = (time - a.time) / (b.time - a.time);
  const double s2 = s * s;
  const double s3 = s2 * s;
  const Vector3 position = a.pose.position * (2 * s3 - 3 * s2 + 1) + b.pose.position * (3 * s2 - 2 * s3) +
                           tangent(points, to - 1, trajectory.tension) * (s3 - 2 * s2 + s) +
                           tangent(points, to, trajectory.tension) * (s3 - s2);
  return {position, a.pose.orientation.slerp(s, b.pose.orientation)};
}

bool has_waypoint(const MotionScript& script) {
  return std::any_of(script.trajectories.begin(), script.trajectories.end(),
                     [](const Trajectory& each) { return !each.waypoints.empty(); });
}

}  // namespace

ScriptedMotion::ScriptedMotion(const World& world, ObjectId model) : model_(model) {
  const ModelDescription& description = world.models().description(model);
  if (description.is_static && description.script && has_waypoint(*description.script)) return;
  throw WrongObject(world.tree().short_path(model) + " is not a static model with a script");
}

Pose ScriptedMotion::pose_at(const MotionScript& script, double time) {
  double length = 0;
  for (const Trajectory& each : script.trajectories) {
    if (!each.waypoints.empty()) length += each.waypoints.back().time;
  }
  const double cycle = script.delay + length;
  const bool is_later = script.loop && cycle > 0 && time >= cycle;
  double left = (is_later ? std::fmod(time, cycle) : time) - script.delay;
  if (is_later && left < 0) left = length;  // the delay before the next cycle
  const Trajectory* last = nullptr;
  for (const Trajectory& each : script.trajectories) {
    if (each.waypoints.empty()) continue;
    last = &each;
    if (left < each.waypoints.back().time) return pose_on(each, left);
    left -= each.waypoints.back().time;
  }
  return last->waypoints.back().pose;
}

void ScriptedMotion::update(World& world, double time, double duration) {
  if (!world.tree().contains(model_)) return;
  const Pose pose = pose_at(*world.models().description(model_).script, time + duration);
  const Pose now = world.pose(model_);
  const bool stays = now.position == pose.position && now.orientation.coeffs() == pose.orientation.coeffs();
  if (!stays) world.set_pose(model_, pose);
}

}  // namespace bubblesim
