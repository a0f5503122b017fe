// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_models.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "load/included_places.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "load/sdf/models/sdf_grippers.hpp"
#include "load/sdf/models/sdf_joints.hpp"
#include "load/sdf/models/sdf_links.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"
#include "load/sdf/models/sdf_plugins.hpp"
#include "load/sdf/models/sdf_scripts.hpp"
#include "load/sdf/models/sdf_tree.hpp"

namespace bubblesim {
namespace {

constexpr const char* kChildScript = "bubblesim:child_script";

/// The child script of a model, beside the file that names it.
std::filesystem::path read_child_script(const SdfElement& model, const std::string& path, LoadContext& context) {
  const auto name = own_text(model, kChildScript);
  if (!name) return {};
  const Source source = model.source(kChildScript);
  std::filesystem::path file = context.folder_of(source) / *name;
  if (name->empty()) {
    context.report(source, path, "<" + std::string(kChildScript) + "> is empty: expected a file name");
  } else if (!std::filesystem::is_regular_file(file)) {
    context.report(source, path, "the child script " + file.string() + " does not exist");
  }
  return file;
}

bool is_robot(const SdfElement& model) { return model.xml().name == "include"; }

const ModelDescription& robot_of(const SdfElement& include, LoadContext& context) {
  return context.included_robots().at(include.text("uri"));
}

/// Reads the contents of one model. `inner` is the name of a nested model, from the outermost model on and followed by
/// "::", and its pose relative to that one.
class ModelReader {
 public:
  ModelReader(ModelDescription& description, LoadContext& context) : description_(description), context_(context) {}

  void read(const SdfElement& model, const Frames& frames, const std::string& inner, const Pose& pose,
            const std::string& path) {
    const bool is_static = model.flag("static");
    for (const SdfElement& element : model.children("link")) {
      LinkDescription link = read_link(element, frames, path, description_.is_static, context_);
      if (!element.has("enable_wind")) link.wind_enabled = model.flag("enable_wind");
      add_link(std::move(link), inner, pose, is_static);
    }
    for (const SdfElement& element : model.children("joint")) {
      if (auto joint = read_joint(element, frames, path, context_)) add_joint(std::move(*joint), inner, pose);
    }
    for (const SdfElement& element : model.children("gripper")) {
      description_.grippers.push_back(read_gripper(element, inner));
    }
    for (const XmlElement& child : model.xml().children) {
      if (child.name != "model" && child.name != "include") continue;
      read_inner({&child, *model.kind().child(child.name)}, frames, inner, pose, path);
    }
  }

  /// The links and joints of a model that was read before.
  void add(const ModelDescription& model, const std::string& inner, const Pose& pose, bool is_static) {
    for (const LinkDescription& link : model.links) add_link(link, inner, pose, is_static);
    for (const JointDescription& joint : model.joints) add_joint(joint, inner, pose);
    for (GripperDescription gripper : model.grippers) {
      gripper.palm = inner + gripper.palm;
      for (std::string& finger : gripper.fingers) finger = inner + finger;
      description_.grippers.push_back(std::move(gripper));
    }
  }

 private:
  void add_link(LinkDescription link, const std::string& inner, const Pose& pose, bool is_static) {
    link.name = inner + link.name;
    link.pose = pose * link.pose;
    if (is_static && !description_.is_static) hold(link);
    description_.links.push_back(std::move(link));
  }

  void add_joint(JointDescription joint, const std::string& inner, const Pose& pose) {
    const auto prefix = [&inner](std::string& name) {
      if (!name.empty() && name != "world") name = inner + name;
    };
    joint.name = inner + joint.name;
    joint.pose = pose * joint.pose;
    prefix(joint.parent);
    prefix(joint.child);
    prefix(joint.gearbox_reference);
    for (AxisDescription& axis : joint.axes) {
      if (axis.mimic) prefix(axis.mimic->joint);
    }
    description_.joints.push_back(std::move(joint));
  }

