// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/worlds/sdf_worlds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/foreign_models.hpp"
#include "load/included_places.hpp"
#include "load/sdf/documents/documents.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "load/sdf/models/frames.hpp"
#include "load/sdf/models/sdf_models.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"
#include "load/sdf/models/sdf_plugins.hpp"
#include "load/sdf/models/sdf_tree.hpp"
#include "load/sdf/models/sdf_visuals.hpp"
#include "load/sdf/worlds/sdf_actors.hpp"
#include "load/sdf/worlds/sdf_randomize.hpp"
#include "load/sdf/worlds/sdf_state.hpp"
#include "load/substeps.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr const char* kOnDivergence = "bubblesim:on_divergence";
constexpr const char* kSolver = "bubblesim:solver";
constexpr const char* kTimeStep = "bubblesim:time_step";

void read_policy(const SdfElement& world, SceneDescription& scene, LoadContext& context) {
  const auto policy = own_text(world, kOnDivergence);
  if (!policy) return;
  const std::vector<std::pair<std::string, OnDivergence>> policies = {
      {"pause", OnDivergence::kPause}, {"reset", OnDivergence::kReset}, {"remove", OnDivergence::kRemove}};
  for (const auto& [name, meaning] : policies) {
    if (*policy != name) continue;
    scene.on_divergence = meaning;
    return;
  }
  context.report(world.source(kOnDivergence), "",
                 "<" + std::string(kOnDivergence) + "> is '" + *policy + "', it must be pause, reset or remove" +
                     did_you_mean(*policy, {"pause", "reset", "remove"}));
}

void read_solver(const SdfElement& physics, SceneDescription& scene, LoadContext& context) {
  const auto solver = own_text(physics, kSolver);
  if (!solver || *solver == "bubblesim") return;
  if (*solver == "ode") {
    scene.solver = Solver::kOde;
    return;
  }
  context.report(physics.source(kSolver), "",
                 "<" + std::string(kSolver) + "> is '" + *solver + "', it must be ode or bubblesim" +
                     did_you_mean(*solver, {"ode", "bubblesim"}));
}

/// The longest step of whole physics substeps that does not exceed the default, or a single substep.
void fit_time_step(SceneDescription& scene) {
  if (!(scene.substep >= kMinPhysicsStep && scene.substep <= kMaxPhysicsStep)) return;  // reported later
  const double steps = scene.time_step / scene.substep;
  const bool fits = std::abs(steps - std::round(steps)) < 1e-6;
  if (!fits) scene.time_step = scene.substep * std::max(1.0, std::floor(steps + 1e-6));
}

/// The <physics> that is the default, or the first one.
SdfElement default_physics(const SdfElement& world) {
  for (const SdfElement& physics : world.children("physics")) {
    if (is_true(physics.attribute("default"))) return physics;
  }
  return world.child("physics");
}

std::optional<double> read_steps(const SdfElement& world, SceneDescription& scene, LoadContext& context) {
  const SdfElement physics = default_physics(world);
  scene.substep = physics.number("max_step_size");
  read_solver(physics, scene, context);
  const std::optional<double> substeps = read_substeps(physics, context);
  if (const auto step = own_number(world, kTimeStep, "", context)) {
    scene.time_step = *step;
  } else {
    fit_time_step(scene);
  }
  return substeps;
}

void read_environment(const SdfElement& world, const Frames& frames, Environment& environment, LoadContext& context) {
  environment.magnetic_field = world.vector("magnetic_field");
  environment.wind = world.child("wind").vector("linear_velocity");
  if (const SdfElement scene = world.child("scene")) read_surroundings(scene, environment);
  if (const SdfElement place = world.child("spherical_coordinates")) read_origin(place, environment.origin, context);
  std::vector<Light> lights;
  for (const SdfElement& light : world.children("light")) {
    const Pose pose = frames.pose_of(light, "", "/" + light.name(), context);
    lights.push_back(
        read_light(light, state_pose(world, "light", light.name()).value_or(pose), "/" + light.name(), context));
  }
  if (!lights.empty()) environment.lights = std::move(lights);
}

bool has_parts(const SdfElement& model) {
  return model.xml().name == "include" || model.has("link") || model.has("model") || model.has("include");
}

void read_models(const SdfElement& world, const Frames& frames, SceneDescription& scene, LoadContext& context) {
  for (const XmlElement& child : world.xml().children) {
    if (child.name != "model" && child.name != "include") continue;
    const SdfElement model(&child, *world.kind().child(child.name));
    if (!has_parts(model) && model.flag("static")) {
      context.warn(model.source(), "/" + model.name(), "has no link: ignored");
      continue;
    }
    scene.models.push_back(read_model(model, frames.inner(model.name()), frames.pose(model.name()), context));
  }
}

/// Adds the models of files of CoppeliaSim. They keep their places in the file; the <pose> moves all of them.
void read_foreign_models(const SdfElement& world, const Frames& frames, SceneDescription& scene, LoadContext& context) {
  for (const XmlElement& child : world.xml().children) {
    if (child.name != kForeignInclude) continue;
    const SdfElement include(&child, *world.kind().child("include"));
    const std::string path = "/" + include.name();
    for (const char* other : {"static", "placement_frame", "plugin"}) {
      if (include.has(other)) context.warn(include.source(), path, std::string("<") + other + "> is ignored");
    }
    const std::string alias = include.text("name");
    include_foreign_models({include.text("uri"), include.name(), alias, frames.pose_of(include, "", path, context)},
                           scene, context.warnings());
  }
}

}  // namespace

std::optional<double> read_world(const SdfElement& world, SceneDescription& scene, LoadContext& context) {
  scene.source = world.source();
  if (!world.name().empty()) scene.world_name = world.name();
  scene.plugins = read_plugins(world);
  scene.randomized = read_randomized(world, context);
  scene.gravity = world.vector("gravity");
  const std::optional<double> substeps = read_steps(world, scene, context);
  context.axes() = read_axis_convention(world, "", context);
  read_policy(world, scene, context);
  const Frames frames(world, "", context);
  read_environment(world, frames, scene.environment, context);
  read_models(world, frames, scene, context);
  for (const SdfElement& actor : world.children("actor")) scene.models.push_back(read_actor(actor, context));
  scene.frames = read_objects(world, "", context);
  separate_included_places(scene);
  scene.collections = read_collections(world, context);
  read_foreign_models(world, frames, scene, context);
  apply_state(world, scene.models, context);
  return substeps;
}

}  // namespace bubblesim
