// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "bubblesim/error.hpp"
#include "bubblesim/urdf.hpp"

namespace bubblesim {
namespace {

constexpr double kNoLimit = 1e9;  // URDF requires a number

std::string number(double value) {
  std::ostringstream out;
  out.precision(12);
  out << (std::abs(value) < 1e-12 ? 0.0 : value);
  return out.str();
}

std::string numbers(const Vector3& v) { return number(v.X()) + " " + number(v.Y()) + " " + number(v.Z()); }

/// Whether URDF has an element for the geometry.
bool writable(const Geometry& geometry) {
  return std::holds_alternative<Box>(geometry) || std::holds_alternative<Sphere>(geometry) ||
         std::holds_alternative<Cylinder>(geometry);
}

class UrdfWriter {
 public:
  explicit UrdfWriter(const ModelDescription& model) : model_(model) {
    for (const JointDescription& joint : model.joints) {
      if (joint.parent == "world") continue;
      if (!parent_joint_.emplace(joint.child, &joint).second) {
        throw InvalidInput("/" + model.name + "/" + joint.child +
                           " is the child of two joints: URDF supports trees only");
      }
    }
  }

  std::string write() {
    const auto roots = std::count_if(model_.links.begin(), model_.links.end(),
                                     [this](const LinkDescription& link) { return is_root(link); });
    if (roots != 1) {
      throw InvalidInput("/" + model_.name + " has " + std::to_string(roots) +
                         " root links: URDF supports trees only, with one root link");
    }
    xml_.OpenElement("robot");
    xml_.PushAttribute("name", model_.name.c_str());
    for (const LinkDescription& link : model_.links) write_link(link);
    for (const JointDescription& joint : model_.joints) {
      if (joint.parent != "world") write_joint(joint);
    }
    xml_.CloseElement();
    return xml_.CStr();
  }

 private:
  bool is_root(const LinkDescription& link) const { return parent_joint_.count(link.name) == 0; }

  const LinkDescription& link(const std::string& name) const {
    return *std::find_if(model_.links.begin(), model_.links.end(),
                         [&](const LinkDescription& each) { return each.name == name; });
  }

  void element(const char* name, const char* attribute, const std::string& value) {
    xml_.OpenElement(name);
    xml_.PushAttribute(attribute, value.c_str());
    xml_.CloseElement();
  }

  void origin(const Pose& pose) {
    xml_.OpenElement("origin");
    xml_.PushAttribute("xyz", numbers(pose.Pos()).c_str());
    xml_.PushAttribute("rpy", numbers(pose.Rot().Euler()).c_str());
    xml_.CloseElement();
  }

  void write_geometry(const Geometry& geometry) {
    xml_.OpenElement("geometry");
    if (const auto* box = std::get_if<Box>(&geometry)) {
      element("box", "size", numbers(box->size));
    } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
      element("sphere", "radius", number(sphere->radius));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
      xml_.OpenElement("cylinder");
      xml_.PushAttribute("radius", number(cylinder->radius).c_str());
      xml_.PushAttribute("length", number(cylinder->length).c_str());
      xml_.CloseElement();
    }
    xml_.CloseElement();
  }

  void write_inertial(const LinkDescription& link) {
    xml_.OpenElement("inertial");
    origin(Pose(link.centre_of_mass, Quaternion::Identity));
    element("mass", "value", number(link.mass));
    xml_.OpenElement("inertia");
    xml_.PushAttribute("ixx", number(link.inertia_diagonal.X()).c_str());
    xml_.PushAttribute("iyy", number(link.inertia_diagonal.Y()).c_str());
    xml_.PushAttribute("izz", number(link.inertia_diagonal.Z()).c_str());
    xml_.PushAttribute("ixy", number(link.inertia_products.X()).c_str());
    xml_.PushAttribute("ixz", number(link.inertia_products.Y()).c_str());
    xml_.PushAttribute("iyz", number(link.inertia_products.Z()).c_str());
    xml_.CloseElement();
    xml_.CloseElement();
  }

  template <class Shape>
  void write_shape(const char* kind, const Shape& shape) {
    xml_.OpenElement(kind);
    xml_.PushAttribute("name", shape.name.c_str());
    origin(shape.pose);
    write_geometry(shape.geometry);
  }

