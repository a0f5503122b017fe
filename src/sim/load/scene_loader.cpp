// SPDX-License-Identifier: BSD-3-Clause
// Reads SDFormat through its DOM and reports all problems of a file.
#include "bubblesim/scene_loader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <sdf/Exception.hh>
#include <sdf/sdf.hh>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "check/checks.hpp"
#include "check/scene_check.hpp"
#include "load/find/model_folders.hpp"
#include "load/find/scene_folders.hpp"
#include "load/load_context.hpp"
#include "load/parser_messages.hpp"
#include "load/scene_limits.hpp"
#include "load/scene_text.hpp"
#include "load/sdf/sdf_document.hpp"
#include "load/sdf/sdf_left_out.hpp"
#include "load/sdf/sdf_models.hpp"
#include "load/sdf/sdf_names_and_axes.hpp"
#include "load/sdf/sdf_plugins.hpp"
#include "load/sdf/sdf_randomize.hpp"
#include "load/sdf/sdf_repairs.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf/sdf_state.hpp"
#include "load/sdf/sdf_visuals.hpp"
#include "load/sdf_extensions.hpp"
#include "load/substeps.hpp"
#include "load/urdf/urdf_reading.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

// SDFormat's name of a text without a file.
constexpr const char* kText = "<data-string>";
constexpr const char* kGroundPlane = "ground_plane";
constexpr const char* kOnDivergence = "bubblesim:on_divergence";

/// The reason: the message of an assertion has it in one of several lines, after the source location in SDFormat.
std::string reason_of(const sdf::Exception& error) {
  const std::string text = error.GetErrorStr();
  static const std::regex assertion("Error *: *([^\n]*)");
  std::smatch match;
  if (std::regex_search(text, match, assertion)) return match.str(1);
  return text.substr(0, text.find('\n'));
}

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

class SceneLoader {
 public:
  explicit SceneLoader(const fs::path& file) : reading_(file) {}
  /// `name` is the text's name in errors; its files are in `folder`.
  SceneLoader(const std::string& text, const std::string& name, const fs::path& folder)
      : reading_(text, name, folder) {}

  /// Loads the file, or `text` in its place.
  SceneDescription load_scene(const fs::path& file, const std::optional<SceneText>& text) {
    sdf::Root root;
    parse(
        [&](const sdf::ParserConfig& config, const std::optional<std::string>& repaired) {
          if (repaired) return load_document_text(root, *repaired, config);
          return text ? load_document_text(root, text->text, config) : load_document(root, file, config);
        },
        root);
    SceneDescription scene;
    scene.name = scene.world_name = file.stem().string();
    scene.file = file;
    read_own_elements(root);
    if (root.WorldCount() > 0) {
      read_world(*root.WorldByIndex(0), scene);
      if (root.WorldCount() > 1) {
        reading_.report(source_of(root.WorldByIndex(1)->Element()), "",
                        "a scene must have exactly one <world>: remove the others");
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
      problems_.push_back({file.string(), 0, "", "contains neither a <world> nor a <model>"});
    }
    // Values that SDFormat could not read have their defaults: checking those would only hide the cause.
    if (is_read_ || root.WorldCount() > 0) {
      for (Problem& problem : check_scene(scene)) problems_.push_back(std::move(problem));
    }
    if (problems_.empty()) divide_substep(scene, substeps_, reading_);
    fail_with_problems();
    return scene;
  }

  ModelDescription load_model(const std::string& text) {
    sdf::Root root;
    parse(
        [&](const sdf::ParserConfig& config, const std::optional<std::string>& repaired) {
          return load_document_text(root, repaired.value_or(text), config);
        },
        root);
    read_own_elements(root);
    ModelDescription model;
    if (root.Model() != nullptr) {
      model = read_root_model(root);
    } else if (problems_.empty()) {
      problems_.push_back(
          {kText, 0, "", root.WorldCount() > 0 ? "contains a <world>: expected a <model>" : "contains no <model>"});
    }
    if (is_read_ && root.Model() != nullptr) {
      for (Problem& problem : check_model(model)) problems_.push_back(std::move(problem));
    }
    fail_with_problems();
    return model;
  }

  std::vector<Problem>& warnings() { return reading_.warnings(); }

 private:
  void fail_with_problems() {
    if (!problems_.empty()) throw SceneError(std::move(problems_), std::move(warnings()));
  }

  sdf::ParserConfig parser_config() const {
    sdf::ParserConfig config;
    config.SetFindCallback([this](const std::string& uri) { return find_model(uri, reading_.folder()).string(); });
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);  // so that they are reported
    return config;
  }

  template <class Load>
  void parse(const Load& load, sdf::Root& root) {
    std::vector<std::string> included;
    try {
      {
        const ParserMessages unused;
        included = check_limits(reading_.xml(), parser_config());
      }
      const bool is_urdf = reading_.xml().is_urdf();
      SdfRepairs repairs(reading_);
      std::optional<std::string> repaired;
      {
        const ParserMessages unused;  // hides messages about values that are tried
        repaired = is_urdf ? prepared_urdf(reading_) : repairs.repaired_scene();
      }
      const ParserMessages messages;
      const sdf::Errors errors =
          is_urdf ? load_urdf(root, parser_config(), *repaired) : load(parser_config(), repaired);
      const bool failed = root.Model() == nullptr && root.Light() == nullptr && root.WorldCount() == 0;
      const std::size_t known = problems_.size();
      take_messages(is_urdf ? messages.of_urdf() : std::vector<std::string>{}, failed);
      if (problems_.size() == known) reading_.take(errors, "");
      is_read_ = problems_.size() == known;
      take_messages(messages.of_sdformat(), false);
    } catch (const SceneError&) {
      throw;
    } catch (const sdf::Exception& error) {  // failed assertions
      reading_.report({file_that_fails(included), 0}, "", "SDFormat cannot read it: " + reason_of(error));
    } catch (const std::exception& error) {  // unexpected numbers
      reading_.report({file_that_fails(included), 0}, "", std::string("SDFormat cannot read it: ") + error.what());
    }
  }

