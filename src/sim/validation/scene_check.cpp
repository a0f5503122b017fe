// SPDX-License-Identifier: BSD-3-Clause
#include "validation/scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "scene/describe.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

/// Determinant of an inertia relative to that of a ball with the same trace: a wire of 1 m and 0.1 mm has 1e-7.
constexpr double kFlat = 1e-13;

/// Paths must be unambiguous.
void check_name(Checker& checker, const std::string& name) {
  if (name.empty()) checker.report("the model has no name");
  if (name.find('/') != std::string::npos) checker.report("the name contains '/', the separator of paths");
}

void check_inertia(Checker& checker, const LinkDescription& link) {
  const Vector3& d = link.inertia_diagonal;
  const Vector3& p = link.inertia_products;  // xy, xz, yz
  checker.require(within(link.centre_of_mass, kMaxSize), "the centre of mass", text(link.centre_of_mass), "finite");
  checker.require(within(d, 1e9) && within(p, 1e9) && is_positive_definite(d, p), "the inertia",
                  "ixx iyy izz " + text(d) + ", ixy ixz iyz " + text(p), "a positive definite matrix");
}

void check_light(Checker& checker, const Light& light) {
  checker.check_color("the light's colour", light.diffuse);
  checker.require(within(light.direction, 1e6) && light.direction.norm() > 1e-9, "the light's direction",
                  text(light.direction), "a direction");
  checker.require(within(light.position, kMaxDistance), "the light's position", text(light.position),
                  "finite and within 1e6 m");
  checker.require(light.range >= 0, "the light's range", text(light.range) + " m", "0 or more");
  const double weakest = std::min({light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation});
  checker.require(weakest >= 0, "the light's attenuation", text(weakest), "0 or more");
  checker.require(light.falloff >= 0, "the light's falloff", text(light.falloff), "0 or more");
}

void check_link(Checker& checker, const ModelDescription& model, const LinkDescription& link) {
  const std::string path = "/" + model.name + "/" + link.name;
  checker.check_pose(link.pose);
  if (link.start) checker.check_pose(*link.start);
  if (const auto& velocity = link.start_velocity) {
    checker.require(velocity->linear.norm() <= kMaxSpeed && velocity->angular.norm() <= kMaxSpeed, "the velocity",
                    text(velocity->linear) + " m/s, " + text(velocity->angular) + " rad/s", "at most 1e6");
  }
  if (!model.is_static) {
    checker.require(link.mass > 0 && link.mass <= 1e6, "the mass", text(link.mass) + " kg",
                    "above 0 and at most 1e6 kg");
    check_inertia(checker, link);
  }
  for (const double decay : {link.linear_decay, link.angular_decay}) {
    checker.require(decay >= 0, "the velocity decay", text(decay) + " 1/s", "0 or more");
  }
  check_shapes(checker, model, link, path);
  for (const Light& light : link.lights) check_light(checker, light);
  check_sensors(checker, link, path);
}

void check_environment(Checker& checker, const Environment& environment) {
  checker.check_color("the ambient light", environment.ambient);
  checker.check_color("the background", environment.background);
  for (const Light& light : environment.lights) check_light(checker, light);
  checker.require(within(environment.magnetic_field, 1e3), "the magnetic field", text(environment.magnetic_field),
                  "finite and at most 1e3 T");
  checker.require(within(environment.wind, kMaxSpeed), "the wind", text(environment.wind) + " m/s",
                  "finite and at most 1e6 m/s");
  const GeographicOrigin& origin = environment.origin;
  checker.require(within(origin.latitude, 90), "the latitude", text(origin.latitude), "-90 to 90 degrees");
  checker.require(within(origin.longitude, 180), "the longitude", text(origin.longitude), "-180 to 180 degrees");
  checker.require(within(origin.elevation, kMaxSize), "the elevation", text(origin.elevation) + " m", "at most 1e5 m");
  checker.require(within(origin.heading, 2 * M_PI), "the heading", text(origin.heading) + " rad", "-2 pi to 2 pi");
}

void check_script(Checker& checker, const ModelDescription& model) {
  const MotionScript& script = *model.script;
  if (!model.is_static) checker.report("a model with a script must be static: add <static>true</static>");
  checker.require(script.delay >= 0 && script.delay <= 1e9, "the delay", text(script.delay) + " s", "from 0 to 1e9 s");
  bool any = false;
  for (const Trajectory& trajectory : script.trajectories) {
    checker.require(trajectory.tension >= 0 && trajectory.tension <= 1, "the tension", text(trajectory.tension),
                    "from 0 to 1");
    double before = -1;
    for (const Waypoint& waypoint : trajectory.waypoints) {
      any = true;
      checker.require(waypoint.time >= 0 && waypoint.time > before && waypoint.time <= 1e9, "the time of a waypoint",
                      text(waypoint.time) + " s", "later than that of the one before, from 0 to 1e9 s");
      before = waypoint.time;
      checker.check_pose(waypoint.pose);
    }
  }
  checker.require(any, "the number of waypoints", "0", "1 or more");
}

