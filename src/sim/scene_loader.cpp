// SPDX-License-Identifier: BSD-3-Clause
// Reads SDFormat through its own DOM and reports all that is wrong with a file at once.
#include "bubblesim/scene_loader.hpp"

#include <cmath>
#include <sdf/sdf.hh>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/nearest_names.hpp"
#include "model_folders.hpp"
#include "own_elements.hpp"
#include "scene_check.hpp"
#include "scene_folders.hpp"
#include "scene_xml.hpp"
#include "sdf_sensors.hpp"
#include "sdf_source.hpp"
#include "sdf_visuals.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kChildScript = "bubblesim:child_script";
constexpr double kThin = 1e-3;  // m, of a plane that can move and thus ends somewhere
// SDFormat writes a limit that does not exist as +-1e16.
constexpr double kNoLimit = 1e15;
// What SDFormat calls a text that came from no file.
constexpr const char* kText = "<data-string>";

Quaternion turn_from_z(const Vector3& direction) {
  Quaternion turn;
  turn.From2Axes(Vector3::UnitZ, direction);
  return turn;
}

const char* sdf_type(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::BALL:
      return "ball";
    case sdf::JointType::CONTINUOUS:
      return "continuous";
    case sdf::JointType::FIXED:
      return "fixed";
    case sdf::JointType::GEARBOX:
      return "gearbox";
    case sdf::JointType::PRISMATIC:
      return "prismatic";
    case sdf::JointType::REVOLUTE:
      return "revolute";
    case sdf::JointType::REVOLUTE2:
      return "revolute2";
    case sdf::JointType::SCREW:
      return "screw";
    case sdf::JointType::UNIVERSAL:
      return "universal";
    case sdf::JointType::INVALID:
      break;
  }
  return "invalid";
}

class SceneLoader {
 public:
  explicit SceneLoader(const fs::path& file) : folder_(file.parent_path()), xml_(file) {}
  SceneLoader(const std::string& text, fs::path folder) : folder_(std::move(folder)), xml_(text, kText) {}

  SceneDescription load_scene(const fs::path& file) {
    sdf::Root root;
    take(root.Load(file.string(), parser_config()), "");
    SceneDescription scene;
    scene.name = file.stem().string();
    scene.file = file;
    read_own_elements(root);
    if (root.WorldCount() > 0) {
      read_world(*root.WorldByIndex(0), scene);
      if (root.WorldCount() > 1) {
        report(source_of(root.WorldByIndex(1)->Element()), "", "a scene is one <world>: take the others out");
      }
    } else if (root.Model() != nullptr) {
      scene.models.push_back(ground_plane());
      scene.models.push_back(read_model(*root.Model(), root.Model()->RawPose()));
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
    take(root.LoadSdfString(text, parser_config()), "");
    read_own_elements(root);
    ModelDescription model;
    if (root.Model() != nullptr) {
      model = read_model(*root.Model(), root.Model()->RawPose());
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
    config.SetFindCallback([this](const std::string& uri) { return find_model(uri, folder_).string(); });
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
    return config;
  }

  void read_own_elements(const sdf::Root& root) {
    if (root.Element() == nullptr) return;
    xml_.place_elements(root.Element());
    check_own_elements(root.Element(), problems_);
  }

  void take(const sdf::Errors& errors, const std::string& object) {
    // Once a joint or frame names something that does not exist, nothing around it can be resolved: one error is
    // enough.
    if (!object.empty() && frames_broken_) return;
    if (object.empty() && !errors.empty()) frames_broken_ = true;
    for (Problem& problem : xml_.located(errors, object)) {
      if (problem.message.rfind("Unable to find uri[", 0) == 0) problem.message += where_models_are();
      problems_.push_back(std::move(problem));
    }
  }

  std::string where_models_are() const {
    std::string folders;
    for (const fs::path& folder : model_folders(folder_)) folders += " " + folder.string();
    return " (searched in" + folders + "; BUBBLESIM_MODEL_PATH adds folders)";
  }

  void report(const Source& source, const std::string& object, std::string message) {
    problems_.push_back({source.file, source.line, object, std::move(message)});
  }

  template <class T>
  Pose resolved(const T& element, const std::string& object, const std::string& frame = "") {
    Pose pose;
    take(element.SemanticPose().Resolve(pose, frame), object);
    return pose;
  }

  static ModelDescription ground_plane() {
    CollisionDescription plane;
    plane.name = "collision";
    plane.geometry = Plane{};
    LinkDescription link;
    link.name = "link";
    link.collisions.push_back(plane);
    ModelDescription model;
    model.name = "ground_plane";
    model.is_static = true;
    model.links.push_back(link);
    return model;
  }

  void read_world(const sdf::World& world, SceneDescription& scene) {
    scene.source = source_of(world.Element());
    scene.gravity = world.Gravity();
    if (const sdf::Physics* physics = world.PhysicsDefault()) scene.physics_step = physics->MaxStepSize();
    if (const auto step = own_number(world.Element(), "bubblesim:time_step", problems_)) scene.time_step = *step;
    if (world.Scene() != nullptr) read_surroundings(*world.Scene(), scene.environment);
    std::vector<DirectionalLight> lights;
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      const sdf::Light& light = *world.LightByIndex(i);
      if (const auto read = read_light(light, resolved(light, "/" + light.Name()))) lights.push_back(*read);
    }
    if (!lights.empty()) scene.environment.lights = lights;
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      scene.models.push_back(read_model(model, resolved(model, "/" + model.Name())));
    }
  }

