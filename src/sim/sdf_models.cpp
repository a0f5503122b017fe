// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_models.hpp"

#include <filesystem>
#include <string>

#include "own_elements.hpp"
#include "sdf_joints.hpp"
#include "sdf_links.hpp"
#include "sdf_plugins.hpp"
#include "sdf_source.hpp"

namespace bubblesim {
namespace {

constexpr const char* kChildScript = "bubblesim:child_script";

/// The file that a model names, beside the file that the model stands in; whoever includes a model may give it
/// another.
std::filesystem::path read_child_script(const sdf::ElementPtr& model, const std::string& path, SceneReading& reading) {
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
    reading.report(source, path, "<" + std::string(kChildScript) + "> names no file");
  } else if (!std::filesystem::is_regular_file(file)) {
    reading.report(source, path, "the child script " + file.string() + " does not exist");
  }
  return file;
}

}  // namespace

ModelDescription read_model(const sdf::Model& model, const Pose& pose, SceneReading& reading) {
  const std::string path = "/" + model.Name();
  ModelDescription description;
  description.name = model.Name();
  description.pose = pose;
  description.is_static = model.Static();
  description.self_collide = model.SelfCollide();
  description.canonical_link = model.CanonicalLinkName();
  description.source = source_of(model.Element());
  description.child_script = read_child_script(model.Element(), path, reading);
  description.plugins = read_plugins(model.Element());
  if (model.ModelCount() > 0) reading.report(description.source, path, "models inside a model are not supported");
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    description.links.push_back(read_link(*model.LinkByIndex(i), path, model.Static(), reading));
  }
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
    description.joints.push_back(read_joint(*model.JointByIndex(i), path, reading));
  }
  return description;
}

}  // namespace bubblesim
