// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/worlds/sdf_actors.hpp"

#include <string>
#include <utility>

#include "load/sdf/models/sdf_plugins.hpp"
#include "load/sdf/models/sdf_scripts.hpp"

namespace bubblesim {
namespace {

constexpr double kHeight = 1.8;      // m, of the person
constexpr double kRadius = 0.25;     // m
constexpr double kHips = 1;          // m above the feet
constexpr double kLowestHips = 0.5;  // m: an origin below this height is at the feet

/// The place of the feet of a person whose origin has a pose.
Pose standing(const Pose& origin) {
  Vector3 feet = origin.position;
  if (feet.z() >= kLowestHips) feet.z() -= kHips;
  return {feet, from_rpy(0, 0, to_rpy(origin.orientation).z())};
}

LinkDescription person(const Source& source) {
  LinkDescription link;
  link.name = "person";
  link.source = source;
  CollisionDescription body;
  body.name = "body";
  body.pose.position.z() = kHeight / 2;
  body.geometry = Capsule{kRadius, kHeight - 2 * kRadius};
  body.source = source;
  link.collisions.push_back(std::move(body));
  return link;
}

}  // namespace

ModelDescription read_actor(const SdfElement& actor, LoadContext& context) {
  ModelDescription model;
  model.name = actor.name();
  model.source = actor.source();
  model.is_static = true;
  model.plugins = read_plugins(actor);
  model.links.push_back(person(model.source));
  const Pose pose = actor.child("pose").as_pose();
  model.pose = standing(pose);
  for (const char* part : {"link", "joint"}) {
    if (actor.has(part))
      context.warn(actor.source(part), "/" + model.name, std::string("<") + part + "> of an actor is ignored");
  }
  MotionScript script = read_script(
      actor.child("script"), [&](const Pose& waypoint) { return standing(pose * waypoint); }, context);
  if (script.trajectories.empty()) return model;
  model.pose = script.trajectories.front().waypoints.front().pose;
  if (actor.child("script").flag("auto_start")) model.script = std::move(script);
  return model;
}

}  // namespace bubblesim
