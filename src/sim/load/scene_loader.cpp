// SPDX-License-Identifier: BSD-3-Clause
// From the text of a file to a checked description, with all its problems.
#include "bubblesim/scene_loader.hpp"

#include <optional>
#include <utility>

#include "bubblesim/error.hpp"
#include "load/converted_scene.hpp"
#include "load/find/scene_folders.hpp"
#include "load/load_context.hpp"
#include "load/scene_text.hpp"
#include "load/sdf/documents/documents.hpp"
#include "load/sdf/models/sdf_grippers.hpp"
#include "load/sdf/models/sdf_models.hpp"
#include "load/sdf/models/sdf_visuals.hpp"
#include "load/sdf/worlds/sdf_actors.hpp"
#include "load/sdf/worlds/sdf_worlds.hpp"
#include "load/substeps.hpp"
#include "load/urdf/urdf_model.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

// The name of a string without a file.
constexpr const char* kText = "<data-string>";
constexpr const char* kGroundPlane = "ground_plane";

ModelDescription ground_plane() {
  CollisionDescription plane;
  plane.name = "collision";
  plane.geometry = Plane{};
  LinkDescription link;
  link.name = "link";
  link.collisions.push_back(plane);
  ModelDescription model;
  model.name = kGroundPlane;
  model.is_static = true;
  model.links.push_back(link);
  return model;
}

/// Reads one document and collects its problems.
class SceneLoader {
 public:
  /// The name of the document is for errors; its files are in `folder`.
  SceneLoader(const SceneText& text, const fs::path& folder) : context_(text.name, folder), text_(text.text) {}

  SceneDescription load_scene(const fs::path& file) {
    SceneDescription scene;
    scene.name = scene.world_name = file.stem().string();
    scene.file = file;
    std::optional<double> substeps = 1;
    const XmlElement root = read_document();
    if (const XmlElement* world = root.child("world")) {
      substeps = read_world({world, world_kind()}, scene, context_);
      report_second_world(root, *world);
    } else if (auto model = read_root_model(root)) {
      scene.is_model_file = true;
      if (model->name != kGroundPlane) scene.models.push_back(ground_plane());
      scene.models.push_back(std::move(*model));
    } else if (const XmlElement* light = root.child("light")) {
      const SdfElement element(light, light_kind());
      scene.is_model_file = true;
      scene.models.push_back(ground_plane());
      scene.environment.lights = {read_light(element, element.child("pose").as_pose(), "/" + element.name(), context_)};
    } else {
      context_.report({context_.file(), 0}, "", "contains neither a <world> nor a <model>");
    }
    for (ModelDescription& each : scene.models) leave_out_broken_grippers(each, context_);
    add_problems(check_scene(scene));
    if (context_.problems().empty()) divide_substep(scene, substeps, context_);
    fail_with_problems();
    return scene;
  }

  ModelDescription load_model() {
    const XmlElement root = read_document();
    std::optional<ModelDescription> model = read_root_model(root);
    if (model) {
      leave_out_broken_grippers(*model, context_);
      add_problems(check_model(*model));
    } else {
      const bool is_world = root.child("world") != nullptr;
      context_.report({context_.file(), 0}, "",
                      is_world ? "contains a <world>: expected a <model>" : "contains no <model>");
    }
    fail_with_problems();
    return std::move(*model);
  }

  std::vector<Problem>& warnings() { return context_.warnings(); }

 private:
  XmlElement read_document() { return Documents(context_).read(text_, context_.file()); }

  /// The model of a file without a world. Gazebo takes the first of several.
  std::optional<ModelDescription> read_root_model(const XmlElement& root) {
    if (root.name == "robot") return read_urdf(root, context_);
    const XmlElement* found = root.child("model");
    if (const XmlElement* actor = root.child("actor"); found == nullptr && actor != nullptr) {
      return read_actor({actor, *sdf_kind().child("actor")}, context_);
    }
    if (found == nullptr) return std::nullopt;
    for (const XmlElement& other : root.children) {
      if (other.name != "model" || &other == found) continue;
      context_.warn(other.source(), "", "contains several models: the first one is used");
      break;
    }
    const SdfElement model(found, model_kind());
    const Frames frames(model, "/" + model.name(), context_);
    return read_model(model, frames, model.child("pose").as_pose(), context_);
  }

  void report_second_world(const XmlElement& root, const XmlElement& first) {
    for (const XmlElement& other : root.children) {
      if (other.name != "world" || &other == &first) continue;
      context_.report(other.source(), "", "a scene must have exactly one <world>: remove the others");
      return;
    }
  }

  void add_problems(std::vector<Problem> found) {
    for (Problem& problem : found) context_.problems().push_back(std::move(problem));
  }

  void fail_with_problems() {
    if (!context_.problems().empty()) throw SceneError(std::move(context_.problems()), std::move(context_.warnings()));
  }

  LoadContext context_;
  const std::string& text_;
};

void append(std::vector<Problem>* all, const std::vector<Problem>& found) {
  if (all != nullptr) all->insert(all->end(), found.begin(), found.end());
}

/// Calls `load` and converts its exceptions to a SceneError of the file.
template <class Load>
auto with_scene_errors(const std::string& file, const Load& load) {
  try {
    return load();
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception& error) {
    throw SceneError({{file, 0, "", std::string("cannot be read: ") + error.what()}});
  }
}

}  // namespace

SceneDescription read_scene(const std::string& name_or_path, const XacroArguments& arguments,
                            std::vector<Problem>* warnings) {
  const fs::path file = find_scene(name_or_path);
  check_size(file);
  return with_scene_errors(file.string(), [&] {
    ConvertedScene source{file, {}};
    if (is_foreign_scene(file)) source = convert_scene(file);
    const SceneText text = scene_text(source.file, arguments);
    SceneLoader loader(text, source.file.parent_path());
    SceneDescription scene = loader.load_scene(file);
    for (const std::string& line : source.left_out) loader.warnings().push_back({file.string(), 0, "", line});
    append(warnings, loader.warnings());
    return scene;
  });
}

std::shared_ptr<const Scene> load_scene(const std::string& name_or_path, const XacroArguments& arguments) {
  std::vector<Problem> warnings;
  SceneDescription scene = read_scene(name_or_path, arguments, &warnings);
  return Scene::of_checked(std::move(scene), std::move(warnings));
}

std::shared_ptr<const Scene> empty_scene() {
  SceneDescription scene;
  scene.name = scene.world_name = "empty";
  scene.models.push_back(ground_plane());
  return std::make_shared<const Scene>(std::move(scene));
}

ModelDescription load_model(const std::string& text, const fs::path& folder, std::vector<Problem>* warnings) {
  return with_scene_errors(kText, [&] {
    const SceneText named{text, kText};
    SceneLoader loader(named, folder);
    ModelDescription model = loader.load_model();
    append(warnings, loader.warnings());
    return model;
  });
}

}  // namespace bubblesim
