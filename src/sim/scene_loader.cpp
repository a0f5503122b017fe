// SPDX-License-Identifier: BSD-3-Clause
// Reads SDFormat through its own DOM and reports all that is wrong with a file at once.
#include "bubblesim/scene_loader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sdf/sdf.hh>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "checks.hpp"
#include "model_folders.hpp"
#include "own_elements.hpp"
#include "parser_messages.hpp"
#include "scene_check.hpp"
#include "scene_folders.hpp"
#include "scene_reading.hpp"
#include "scene_text.hpp"
#include "sdf_models.hpp"
#include "sdf_plugins.hpp"
#include "sdf_source.hpp"
#include "sdf_visuals.hpp"
#include "urdf_reading.hpp"

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
    parse(
        [&](const sdf::ParserConfig& config) {
          return text ? root.LoadSdfString(text->text, config) : root.Load(file.string(), config);
        },
        root);
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
      scene.models.push_back(read_root_model(root));
    } else if (root.Light() != nullptr) {
      scene.is_model_file = true;
      scene.models.push_back(ground_plane());
      scene.environment.lights = {read_light(*root.Light(), root.Light()->RawPose())};
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
    parse([&](const sdf::ParserConfig& config) { return root.LoadSdfString(text, config); }, root);
    read_own_elements(root);
    ModelDescription model;
    if (root.Model() != nullptr) {
      model = read_root_model(root);
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
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);  // so that the reading hears of them
    return config;
  }

  template <class Load>
  void parse(const Load& load, sdf::Root& root) {
    try {
      const ParserMessages messages;
      const bool is_urdf = reading_.xml().is_urdf();
      const sdf::Errors errors = is_urdf ? load_urdf(root, parser_config(), reading_) : load(parser_config());
      const bool failed = root.Model() == nullptr && root.Light() == nullptr && root.WorldCount() == 0;
      take_messages(is_urdf ? messages.of_urdf() : std::vector<std::string>{}, failed);
      if (problems_.empty()) reading_.take(errors, "");
      take_messages(messages.of_sdformat(), false);
    } catch (const SceneError&) {
      throw;
    } catch (const std::exception& error) {  // its assertions, and numbers that it did not expect
      reading_.report({reading_.xml().file(), 0}, "", std::string("SDFormat cannot read it: ") + error.what());
    }
  }

  /// What no error says. Problems when nothing can be had of the file.
  void take_messages(const std::vector<std::string>& messages, bool failed) {
    const Source file{reading_.xml().file(), 0};
    for (const std::string& message : messages) {
      if (failed) reading_.report(file, "", message);
      if (!failed && problems_.empty()) SceneReading::warn(file, "", message);
    }
  }

  ModelDescription read_root_model(const sdf::Root& root) {
    ModelDescription model = read_model(*root.Model(), root.Model()->RawPose(), reading_);
    if (reading_.xml().is_urdf()) finish_urdf(model, reading_);
    return model;
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

  /// The longest pass of whole physics steps that is not over the default, or a single one.
  static void fit_time_step(SceneDescription& scene) {
    if (!(scene.physics_step >= kMinPhysicsStep && scene.physics_step <= kMaxPhysicsStep)) return;  // told later
    const double steps = scene.time_step / scene.physics_step;
    const bool fits = std::abs(steps - std::round(steps)) < 1e-6;
    if (!fits) scene.time_step = scene.physics_step * std::max(1.0, std::floor(steps + 1e-6));
  }

  /// What worlds may hold that is not simulated.
  static void tell_left_out(const sdf::World& world) {
    const std::pair<const char*, const char*> kinds[] = {{"actor", "actors"},
                                                         {"road", "roads"},
                                                         {"population", "populations of models"},
                                                         {"joint", "joints between models"}};
    for (const auto& [name, called] : kinds) {
      if (!world.Element()->HasElement(name)) continue;
      for (auto element = world.Element()->GetElement(name); element != nullptr;
           element = element->GetNextElement(name)) {
        SceneReading::warn(source_of(element), "/" + element->Get<std::string>("name"),
                           "<" + std::string(name) + "> is left out: " + called + " are not simulated");
      }
    }
  }

  void read_world(const sdf::World& world, SceneDescription& scene) {
    scene.source = source_of(world.Element());
    scene.plugins = read_plugins(world.Element());
    scene.gravity = world.Gravity();
    if (const sdf::Physics* physics = world.PhysicsDefault()) scene.physics_step = physics->MaxStepSize();
    if (const auto step = own_number(world.Element(), "bubblesim:time_step", problems_)) {
      scene.time_step = *step;
    } else {
      fit_time_step(scene);
    }
    if (const auto policy = own_text(world.Element(), kOnDivergence)) read_policy(*policy, world, scene);
    // SDFormat rounds its own default to millionths.
    if (const auto field = world.Element()->FindElement("magnetic_field"); field && field->GetExplicitlySetInFile()) {
      scene.environment.magnetic_field = field->Get<Vector3>();
    }
    if (world.Scene() != nullptr) read_surroundings(*world.Scene(), scene.environment);
    if (const auto* place = world.SphericalCoordinates()) read_origin(*place, scene.environment.origin);
    tell_left_out(world);
    std::vector<Light> lights;
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      const sdf::Light& light = *world.LightByIndex(i);
      lights.push_back(read_light(light, reading_.resolved(light, "/" + light.Name())));
    }
    if (!lights.empty()) scene.environment.lights = lights;
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      if (model.Static() && model.LinkCount() == 0 && model.ModelCount() == 0) {
        SceneReading::warn(source_of(model.Element()), "/" + model.Name(), "has no link and is left out");
        continue;
      }
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
