// SPDX-License-Identifier: BSD-3-Clause
// A file of CoppeliaSim as models that are added to another scene.
#include "load/foreign_models.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "load/included_places.hpp"
#include "load/ttt/write_scene.hpp"

namespace bubblesim {
namespace {

/// Gives all that has a name a longer one. What scripts see stays: it becomes the alias.
class Renaming {
 public:
  explicit Renaming(const std::string& suffix) : suffix_(suffix) {}

  void rename(ModelDescription& model) const {
    rename_part(model);
    extend(model.canonical_link);
    for (LinkDescription& link : model.links) {
      rename_part(link);
      extend(link.carrier);
      rename(link.sensors);
    }
    for (JointDescription& joint : model.joints) rename(joint);
    for (FrameDescription& frame : model.frames) {
      rename_part(frame);
      extend(frame.link);
      if (frame.joint) rename(*frame.joint);
    }
  }

 private:
  void extend(std::string& name) const {
    if (!name.empty() && name != "world") name += suffix_;
  }

  template <class Part>
  void rename_part(Part& part) const {
    if (part.alias.empty()) part.alias = part.name;
    part.name += suffix_;
  }

  void rename(JointDescription& joint) const {
    rename_part(joint);
    extend(joint.parent);
    extend(joint.child);
    for (AxisDescription& axis : joint.axes) {
      if (axis.mimic) extend(axis.mimic->joint);
    }
    rename(joint.sensors);
  }

  void rename(std::vector<SensorDescription>& sensors) const {
    for (SensorDescription& sensor : sensors) {
      rename_part(sensor);
      if (auto* sonar = sensor.kind.get_if<SonarDescription>()) {
        for (std::string& link : sonar->detects) extend(link);
      }
    }
  }

  const std::string& suffix_;
};

}  // namespace

void include_foreign_models(const ForeignInclude& include, SceneDescription& scene, std::vector<Problem>& warnings) {
  std::vector<ModelDescription> models = load_foreign_models(include.file, "_" + include.name, &warnings);
  std::vector<ModelDescription*> included;
  for (ModelDescription& model : models) included.push_back(&model);
  if (!include.alias.empty()) set_top_alias(included, include.alias);
  renumber_places(included, scene);
  for (ModelDescription& model : models) {
    model.pose = include.pose * model.pose;
    for (FrameDescription& frame : model.frames) {
      if (frame.link.empty()) frame.pose = include.pose * frame.pose;
    }
    scene.models.push_back(std::move(model));
  }
}

std::vector<ModelDescription> load_foreign_models(const std::filesystem::path& file, const std::string& suffix,
                                                  std::vector<Problem>* warnings) {
  SceneDescription scene = read_scene(file.string(), {}, warnings);
  std::vector<ModelDescription> models = std::move(scene.models);
  const auto is_floor = [](const ModelDescription& model) { return model.name == ttt::kFloor; };
  models.erase(std::remove_if(models.begin(), models.end(), is_floor), models.end());
  if (models.empty())
    throw SceneError({{file.string(), 0, "", "has no shape and no sensor: there is no model to add"}});
  std::vector<FrameDescription>& frames = models.front().frames;
  for (FrameDescription& frame : scene.frames) frames.push_back(std::move(frame));
  const Renaming renaming(suffix);
  for (ModelDescription& model : models) {
    renaming.rename(model);
    model.is_foreign = true;
  }
  return models;
}

}  // namespace bubblesim
