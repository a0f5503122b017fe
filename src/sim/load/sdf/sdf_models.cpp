// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_models.hpp"

#include <filesystem>
#include <string>
#include <utility>

#include "load/sdf/sdf_joints.hpp"
#include "load/sdf/sdf_left_out.hpp"
#include "load/sdf/sdf_links.hpp"
#include "load/sdf/sdf_names_and_axes.hpp"
#include "load/sdf/sdf_plugins.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf_extensions.hpp"

namespace bubblesim {
namespace {

constexpr const char* kChildScript = "bubblesim:child_script";

/// The child script of a model, relative to the model's file; an <include> may replace it.
std::filesystem::path read_child_script(const sdf::ElementPtr& model, const std::string& path, LoadContext& reading) {
  const sdf::ElementPtr include = model->GetIncludeElement();
  if (include != nullptr) check_own_elements(include, reading.problems());
  const bool given_by_include = include != nullptr && own_text(include, kChildScript);
  const sdf::ElementPtr& giver = given_by_include ? include : model;
  const auto name = own_text(giver, kChildScript);
  if (!name) return {};
  const bool of_included_file = include != nullptr && !given_by_include;
  std::filesystem::path file =
      (of_included_file ? std::filesystem::path(model->FilePath()).parent_path() : reading.folder()) / *name;
  const Source source = given_by_include ? reading.xml().place_of(kChildScript, *name) : source_of(model, kChildScript);
  if (name->empty()) {
    reading.report(source, path, "<" + std::string(kChildScript) + "> is empty: expected a file name");
  } else if (!std::filesystem::is_regular_file(file)) {
    reading.report(source, path, "the child script " + file.string() + " does not exist");
  }
  return file;
}

/// Reads the contents of one model. `inner` is the name of a nested model, from the outermost model on and followed by
/// "::", and its pose relative to that one.
class ModelReader {
 public:
  ModelReader(ModelDescription& description, LoadContext& reading) : description_(description), reading_(reading) {}

  void read(const sdf::Model& model, const std::string& inner, const Pose& pose, const std::string& path) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& read = *model.LinkByIndex(i);
      LinkDescription link = read_link(read, path, description_.is_static, reading_);
      if (!read.Element()->HasElement("enable_wind")) link.wind_enabled = model.EnableWind();
      link.name = inner + link.name;
      link.pose = pose * link.pose;
      if (model.Static() && !description_.is_static) hold(link);
      description_.links.push_back(std::move(link));
    }
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) read_joint_in(*model.JointByIndex(i), inner, pose, path);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) read_inner(*model.ModelByIndex(i), inner, pose, path);
  }

 private:
  void read_inner(const sdf::Model& model, const std::string& inner, const Pose& pose, const std::string& outer_path) {
    const std::string path = outer_path + "/" + model.Name();
    report_left_out(model.Element(), path, reading_);
    NestedModelDescription nested;
    nested.name = inner + model.Name();
    nested.alias = read_alias(model.Element(), path, reading_);
    nested.pose = pose * reading_.resolved(model, path);
    nested.source = source_of(model.Element());
    nested.child_script = read_child_script(model.Element(), path, reading_);
    nested.plugins = read_plugins(model.Element());
    const std::string prefix = nested.name + "::";
    const Pose placed = nested.pose;
    const std::size_t first = description_.links.size();
    const std::size_t index = description_.nested.size();
    description_.nested.push_back(std::move(nested));
    read(model, prefix, placed, path);
    if (description_.links.size() == first) {
      reading_.report(source_of(model.Element()), path, "has no link; add a <link>");
      return;
    }
    const std::string& named = model.CanonicalLinkName();
    description_.nested[index].canonical_link = named.empty() ? description_.links[first].name : prefix + named;
  }

  void read_joint_in(const sdf::Joint& read, const std::string& inner, const Pose& pose, const std::string& path) {
    JointDescription joint = read_joint(read, path, reading_);
    if (joint.parent.empty() || joint.child.empty()) return;  // reported already
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
  LoadContext& reading_;
};

/// Replaces '/' in names, because it is the separator of paths.
std::string name_in_paths(const sdf::Model& model, LoadContext& reading) {
  std::string name = model.Name();
  if (name.find('/') == std::string::npos) return name;
  std::replace(name.begin(), name.end(), '/', '_');
  reading.warn(source_of(model.Element()), "/" + name, "renamed: '/' is the separator of paths");
  return name;
}

}  // namespace

ModelDescription read_model(const sdf::Model& model, const Pose& pose, LoadContext& reading) {
  const std::string name = name_in_paths(model, reading);
  const std::string path = "/" + name;
  report_left_out(model.Element(), path, reading);
  ModelDescription description;
  description.name = name;
  description.alias = read_alias(model.Element(), path, reading);
  description.axes = read_axis_convention(model.Element(), path, reading);
  description.pose = pose;
  description.is_static = model.Static();
  description.self_collide = model.SelfCollide();
  description.canonical_link = model.CanonicalLinkName();
  description.source = source_of(model.Element());
  description.child_script = read_child_script(model.Element(), path, reading);
  description.plugins = read_plugins(model.Element());
  ModelReader(description, reading).read(model, "", Pose::Zero, path);
  return description;
}

}  // namespace bubblesim