  void write_link(const LinkDescription& link) {
    xml_.OpenElement("link");
    xml_.PushAttribute("name", link.name.c_str());
    if (!is_root(link)) write_inertial(link);
    for (const VisualDescription& visual : link.visuals) {
      if (!writable(visual.geometry)) continue;
      write_shape("visual", visual);
      const Color& color = visual.material.diffuse;
      xml_.OpenElement("material");
      xml_.PushAttribute("name", (link.name + "_" + visual.name).c_str());
      element("color", "rgba", numbers(Vector3(color.r, color.g, color.b)) + " 1");
      xml_.CloseElement();
      xml_.CloseElement();
    }
    for (const CollisionDescription& collision : link.collisions) {
      if (!writable(collision.geometry)) continue;
      write_shape("collision", collision);
      xml_.CloseElement();
    }
    xml_.CloseElement();
    for (const SensorDescription& sensor : link.sensors) {
      write_frame(sensor.name, link.name, sensor.pose);
      if (!std::holds_alternative<CameraDescription>(sensor.kind)) continue;
      write_frame(sensor.name + "_optical", sensor.name, Pose(0, 0, 0, -M_PI / 2, 0, -M_PI / 2));
    }
  }

  /// A link without inertia, fixed to another link.
  void write_frame(const std::string& name, const std::string& parent, const Pose& pose) {
    element("link", "name", name);
    open_joint(name + "_mount", "fixed", parent, name, pose);
    xml_.CloseElement();
  }

  void open_joint(const std::string& name, const char* type, const std::string& parent, const std::string& child,
                  const Pose& pose) {
    xml_.OpenElement("joint");
    xml_.PushAttribute("name", name.c_str());
    xml_.PushAttribute("type", type);
    origin(pose);
    element("parent", "link", parent);
    element("child", "link", child);
  }

  /// In URDF the frame of a link is that of its joint. Other links are attached to an extra link in between.
  void write_joint(const JointDescription& joint) {
    const bool moves = joint.type == "revolute" || joint.type == "continuous" || joint.type == "prismatic";
    if (!moves && joint.type != "fixed") {
      throw InvalidInput("/" + model_.name + "/" + joint.name + ": URDF has no joints of type " + joint.type);
    }
    const Pose& parent = link(joint.parent).pose;
    const Pose& child = link(joint.child).pose;
    for (const SensorDescription& sensor : joint.sensors) {
      write_frame(sensor.name, joint.child, child.Inverse() * joint.pose * sensor.pose);
    }
    if (!moves) {
      open_joint(joint.name, "fixed", joint.parent, joint.child, parent.Inverse() * child);
      xml_.CloseElement();
      return;
    }
    const Pose rest = joint.pose.Inverse() * child;
    const bool direct = rest.Pos().Length() < 1e-9 && std::abs(rest.Rot().W()) > 1 - 1e-12;
    const std::string carried = direct ? joint.child : joint.name + "_frame";
    const AxisDescription& axis = joint.axes.at(0);
    const bool endless = !std::isfinite(axis.lower) && !std::isfinite(axis.upper) && joint.type != "prismatic";
    open_joint(joint.name, endless ? "continuous" : joint.type.c_str(), joint.parent, carried,
               parent.Inverse() * joint.pose);
    element("axis", "xyz", numbers(axis.direction));
    xml_.OpenElement("limit");
    if (!endless) {
      xml_.PushAttribute("lower", number(std::max(axis.lower, -kNoLimit)).c_str());
      xml_.PushAttribute("upper", number(std::min(axis.upper, kNoLimit)).c_str());
    }
    xml_.PushAttribute("effort", number(std::min(axis.max_force, kNoLimit)).c_str());
    xml_.PushAttribute("velocity", number(std::min(axis.max_velocity, kNoLimit)).c_str());
    xml_.CloseElement();
    xml_.CloseElement();
    if (direct) return;
    element("link", "name", carried);
    open_joint(joint.name + "_mount", "fixed", carried, joint.child, rest);
    xml_.CloseElement();
  }

  const ModelDescription& model_;
  std::map<std::string, const JointDescription*> parent_joint_;  // by the child's name
  tinyxml2::XMLPrinter xml_;
};

}  // namespace

std::string to_urdf(const ModelDescription& model) { return UrdfWriter(model).write(); }

}  // namespace bubblesim
