// SPDX-License-Identifier: BSD-3-Clause
#include "scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "checks.hpp"
#include "describe.hpp"
#include "joints/joint.hpp"
#include "sensors/sensor_check.hpp"

namespace bubblesim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Collects problems; knows which object it looks at.
class SceneChecker {
 public:
  void check_scene(const SceneDescription& scene) {
    at(scene.source, "");
    require(scene.physics_step >= kMinPhysicsStep && scene.physics_step <= kMaxPhysicsStep, "the physics step",
            text(scene.physics_step), "1e-5 to 1 s");
    require(scene.time_step >= 1e-4 && scene.time_step <= 10, "the time step of a pass", text(scene.time_step),
            "1e-4 to 10 s");
    const double substeps = scene.time_step / scene.physics_step;
    require(!problems_.empty() || (substeps > 0.5 && std::abs(substeps - std::round(substeps)) < 1e-6),
            "the time step of a pass", text(scene.time_step) + " s",
            "a whole number of physics steps (" + text(scene.physics_step) + " s)");
    require(within(scene.gravity, 1e4), "gravity", text(scene.gravity), "finite and at most 1e4 m/s^2");
    check_environment(scene.environment);
    for (const ModelDescription& model : scene.models) check_model(model);
  }

  void check_model(const ModelDescription& model) {
    at(model.source, "/" + model.name);
    check_name(model.name);
    check_pose(model.pose);
    if (model.links.empty()) report("has no link, so there is nothing to simulate; add a <link>");
    std::set<std::string> names;
    const auto once = [&](const Source& source, const std::string& name) {
      at(source, "/" + model.name + "/" + name);
      if (!names.insert(name).second) report("the name '" + name + "' is used twice in this model");
    };
    for (const LinkDescription& link : model.links) {
      once(link.source, link.name);
      check_link(model, link);
    }
    for (const JointDescription& joint : model.joints) {
      once(joint.source, joint.name);
      check_joint(model, joint);
    }
    at(model.source, "/" + model.name);
    if (!model.canonical_link.empty()) check_link_name(model, model.canonical_link, "canonical link");
  }

  std::vector<Problem> found() { return std::move(problems_); }

 private:
  void at(const Source& source, std::string object) {
    source_ = source;
    object_ = std::move(object);
  }

  void report(std::string message) { problems_.push_back({source_.file, source_.line, object_, std::move(message)}); }

  void require(bool fine, const std::string& what, const std::string& found, const std::string& wanted) {
    if (!fine) report(what + " is " + found + ", it must be " + wanted);
  }

  void check_pose(const Pose& pose) {
    require(within(pose.Pos(), kMaxDistance), "the position", text(pose.Pos()), "finite and within 1e6 m");
    const Quaternion& q = pose.Rot();
    const double norm = std::sqrt(q.W() * q.W() + q.X() * q.X() + q.Y() * q.Y() + q.Z() * q.Z());
    require(within(norm - 1, 1e-3), "the orientation (x, y, z, w)", text(q), "a rotation");
  }

  /// Paths must be able to tell it.
  void check_name(const std::string& name) {
    if (name.empty()) report("the model has no name");
    if (name.find('/') != std::string::npos) report("the name holds a '/', which separates names in paths");
  }

  void check_link(const ModelDescription& model, const LinkDescription& link) {
    const std::string path = "/" + model.name + "/" + link.name;
    check_pose(link.pose);
    if (!model.is_static) {
      require(link.mass > 0 && link.mass <= 1e6, "the mass", text(link.mass) + " kg", "above 0 and at most 1e6 kg");
      check_inertia(link);
    }
    for (const CollisionDescription& collision : link.collisions) {
      at(collision.source, path + "/" + collision.name);
      check_pose(collision.pose);
      check_geometry(model, collision.geometry);
      require(collision.surface.mu >= 0, "the friction mu", text(collision.surface.mu), "0 or more");
    }
    for (const VisualDescription& visual : link.visuals) {
      at(visual.source, path + "/" + visual.name);
      check_pose(visual.pose);
      check_geometry(model, visual.geometry);
      check_material(visual.material);
      require(visual.laser_retro >= 0 && within(visual.laser_retro, 1e6), "the laser retro", text(visual.laser_retro),
              "0 or more");
    }
    for (const SensorDescription& sensor : link.sensors) {
      at(sensor.source, path + "/" + sensor.name);
      check_a_sensor(sensor);
      if (const auto* contact = std::get_if<ContactDescription>(&sensor.kind)) check_collisions(link, *contact);
      if (std::holds_alternative<ForceTorqueDescription>(sensor.kind)) {
        report("a force_torque sensor feels what a joint transmits: put it into a <joint>");
      }
    }
  }

