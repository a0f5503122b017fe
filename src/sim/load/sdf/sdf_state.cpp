// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_state.hpp"

#include <algorithm>
#include <map>

#include "load/load_context.hpp"
#include "load/sdf/sdf_source.hpp"

namespace bubblesim {
namespace {

constexpr double kMoving = 0.01;  // m/s or rad/s; saved velocities at rest are not exactly zero

sdf::ElementPtr state_of(const sdf::World& world) { return world.Element()->FindElement("state"); }

std::string name_of(const sdf::ElementPtr& element) { return element->Get<std::string>("name"); }

std::optional<Pose> pose_in(const sdf::ElementPtr& element) {
  const sdf::ElementPtr pose = element->FindElement("pose");
  return pose != nullptr ? std::make_optional(pose->Get<Pose>()) : std::nullopt;
}

template <class Part>
Part* named(std::vector<Part>& parts, const std::string& name) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&name](const Part& part) { return part.name == name; });
  return found != parts.end() ? &*found : nullptr;
}

/// Applies the state of one model and its nested models.
class ModelState {
 public:
  ModelState(ModelDescription& model, LoadContext& reading)
      : model_(model), path_("/" + model.name), reading_(reading) {}

  void apply(const sdf::ElementPtr& state) {
    if (const auto pose = pose_in(state)) model_.pose = *pose;
    apply_parts(state, "");
  }

 private:
  void apply_parts(const sdf::ElementPtr& state, const std::string& prefix) {
    const Vector3 scale = state->Get<Vector3>("scale", Vector3::One).first;
    if (scale != Vector3::One) warn(state, "the <scale> in its <state> is ignored");
    for (auto link = state->FindElement("link"); link; link = link->GetNextElement("link")) {
      put(prefix + name_of(link), link);
    }
    for (auto inner = state->FindElement("model"); inner; inner = inner->GetNextElement("model")) {
      const std::string name = prefix + name_of(inner);
      NestedModelDescription* nested = named(model_.nested, name);
      if (nested == nullptr) {
        warn(inner, "the <state> names '" + name + "', which is not a model in it");
        continue;
      }
      if (const auto pose = pose_in(inner)) nested->pose = model_.pose.Inverse() * *pose;
      apply_parts(inner, name + "::");
    }
  }

  void put(const std::string& name, const sdf::ElementPtr& state) {
    LinkDescription* link = named(model_.links, name);
    if (link == nullptr) return warn(state, "the <state> names '" + name + "', which is not a link of it");
    const Pose velocity = state->Get<Pose>("velocity", Pose::Zero).first;
    if (velocity.Pos().Length() > kMoving || velocity.Rot().Euler().Length() > kMoving) {
      warn(state, "the <velocity> of '" + name + "' in the <state> is ignored: the link starts at rest");
    }
    const auto pose = pose_in(state);
    if (!pose) return;
    const Pose in_model = model_.pose.Inverse() * *pose;
    // Joints are defined at the links' own poses; the state gives other joint positions.
    (model_.is_static || model_.joints.empty() ? link->pose : link->start.emplace()) = in_model;
  }

  void warn(const sdf::ElementPtr& element, const std::string& message) {
    reading_.warn(source_of(element), path_, message);
  }

  ModelDescription& model_;
  std::string path_;
  LoadContext& reading_;
};

}  // namespace

std::optional<Pose> state_pose(const sdf::World& world, const std::string& kind, const std::string& name) {
  const sdf::ElementPtr state = state_of(world);
  for (auto each = state ? state->FindElement(kind) : nullptr; each; each = each->GetNextElement(kind)) {
    if (name_of(each) == name) return pose_in(each);
  }
  return std::nullopt;
}

void apply_state(const sdf::World& world, std::vector<ModelDescription>& models, LoadContext& reading) {
  const sdf::ElementPtr state = state_of(world);
  if (state == nullptr) return;
  std::map<std::string, int> seen;
  for (auto each = state->FindElement("model"); each; each = each->GetNextElement("model")) {
    std::string name = name_of(each);
    const int number = ++seen[name];
    if (number > 1) name += "_" + std::to_string(number);  // like models with equal names
    if (ModelDescription* model = named(models, name)) {
      ModelState(*model, reading).apply(each);
    } else {
      reading.warn(source_of(each), "/" + name, "the <state> contains this model, which is not in the world");
    }
  }
  for (const char* kind : {"insertions", "deletions"}) {
    const sdf::ElementPtr element = state->FindElement(kind);
    if (element == nullptr) continue;
    reading.warn(source_of(element), "", "<" + std::string(kind) + "> of the <state> is ignored");
  }
}

}  // namespace bubblesim