  void read_inner(const SdfElement& model, const Frames& frames, const std::string& inner, const Pose& pose,
                  const std::string& outer_path) {
    const std::string path = outer_path + "/" + model.name();
    NestedModelDescription nested;
    nested.name = inner + model.name();
    nested.alias = read_alias(model, path, context_);
    nested.pose = pose * frames.pose(model.name());
    nested.source = model.source();
    nested.child_script = read_child_script(model, path, context_);
    nested.plugins = read_plugins(model);
    const std::string prefix = nested.name + "::";
    const Pose placed = nested.pose;
    const std::size_t first = description_.links.size();
    const std::size_t index = description_.nested.size();
    description_.nested.push_back(std::move(nested));
    std::string canonical_link;
    if (is_robot(model)) {
      const ModelDescription& robot = robot_of(model, context_);
      add(robot, prefix, placed, model.flag("static"));
      canonical_link = robot.canonical_link;
      std::vector<PluginDescription>& plugins = description_.nested[index].plugins;
      plugins.insert(plugins.begin(), robot.plugins.begin(), robot.plugins.end());
    } else {
      read(model, frames.inner(model.name()), prefix, placed, path);
      canonical_link = model.attribute("canonical_link");
    }
    if (description_.links.size() == first) {
      context_.report(model.source(), path, "has no link; add a <link>");
      return;
    }
    description_.nested[index].canonical_link =
        canonical_link.empty() ? description_.links[first].name : prefix + canonical_link;
  }

  /// A static model nested in a moving one is fixed to the world.
  void hold(const LinkDescription& link) {
    JointDescription joint;
    joint.name = link.name + "_held";
    joint.type = "fixed";
    joint.parent = "world";
    joint.child = link.name;
    joint.pose = link.pose;
    joint.source = link.source;
    description_.joints.push_back(std::move(joint));
  }

  ModelDescription& description_;
  LoadContext& context_;
};

/// Files before SDFormat 1.8 have nested models as links named inner::link, with a frame inner::__model__ at most.
void add_flattened_models(const Frames& frames, ModelDescription& model) {
  const std::string separator = "::";
  for (const LinkDescription& link : model.links) {
    for (std::size_t at = link.name.find(separator); at != std::string::npos; at = link.name.find(separator, at + 2)) {
      const std::string name = link.name.substr(0, at);
      const bool is_known = std::any_of(model.nested.begin(), model.nested.end(),
                                        [&name](const NestedModelDescription& nested) { return nested.name == name; });
      if (is_known) continue;
      NestedModelDescription nested;
      nested.name = name;
      const std::string frame = name + separator + "__model__";
      if (frames.has(frame)) nested.pose = frames.pose(frame);
      nested.canonical_link = link.name;
      nested.source = link.source;
      model.nested.push_back(std::move(nested));
    }
  }
}

/// Replaces '/' in names, because it is the separator of paths.
std::string name_in_paths(const SdfElement& model, LoadContext& context) {
  std::string name = model.name();
  if (name.find('/') == std::string::npos) return name;
  std::replace(name.begin(), name.end(), '/', '_');
  context.warn(model.source(), "/" + name, "renamed: '/' is the separator of paths");
  return name;
}

/// Its waypoints are in the frame of the model's pose.
void read_motion(const SdfElement& model, ModelDescription& description, LoadContext& context) {
  if (!model.has("bubblesim:script")) return;
  const SdfElement element = model.child("bubblesim:script");
  const Pose pose = description.pose;
  MotionScript script = read_script(
      element, [&](const Pose& waypoint) { return pose * waypoint; }, context);
  if (script.trajectories.empty()) {
    context.report(element.source(), "/" + description.name, "<bubblesim:script> has no <waypoint>");
    return;
  }
  description.pose = script.trajectories.front().waypoints.front().pose;
  if (element.flag("auto_start")) description.script = std::move(script);
}

}  // namespace

ModelDescription read_model(const SdfElement& model, const Frames& frames, const Pose& pose, LoadContext& context) {
  ModelDescription description;
  if (is_robot(model)) {
    description = robot_of(model, context);
    if (model.has("static")) description.is_static = model.flag("static");
  } else {
    description.is_static = model.flag("static");
    description.self_collide = model.flag("self_collide");
    description.canonical_link = model.attribute("canonical_link");
    description.source = model.source();
  }
  description.name = name_in_paths(model, context);
  const std::string path = "/" + description.name;
  description.alias = read_alias(model, path, context);
  description.axes = read_axis_convention(model, path, context);
  description.pose = pose;
  description.child_script = read_child_script(model, path, context);
  for (PluginDescription& plugin : read_plugins(model)) description.plugins.push_back(std::move(plugin));
  if (!is_robot(model)) {
    ModelReader(description, context).read(model, frames, "", Pose(), path);
    add_flattened_models(frames, description);
    read_motion(model, description, context);
    description.is_object = model.flag("bubblesim:is_object");
    description.frames = read_objects(model, path, context);
    if (!description.is_object) give_to_top(description);
  }
  return description;
}

}  // namespace bubblesim
