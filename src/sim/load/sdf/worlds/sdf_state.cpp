// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/worlds/sdf_state.hpp"

#include <algorithm>
#include <map>

#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

constexpr double kMoving = 0.01;  // m/s or rad/s; saved velocities at rest are not exactly zero

std::optional<Pose> pose_in(const SdfElement& element) {
  return element.has("pose") ? std::make_optional(element.child("pose").as_pose()) : std::nullopt;
}

/// Not a pose, though SDFormat writes it as one: angular velocities are no angles.
Twist twist_in(const SdfElement& velocity) {
  std::vector<double> n;
  read_numbers(velocity.as_text(), n);
  n.resize(6);
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

template <class Part>
Part* named(std::vector<Part>& parts, const std::string& name) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&name](const Part& part) { return part.name == name; });
  return found != parts.end() ? &*found : nullptr;
}

/// Applies the state of one model and its nested models.
class ModelState {
 public:
  ModelState(ModelDescription& model, LoadContext& context)
      : model_(model), path_("/" + model.name), context_(context) {}

  void apply(const SdfElement& state) {
    if (const auto pose = pose_in(state)) model_.pose = *pose;
    apply_parts(state, "");
  }

 private:
  void apply_parts(const SdfElement& state, const std::string& prefix) {
    constexpr double kRounded = 1e-3;
    if (!state.vector("scale").isOnes(kRounded)) warn(state, "the <scale> in its <state> is ignored");
    for (const SdfElement& link : state.children("link")) put(prefix + link.name(), link);
    for (const SdfElement& inner : state.children("model")) {
      const std::string name = prefix + inner.name();
      NestedModelDescription* nested = named(model_.nested, name);
      if (nested == nullptr) {
        warn(inner, "the <state> names '" + name + "', which is not a model in it");
        continue;
      }
      if (const auto pose = pose_in(inner)) nested->pose = model_.pose.inverse() * *pose;
      apply_parts(inner, name + "::");
    }
  }

  void put(const std::string& name, const SdfElement& state) {
    LinkDescription* link = named(model_.links, name);
    if (link == nullptr) return warn(state, "the <state> names '" + name + "', which is not a link of it");
    const Twist velocity = twist_in(state.child("velocity"));
    const bool moves = velocity.linear.norm() > kMoving || velocity.angular.norm() > kMoving;
    if (moves && !model_.is_static) link->start_velocity = velocity;
    const auto pose = pose_in(state);
    if (!pose) return;
    const Pose in_model = model_.pose.inverse() * *pose;
    // Joints are defined at the links' own poses; the state gives other joint positions.
    (model_.is_static || model_.joints.empty() ? link->pose : link->start.emplace()) = in_model;
  }

  void warn(const SdfElement& element, const std::string& message) { context_.warn(element.source(), path_, message); }

  ModelDescription& model_;
  std::string path_;
  LoadContext& context_;
};

}  // namespace

std::optional<Pose> state_pose(const SdfElement& world, const std::string& kind, const std::string& name) {
  for (const SdfElement& each : world.child("state").children(kind)) {
    if (each.name() == name) return pose_in(each);
  }
  return std::nullopt;
}

void apply_state(const SdfElement& world, std::vector<ModelDescription>& models, LoadContext& context) {
  const SdfElement state = world.child("state");
  std::map<std::string, int> seen;
  for (const SdfElement& each : state.children("model")) {
    std::string name = each.name();
    const int number = ++seen[name];
    if (number > 1) name += "_" + std::to_string(number);  // like models with equal names
    if (ModelDescription* model = named(models, name)) {
      ModelState(*model, context).apply(each);
    } else {
      context.warn(each.source(), "/" + name, "the <state> contains this model, which is not in the world");
    }
  }
  for (const char* kind : {"insertions", "deletions"}) {
    if (const SdfElement element = state.child(kind)) {
      context.warn(element.source(), "", "<" + std::string(kind) + "> of the <state> is ignored");
    }
  }
}

}  // namespace bubblesim