  void check_a_sensor(const SensorDescription& sensor) {
    check_pose(sensor.pose);
    check_sensor(sensor, [this](bool fine, const std::string& what, const std::string& found,
                                const std::string& wanted) { require(fine, what, found, wanted); });
  }

  void check_collisions(const LinkDescription& link, const ContactDescription& contact) {
    std::vector<std::string> names;
    for (const CollisionDescription& collision : link.collisions) names.push_back(collision.name);
    for (const std::string& name : contact.collisions) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      report("the collision '" + name + "' is none of this link" + did_you_mean(name, names));
    }
  }

  void check_inertia(const LinkDescription& link) {
    const Vector3& d = link.inertia_diagonal;
    const Vector3& p = link.inertia_products;  // xy, xz, yz
    require(within(link.centre_of_mass, kMaxSize), "the centre of mass", text(link.centre_of_mass), "finite");
    // Sylvester's criterion: a symmetric matrix is positive definite when its leading minors are positive.
    const double minor2 = d.X() * d.Y() - p.X() * p.X();
    const double determinant = d.X() * (d.Y() * d.Z() - p.Z() * p.Z()) - p.X() * (p.X() * d.Z() - p.Z() * p.Y()) +
                               p.Y() * (p.X() * p.Z() - d.Y() * p.Y());
    require(within(d, 1e9) && within(p, 1e9) && d.X() > 0 && minor2 > 0 && determinant > 0, "the inertia",
            "ixx iyy izz " + text(d) + ", ixy ixz iyz " + text(p), "a positive definite matrix");
  }

  void check_length(const char* what, double value) {
    require(value > 0 && value <= kMaxSize, what, text(value) + " m", "above 0 and at most 1e5 m");
  }

  void check_geometry(const ModelDescription& model, const Geometry& geometry) {
    if (const auto* box = std::get_if<Box>(&geometry)) {
      check_length("the box's x size", box->size.X());
      check_length("the box's y size", box->size.Y());
      check_length("the box's z size", box->size.Z());
    } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
      check_length("the sphere's radius", sphere->radius);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
      check_length("the cylinder's radius", cylinder->radius);
      check_length("the cylinder's length", cylinder->length);
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
      check_length("the capsule's radius", capsule->radius);
      check_length("the capsule's length", capsule->length);
    } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry)) {
      check_length("the ellipsoid's x radius", ellipsoid->radii.X());
      check_length("the ellipsoid's y radius", ellipsoid->radii.Y());
      check_length("the ellipsoid's z radius", ellipsoid->radii.Z());
    } else if (const auto* mesh = std::get_if<Mesh>(&geometry)) {
      if (mesh->triangles == nullptr) report("the mesh has no triangles");
    } else if (const auto* plane = std::get_if<Plane>(&geometry)) {
      require(within(plane->normal, 1e6) && plane->normal.Length() > 1e-9, "the plane's normal", text(plane->normal),
              "a direction");
      if (!model.is_static) report("a plane is infinite and cannot move; make the model <static>true</static>");
    }
  }

  void check_color(const char* what, const Color& color) {
    const auto fine = [](float part) { return part >= 0 && part <= 1; };
    require(fine(color.r) && fine(color.g) && fine(color.b), what, text(Vector3(color.r, color.g, color.b)),
            "red, green and blue from 0 to 1");
  }

  void check_material(const Material& material) {
    check_color("the diffuse colour", material.diffuse);
    check_color("the emissive colour", material.emissive);
    check_color("the checker's colour", material.checker_color);
    require(material.checker_size >= 0 && within(material.checker_size, kMaxSize), "the checker's size",
            text(material.checker_size) + " m", "0 (no checker) to 1e5 m");
  }

  void check_environment(const Environment& environment) {
    check_color("the ambient light", environment.ambient);
    check_color("the background", environment.background);
    for (const Light& light : environment.lights) {
      check_color("the light's colour", light.diffuse);
      require(within(light.direction, 1e6) && light.direction.Length() > 1e-9, "the light's direction",
              text(light.direction), "a direction");
      require(within(light.position, kMaxDistance), "the light's position", text(light.position),
              "finite and within 1e6 m");
      require(light.range >= 0, "the light's range", text(light.range) + " m", "0 or more");
      const double weakest =
          std::min({light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation});
      require(weakest >= 0, "the light's attenuation", text(weakest), "0 or more");
      require(light.falloff >= 0, "the light's falloff", text(light.falloff), "0 or more");
    }
    const GeographicOrigin& origin = environment.origin;
    require(within(origin.latitude, 90), "the latitude", text(origin.latitude), "-90 to 90 degrees");
    require(within(origin.longitude, 180), "the longitude", text(origin.longitude), "-180 to 180 degrees");
    require(within(origin.elevation, kMaxSize), "the elevation", text(origin.elevation) + " m", "at most 1e5 m");
    require(within(origin.heading, 2 * M_PI), "the heading", text(origin.heading) + " rad", "a turn at most");
  }

  void check_link_name(const ModelDescription& model, const std::string& name, const std::string& role) {
    std::vector<std::string> names;
    for (const LinkDescription& link : model.links) {
      if (link.name == name) return;
      names.push_back(link.name);
    }
    report("the " + role + " '" + name + "' is no link of this model" + did_you_mean(name, names));
  }

  void check_joint(const ModelDescription& model, const JointDescription& joint) {
    check_pose(joint.pose);
    if (joint.parent != "world") check_link_name(model, joint.parent, "parent");
    check_link_name(model, joint.child, "child");
    if (joint.parent == joint.child) report("connects the link '" + joint.parent + "' with itself");
    std::vector<std::string> types;
    const JointKind* kind = nullptr;
    for (const JointKind& known : joint_kinds()) {
      types.emplace_back(known.type);
      if (joint.type == known.type) kind = &known;
    }
    if (kind == nullptr) {
      std::string list;
      for (const std::string& type : types) list += (list.empty() ? "" : ", ") + type;
      report("joints of type '" + joint.type + "' are not supported; supported are " + list);
      return;
    }
    require(static_cast<int>(joint.axes.size()) == kind->axes, "the number of axes", std::to_string(joint.axes.size()),
            std::to_string(kind->axes) + " for a " + joint.type + " joint");
    for (const AxisDescription& axis : joint.axes) check_axis(axis);
    for (const SensorDescription& sensor : joint.sensors) {
      at(sensor.source, "/" + model.name + "/" + joint.name + "/" + sensor.name);
      check_a_sensor(sensor);
      if (std::holds_alternative<ForceTorqueDescription>(sensor.kind)) continue;
      report("a joint carries sensors of the type force_torque only: put this one into a <link>");
    }
    at(joint.source, "/" + model.name + "/" + joint.name);
    if (joint.type == "revolute2" && joint.axes.size() == 2) {
      if (joint.parent == "world") report("a revolute2 joint needs a link as its parent, not the world");
      const double parallel = joint.axes[0].direction.Cross(joint.axes[1].direction).Length();
      if (std::isfinite(joint.axes[1].lower) || std::isfinite(joint.axes[1].upper)) {
        report("the second axis of a revolute2 joint turns freely: it cannot have limits");
      }
      require(parallel > 1e-3, "the second axis", text(joint.axes[1].direction), "not parallel to the first");
    }
  }

  void check_axis(const AxisDescription& axis) {
    require(within(axis.direction.Length() - 1, 1e-3), "the axis", text(axis.direction), "a direction other than zero");
    require(axis.lower <= axis.upper, "the lower limit", text(axis.lower),
            "at most the upper limit " + text(axis.upper));
    for (const double limit : {axis.lower, axis.upper}) {
      require(!std::isfinite(limit) || within(limit, kMaxDistance), "the limit", text(limit),
              "infinite or at most 1e6");
    }
    require(axis.lower < kInfinity && axis.upper > -kInfinity, "the range of limits",
            text(axis.lower) + " to " + text(axis.upper), "one that can be reached");
    require(axis.max_force >= 0, "the effort limit", text(axis.max_force), "0 or more");
    require(axis.max_velocity > 0, "the velocity limit", text(axis.max_velocity), "above 0");
    require(axis.friction >= 0 && within(axis.friction, 1e9), "the friction", text(axis.friction), "0 or more");
    require(axis.damping >= 0 && within(axis.damping, 1e9), "the damping", text(axis.damping), "0 or more");
  }

  Source source_;
  std::string object_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> check_scene(const SceneDescription& scene) {
  SceneChecker checker;
  checker.check_scene(scene);
  return checker.found();
}

std::vector<Problem> check_model(const ModelDescription& model) {
  SceneChecker checker;
  checker.check_model(model);
  return checker.found();
}

}  // namespace bubblesim