  /// The file that a model names, beside the file that the model stands in; whoever includes a model may give it
  /// another.
  fs::path read_child_script(const sdf::ElementPtr& model, const std::string& path) {
    const sdf::ElementPtr include = model->GetIncludeElement();
    if (include != nullptr) check_own_elements(include, problems_);
    const bool given_by_include = include != nullptr && own_text(include, kChildScript);
    const sdf::ElementPtr& giver = given_by_include ? include : model;
    const auto name = own_text(giver, kChildScript);
    if (!name) return {};
    const bool of_included_file = include != nullptr && !given_by_include;
    const fs::path file = (of_included_file ? fs::path(model->FilePath()).parent_path() : folder_) / *name;
    const Source source = given_by_include ? xml_.place_of(kChildScript, *name) : source_of(model, kChildScript);
    if (name->empty()) {
      report(source, path, "<" + std::string(kChildScript) + "> names no file");
    } else if (!fs::is_regular_file(file)) {
      report(source, path, "the child script " + file.string() + " does not exist");
    }
    return file;
  }

  ModelDescription read_model(const sdf::Model& model, const Pose& pose) {
    const std::string path = "/" + model.Name();
    ModelDescription description;
    description.name = model.Name();
    description.pose = pose;
    description.is_static = model.Static();
    description.self_collide = model.SelfCollide();
    description.canonical_link = model.CanonicalLinkName();
    description.source = source_of(model.Element());
    description.child_script = read_child_script(model.Element(), path);
    if (model.ModelCount() > 0) report(description.source, path, "models inside a model are not supported");
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      description.links.push_back(read_link(*model.LinkByIndex(i), path, model.Static()));
    }
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
      description.joints.push_back(read_joint(*model.JointByIndex(i), path));
    }
    return description;
  }

  LinkDescription read_link(const sdf::Link& link, const std::string& model_path, bool is_static) {
    const std::string path = model_path + "/" + link.Name();
    LinkDescription description;
    description.name = link.Name();
    description.pose = resolved(link, path);
    description.source = source_of(link.Element());
    const auto& inertial = link.Inertial();
    const ignition::math::Matrix3d inertia = inertial.Moi();
    description.mass = inertial.MassMatrix().Mass();
    description.centre_of_mass = inertial.Pose().Pos();
    description.inertia_diagonal = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
    description.inertia_products = {inertia(0, 1), inertia(0, 2), inertia(1, 2)};
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
      const sdf::Collision& collision = *link.CollisionByIndex(i);
      if (auto read = read_collision(collision, path)) description.collisions.push_back(std::move(*read));
    }
    for (std::uint64_t i = 0; i < link.VisualCount(); ++i)
      read_visual(*link.VisualByIndex(i), path, is_static, description);
    for (std::uint64_t i = 0; i < link.SensorCount(); ++i) {
      const sdf::Sensor& sensor = *link.SensorByIndex(i);
      if (auto read = read_sensor(sensor, path)) description.sensors.push_back(std::move(*read));
    }
    return description;
  }

  std::optional<CollisionDescription> read_collision(const sdf::Collision& collision, const std::string& link_path) {
    CollisionDescription description;
    description.name = collision.Name();
    description.source = source_of(collision.Element());
    const std::string path = link_path + "/" + collision.Name();
    description.pose = resolved(collision, path);
    if (const auto geometry = read_geometry(*collision.Geom())) {
      description.geometry = *geometry;
    } else {
      report(source_of(collision.Element(), "geometry"), path,
             "this geometry is not supported; supported are box, sphere, cylinder, plane");
      return std::nullopt;
    }
    read_surface(collision.Element(), path, description.surface);
    return description;
  }

  /// A visual of a shape that is not supported is replaced by the link's collision shapes, in its colour.
  void read_visual(const sdf::Visual& visual, const std::string& link_path, bool is_static, LinkDescription& link) {
    VisualDescription description;
    description.name = visual.Name();
    description.source = source_of(visual.Element());
    description.material = read_material(visual, problems_);
    description.laser_retro = visual.LaserRetro();
    if (const auto geometry = read_geometry(*visual.Geom())) {
      description.pose = resolved(visual, link_path + "/" + visual.Name());
      description.geometry = *geometry;
      if (const auto* plane = visual.Geom()->PlaneShape(); plane != nullptr && !is_static) {
        description.geometry = Box{{plane->Size().X(), plane->Size().Y(), kThin}};
        description.pose.Rot() = description.pose.Rot() * turn_from_z(plane->Normal());
      }
      link.visuals.push_back(std::move(description));
      return;
    }
    for (const CollisionDescription& collision : link.collisions) {
      description.pose = collision.pose;
      description.geometry = collision.geometry;
      link.visuals.push_back(description);
    }
  }

  void read_surface(const sdf::ElementPtr& collision, const std::string& path, Surface& surface) {
    if (!collision->HasElement("surface")) return;
    const sdf::ElementPtr element = collision->GetElement("surface");
    if (element->HasElement("friction") && element->GetElement("friction")->HasElement("ode")) {
      surface.mu = element->GetElement("friction")->GetElement("ode")->Get<double>("mu", surface.mu).first;
    }
    if (element->HasElement("contact")) {
      const sdf::ElementPtr contact = element->GetElement("contact");
      const auto mask = contact->Get<unsigned int>("collide_bitmask", surface.collide_bitmask).first;
      if (mask > 0xffff) {
        report(source_of(contact, "collide_bitmask"), path,
               "<collide_bitmask> is " + std::to_string(mask) + ", it must be 0 to 65535: there are 16 bits");
      }
      surface.collide_bitmask = static_cast<std::uint16_t>(mask);
    }
  }

  std::optional<SensorDescription> read_sensor(const sdf::Sensor& sensor, const std::string& link_path) {
    const std::string path = link_path + "/" + sensor.Name();
    SensorDescription description;
    description.name = sensor.Name();
    description.source = source_of(sensor.Element());
    description.pose = resolved(sensor, path);
    description.update_rate = sensor.UpdateRate();
    const Report report_here = [&](const Source& source, std::string message) {
      report(source, path, std::move(message));
    };
    if (!read_sensor_kind(sensor, description, report_here)) return std::nullopt;
    return description;
  }

  JointDescription read_joint(const sdf::Joint& joint, const std::string& model_path) {
    const std::string path = model_path + "/" + joint.Name();
    JointDescription description;
    description.name = joint.Name();
    description.type = sdf_type(joint.Type());
    description.source = source_of(joint.Element());
    take(joint.ResolveParentLink(description.parent), path);
    take(joint.ResolveChildLink(description.child), path);
    description.pose = resolved(joint, path, "__model__");
    const bool wants_axes = description.type != "fixed" && description.type != "ball";
    for (unsigned int i = 0; wants_axes && i < 2; ++i) {
      if (joint.Axis(i) != nullptr) description.axes.push_back(read_axis(*joint.Axis(i), joint, path));
    }
    return description;
  }

  AxisDescription read_axis(const sdf::JointAxis& axis, const sdf::Joint& joint, const std::string& path) {
    const auto limit = [](double value, double none) { return std::abs(value) < kNoLimit ? value : none; };
    const double none = std::numeric_limits<double>::infinity();
    AxisDescription description;
    take(axis.ResolveXyz(description.direction, joint.Name()), path);
    if (joint.Type() != sdf::JointType::CONTINUOUS) {
      description.lower = limit(axis.Lower(), -none);
      description.upper = limit(axis.Upper(), none);
    }
    // A negative effort or velocity means that there is no limit.
    description.max_force = axis.Effort() < 0 ? none : limit(axis.Effort(), none);
    description.max_velocity = axis.MaxVelocity() < 0 ? none : limit(axis.MaxVelocity(), none);
    description.friction = axis.Friction();
    description.damping = axis.Damping();
    if (const auto motor = own_text(axis.Element(), "bubblesim:motor")) {
      if (*motor == "velocity") {
        description.motor = MotorMode::kVelocity;
      } else if (*motor == "position") {
        description.motor = MotorMode::kPosition;
      } else {
        report(source_of(axis.Element(), "bubblesim:motor"), path,
               "<bubblesim:motor> is '" + *motor + "', it must be velocity or position" +
                   did_you_mean(*motor, {"velocity", "position"}));
      }
    }
    return description;
  }

  fs::path folder_;  // in which child scripts are
  SceneXml xml_;
  bool frames_broken_ = false;  // SDFormat found errors that are no fault of a single object
  std::vector<Problem> problems_;
};

}  // namespace

SceneDescription load_scene(const std::string& name_or_path) {
  const fs::path file = find_scene(name_or_path);
  return SceneLoader(file).load_scene(file);
}

ModelDescription load_model(const std::string& text, const fs::path& folder) {
  return SceneLoader(text, folder).load_model(text);
}

}  // namespace bubblesim