void check_model(Checker& checker, const ModelDescription& model) {
  checker.enter(model);
  checker.at(model.source, "/" + model.name);
  check_name(checker, model.name);
  checker.check_pose(model.pose);
  if (model.links.empty()) checker.report("has no link; add a <link>");
  std::set<std::string> names;
  const auto once = [&](const Source& source, const std::string& name) {
    checker.at(source, "/" + model.name + "/" + name);
    if (!names.insert(name).second) checker.report("the name '" + name + "' is used twice in this model");
  };
  for (const LinkDescription& link : model.links) {
    once(link.source, link.name);
    check_link(checker, model, link);
  }
  for (const JointDescription& joint : model.joints) {
    once(joint.source, joint.name);
    check_joint(checker, model, joint);
    check_sensors(checker, joint, "/" + model.name + "/" + joint.name);
  }
  for (const GripperDescription& gripper : model.grippers) {
    checker.at(gripper.source, "/" + model.name + "/" + gripper.name);
    checker.require(!gripper.fingers.empty(), "the number of gripper links", "0", "1 or more");
    checker.require(gripper.min_contacts >= 1, "the number of contacts", std::to_string(gripper.min_contacts),
                    "1 or more");
    checker.require(gripper.attach_steps >= 0 && gripper.detach_steps >= 0, "the number of steps",
                    std::to_string(std::min(gripper.attach_steps, gripper.detach_steps)), "0 or more");
    checker.check_link_name(gripper.palm, "palm link");
    for (const std::string& finger : gripper.fingers) checker.check_link_name(finger, "gripper link");
  }
  if (model.script) check_script(checker, model);
  for (const NestedModelDescription& nested : model.nested) {
    once(nested.source, nested.name);
    checker.check_pose(nested.pose);
    if (!nested.canonical_link.empty()) checker.check_link_name(nested.canonical_link, "canonical link");
  }
  for (const FrameDescription& frame : model.frames) {
    once(frame.source, frame.name);
    checker.check_pose(frame.pose);
    if (!frame.link.empty()) checker.check_link_name(frame.link, "carrying link");
  }
  checker.at(model.source, "/" + model.name);
  if (!model.canonical_link.empty()) checker.check_link_name(model.canonical_link, "canonical link");
}

void check_scene(Checker& checker, const SceneDescription& scene) {
  checker.at(scene.source, "");
  checker.require(scene.substep >= kMinPhysicsStep && scene.substep <= kMaxPhysicsStep, "the physics substep",
                  text(scene.substep), "1e-5 to 1 s");
  checker.require(scene.time_step >= 1e-4 && scene.time_step <= 10, "the time step", text(scene.time_step),
                  "1e-4 to 10 s");
  const double substeps = scene.time_step / scene.substep;
  checker.require(checker.found_any() || (substeps > 0.5 && std::abs(substeps - std::round(substeps)) < 1e-6),
                  "the time step", text(scene.time_step) + " s",
                  "a whole number of physics substeps (" + text(scene.substep) + " s)");
  checker.require(within(scene.gravity, kMaxGravity), "gravity", text(scene.gravity), "finite and at most 1e4 m/s^2");
  check_environment(checker, scene.environment);
  for (const ModelDescription& model : scene.models) check_model(checker, model);
  for (const FrameDescription& frame : scene.frames) {
    checker.at(frame.source, "/" + frame.name);
    checker.check_pose(frame.pose);
    if (!frame.link.empty()) checker.report("a frame of no model stays in the world: it has no link that carries it");
  }
  check_places(checker, scene);
}

}  // namespace

std::vector<Problem> check_scene(const SceneDescription& scene) {
  Checker checker;
  check_scene(checker, scene);
  return checker.found();
}

bool is_positive_definite(const Vector3& d, const Vector3& p) {
  // Sylvester's criterion: a symmetric matrix is positive definite if its leading minors are positive. A matrix that
  // passes only because of rounding counts as flat.
  const double minor2 = d.x() * d.y() - p.x() * p.x();
  const double determinant = d.x() * (d.y() * d.z() - p.z() * p.z()) - p.x() * (p.x() * d.z() - p.z() * p.y()) +
                             p.y() * (p.x() * p.z() - d.y() * p.y());
  return d.x() > 0 && minor2 > 0 && determinant > kFlat * std::pow(d.sum() / 3, 3);
}

std::vector<Problem> check_model(const ModelDescription& model) {
  Checker checker;
  check_model(checker, model);
  check_places(checker, model);
  return checker.found();
}

}  // namespace bubblesim