  /// Returns the included file that makes SDFormat fail on its own, or the file itself.
  std::string file_that_fails(const std::vector<std::string>& included) const {
    const ParserMessages silence;
    for (const std::string& file : included) {
      try {
        sdf::Root root;
        load_document(root, file, parser_config());
      } catch (const sdf::Exception&) {
        return file;
      } catch (const std::exception&) {
        return file;
      }
    }
    return reading_.xml().file();
  }

  /// Handles SDFormat's messages that are not among its errors: problems if reading failed, else warnings.
  void take_messages(const std::vector<std::string>& messages, bool failed) {
    const Source file{reading_.xml().file(), 0};
    for (const std::string& message : messages) {
      if (failed) reading_.report(file, "", message);
      if (!failed && problems_.empty()) reading_.warn(file, "", message);
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

  /// The longest step of whole physics substeps that does not exceed the default, or a single substep.
  static void fit_time_step(SceneDescription& scene) {
    if (!(scene.substep >= kMinPhysicsStep && scene.substep <= kMaxPhysicsStep)) return;  // reported later
    const double steps = scene.time_step / scene.substep;
    const bool fits = std::abs(steps - std::round(steps)) < 1e-6;
    if (!fits) scene.time_step = scene.substep * std::max(1.0, std::floor(steps + 1e-6));
  }

  void read_world(const sdf::World& world, SceneDescription& scene) {
    scene.source = source_of(world.Element());
    if (!world.Name().empty()) scene.world_name = world.Name();
    scene.plugins = read_plugins(world.Element());
    scene.randomized = read_randomized(world.Element(), reading_);
    scene.gravity = world.Gravity();
    if (const sdf::Physics* physics = world.PhysicsDefault()) {
      scene.substep = physics->MaxStepSize();
      substeps_ = read_substeps(*physics, reading_);
    }
    if (const auto step = own_number(world.Element(), "bubblesim:time_step", problems_)) {
      scene.time_step = *step;
    } else {
      fit_time_step(scene);
    }
    reading_.axes() = read_axis_convention(world.Element(), "", reading_);
    if (const auto policy = own_text(world.Element(), kOnDivergence)) read_policy(*policy, world, scene);
    // SDFormat rounds its default to 1e-6.
    if (const auto field = world.Element()->FindElement("magnetic_field"); field && field->GetExplicitlySetInFile()) {
      scene.environment.magnetic_field = field->Get<Vector3>();
    }
    scene.environment.wind = world.WindLinearVelocity();
    if (world.Scene() != nullptr) read_surroundings(*world.Scene(), scene.environment);
    if (const auto* place = world.SphericalCoordinates()) read_origin(*place, scene.environment.origin);
    report_left_out(world.Element(), "", reading_);
    std::vector<Light> lights;
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      const sdf::Light& light = *world.LightByIndex(i);
      const Pose pose = reading_.resolved(light, "/" + light.Name());
      lights.push_back(read_light(light, state_pose(world, "light", light.Name()).value_or(pose)));
    }
    if (!lights.empty()) scene.environment.lights = lights;
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      if (model.Static() && model.LinkCount() == 0 && model.ModelCount() == 0) {
        reading_.warn(source_of(model.Element()), "/" + model.Name(), "has no link: ignored");
        continue;
      }
      scene.models.push_back(read_model(model, reading_.resolved(model, "/" + model.Name()), reading_));
    }
    apply_state(world, scene.models, reading_);
  }

  LoadContext reading_;
  std::optional<double> substeps_ = 1;  // for each <max_step_size>; empty for those that the models need
  std::vector<Problem>& problems_ = reading_.problems();
  bool is_read_ = false;  // SDFormat found no errors
};

void append(std::vector<Problem>* all, const std::vector<Problem>& found) {
  if (all != nullptr) all->insert(all->end(), found.begin(), found.end());
}

/// Calls `load` and converts its exceptions to a SceneError of the file.
template <class Load>
auto telling_of(const std::string& file, const Load& load) {
  try {
    return load();
  } catch (const SceneError&) {
    throw;
  } catch (const sdf::Exception& error) {
    throw SceneError({{file, 0, "", "SDFormat cannot read it: " + reason_of(error)}});
  } catch (const std::exception& error) {
    throw SceneError({{file, 0, "", std::string("cannot be read: ") + error.what()}});
  }
}

}  // namespace

SceneDescription read_scene(const std::string& name_or_path, const XacroArguments& arguments,
                            std::vector<Problem>* warnings) {
  const fs::path file = find_scene(name_or_path);
  check_size(file);
  return telling_of(file.string(), [&] {
    const std::optional<SceneText> text = scene_text(file, arguments);
    SceneLoader loader = text ? SceneLoader(text->text, text->name, file.parent_path()) : SceneLoader(file);
    SceneDescription scene = loader.load_scene(file, text);
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
  return telling_of(kText, [&] {
    SceneLoader loader(text, kText, folder);
    ModelDescription model = loader.load_model(text);
    append(warnings, loader.warnings());
    return model;
  });
}

}  // namespace bubblesim
