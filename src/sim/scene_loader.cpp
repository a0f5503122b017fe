// SPDX-License-Identifier: BSD-3-Clause
// Reads SDFormat through its own DOM and reports all that is wrong with a file at once.
#include "bubblesim/scene_loader.hpp"

#include <optional>
#include <sdf/sdf.hh>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "model_folders.hpp"
#include "own_elements.hpp"
#include "scene_check.hpp"
#include "scene_folders.hpp"
#include "scene_reading.hpp"
#include "scene_text.hpp"
#include "sdf_models.hpp"
#include "sdf_plugins.hpp"
#include "sdf_source.hpp"
#include "sdf_visuals.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

// What SDFormat calls a text that came from no file.
constexpr const char* kText = "<data-string>";
constexpr const char* kGroundPlane = "ground_plane";
constexpr const char* kOnDivergence = "bubblesim:on_divergence";

class SceneLoader {
 public:
  explicit SceneLoader(const fs::path& file) : reading_(file) {}
  /// `name` is what errors call the text, whose files lie in `folder`.
  SceneLoader(const std::string& text, const std::string& name, const fs::path& folder)
      : reading_(text, name, folder) {}

  /// From the file, or from what is to be read in its place.
  SceneDescription load_scene(const fs::path& file, const std::optional<SceneText>& text) {
    sdf::Root root;
    reading_.take(text ? root.LoadSdfString(text->text, parser_config()) : root.Load(file.string(), parser_config()),
                  "");
    SceneDescription scene;
    scene.name = file.stem().string();
    scene.file = file;
    read_own_elements(root);
    if (root.WorldCount() > 0) {
      read_world(*root.WorldByIndex(0), scene);
      if (root.WorldCount() > 1) {
        reading_.report(source_of(root.WorldByIndex(1)->Element()), "", "a scene is one <world>: take the others out");
      }
    } else if (root.Model() != nullptr) {
      scene.is_model_file = true;
      if (root.Model()->Name() != kGroundPlane) scene.models.push_back(ground_plane());
      scene.models.push_back(read_model(*root.Model(), root.Model()->RawPose(), reading_));
    } else if (problems_.empty()) {
      problems_.push_back({file.string(), 0, "", "holds neither a <world> nor a <model>"});
    }
    // Values that could not be read stand at their defaults: checking those would only hide the cause.
    if (problems_.empty() || root.WorldCount() > 0) {
      for (Problem& problem : check_scene(scene)) problems_.push_back(std::move(problem));
    }
    if (!problems_.empty()) throw SceneError(std::move(problems_));
    return scene;
  }

  ModelDescription load_model(const std::string& text) {
    sdf::Root root;
    reading_.take(root.LoadSdfString(text, parser_config()), "");
    read_own_elements(root);
    ModelDescription model;
    if (root.Model() != nullptr) {
      model = read_model(*root.Model(), root.Model()->RawPose(), reading_);
    } else if (problems_.empty()) {
      problems_.push_back(
          {kText, 0, "", root.WorldCount() > 0 ? "holds a <world>: a <model> is wanted" : "holds no <model>"});
    }
    if (problems_.empty()) problems_ = check_model(model);
    if (!problems_.empty()) throw SceneError(std::move(problems_));
    return model;
  }

 private:
  sdf::ParserConfig parser_config() const {
    sdf::ParserConfig config;
    config.SetFindCallback([this](const std::string& uri) { return find_model(uri, reading_.folder()).string(); });
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
    return config;
  }

  void read_own_elements(const sdf::Root& root) {
    if (root.Element() == nullptr) return;
    reading_.xml().place_elements(root.Element());
    check_own_elements(root.Element(), problems_);
  }

  static ModelDescription ground_plane() {
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

  void read_policy(const std::string& policy, const sdf::World& world, SceneDescription& scene) {
    const std::vector<std::pair<std::string, OnDivergence>> policies = {
        {"pause", OnDivergence::kPause}, {"reset", OnDivergence::kReset}, {"remove", OnDivergence::kRemove}};
    for (const auto& [name, meaning] : policies) {
      if (policy != name) continue;
      scene.on_divergence = meaning;
      return;
    }
    reading_.report(source_of(world.Element(), kOnDivergence), "",
                    "<" + std::string(kOnDivergence) + "> is '" + policy + "', it must be pause, reset or remove" +
                        did_you_mean(policy, {"pause", "reset", "remove"}));
  }

  void read_world(const sdf::World& world, SceneDescription& scene) {
    scene.source = source_of(world.Element());
    scene.plugins = read_plugins(world.Element());
    scene.gravity = world.Gravity();
    if (const sdf::Physics* physics = world.PhysicsDefault()) scene.physics_step = physics->MaxStepSize();
    if (const auto step = own_number(world.Element(), "bubblesim:time_step", problems_)) scene.time_step = *step;
    if (const auto policy = own_text(world.Element(), kOnDivergence)) read_policy(*policy, world, scene);
    if (world.Scene() != nullptr) read_surroundings(*world.Scene(), scene.environment);
    if (const auto* place = world.SphericalCoordinates()) read_origin(*place, scene.environment.origin);
    std::vector<Light> lights;
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      const sdf::Light& light = *world.LightByIndex(i);
      lights.push_back(read_light(light, reading_.resolved(light, "/" + light.Name())));
    }
    if (!lights.empty()) scene.environment.lights = lights;
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      scene.models.push_back(read_model(model, reading_.resolved(model, "/" + model.Name()), reading_));
    }
  }

  SceneReading reading_;
  std::vector<Problem>& problems_ = reading_.problems();
};

}  // namespace

SceneDescription load_scene(const std::string& name_or_path) {
  const fs::path file = find_scene(name_or_path);
  const std::optional<SceneText> text = scene_text(file);
  if (!text) return SceneLoader(file).load_scene(file, text);
  return SceneLoader(text->text, text->name, file.parent_path()).load_scene(file, text);
}

ModelDescription load_model(const std::string& text, const fs::path& folder) {
  return SceneLoader(text, kText, folder).load_model(text);
}

}  // namespace bubblesim
