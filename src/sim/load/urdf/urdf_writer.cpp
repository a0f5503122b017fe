// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/urdf.hpp"
#include "load/xml/xml_element.hpp"
#include "load/xml/xml_parser.hpp"

namespace bubblesim {
namespace {

constexpr double kNoLimit = 1e9;  // URDF requires a number

std::string number(double value) {
  std::ostringstream out;
  out.precision(12);
  out << (std::abs(value) < 1e-12 ? 0.0 : value);
  return out.str();
}

std::string numbers(const Vector3& v) { return number(v.x()) + " " + number(v.y()) + " " + number(v.z()); }

/// Whether URDF has an element for the geometry.
bool writable(const Geometry& geometry) {
  return std::holds_alternative<Box>(geometry) || std::holds_alternative<Sphere>(geometry) ||
         std::holds_alternative<Cylinder>(geometry);
}

/// An element with attributes.
XmlElement element(const std::string& name, std::vector<XmlAttribute> attributes) {
  XmlElement made;
  made.name = name;
  made.attributes = std::move(attributes);
  return made;
}

XmlElement origin(const Pose& pose) {
  return element("origin", {{"xyz", numbers(pose.position)}, {"rpy", numbers(to_rpy(pose.orientation))}});
}

XmlElement geometry_element(const Geometry& geometry) {
  XmlElement made = element("geometry", {});
  if (const auto* box = std::get_if<Box>(&geometry)) {
    made.children.push_back(element("box", {{"size", numbers(box->size)}}));
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    made.children.push_back(element("sphere", {{"radius", number(sphere->radius)}}));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    made.children.push_back(
        element("cylinder", {{"radius", number(cylinder->radius)}, {"length", number(cylinder->length)}}));
  }
  return made;
}

XmlElement inertial_element(const LinkDescription& link) {
  const Vector3& moments = link.inertia_diagonal;
  const Vector3& products = link.inertia_products;
  XmlElement made = element("inertial", {});
  made.children = {origin(Pose(link.centre_of_mass, Quaternion())), element("mass", {{"value", number(link.mass)}}),
                   element("inertia", {{"ixx", number(moments.x())},
                                       {"iyy", number(moments.y())},
                                       {"izz", number(moments.z())},
                                       {"ixy", number(products.x())},
                                       {"ixz", number(products.y())},
                                       {"iyz", number(products.z())}})};
  return made;
}

template <class Shape>
XmlElement shape_element(const char* kind, const Shape& shape) {
  XmlElement made = element(kind, {{"name", shape.name}});
  made.children = {origin(shape.pose), geometry_element(shape.geometry)};
  return made;
}

XmlElement material_element(const std::string& name, const Color& color) {
  XmlElement made = element("material", {{"name", name}});
  made.children = {element("color", {{"rgba", numbers(Vector3(color.r, color.g, color.b)) + " 1"}})};
  return made;
}

XmlElement joint_element(const std::string& name, const std::string& type, const std::string& parent,
                         const std::string& child, const Pose& pose) {
  XmlElement made = element("joint", {{"name", name}, {"type", type}});
  made.children = {origin(pose), element("parent", {{"link", parent}}), element("child", {{"link", child}})};
  return made;
}

class UrdfWriter {
 public:
  explicit UrdfWriter(const ModelDescription& model) : model_(model), robot_(element("robot", {{"name", model.name}})) {
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
    for (const LinkDescription& link : model_.links) write_link(link);
    for (const JointDescription& joint : model_.joints) {
      if (joint.parent != "world") write_joint(joint);
    }
    return to_xml(robot_);
  }

 private:
  bool is_root(const LinkDescription& link) const { return parent_joint_.count(link.name) == 0; }

  const LinkDescription& link(const std::string& name) const {
    return *std::find_if(model_.links.begin(), model_.links.end(),
                         [&](const LinkDescription& each) { return each.name == name; });
  }

  void write(XmlElement part) { robot_.children.push_back(std::move(part)); }

  void write_link(const LinkDescription& link) {
    XmlElement made = element("link", {{"name", link.name}});
    if (!is_root(link)) made.children.push_back(inertial_element(link));
    for (const VisualDescription& visual : link.visuals) {
      if (!writable(visual.geometry)) continue;
      made.children.push_back(shape_element("visual", visual));
      made.children.back().children.push_back(material_element(link.name + "_" + visual.name, visual.material.diffuse));
    }
    for (const CollisionDescription& collision : link.collisions) {
      if (writable(collision.geometry)) made.children.push_back(shape_element("collision", collision));
    }
    write(std::move(made));
    for (const SensorDescription& sensor : link.sensors) {
      write_frame(sensor.name, link.name, sensor.pose);
      if (!sensor.kind.holds<CameraDescription>()) continue;
      write_frame(sensor.name + "_optical", sensor.name, Pose(0, 0, 0, -M_PI / 2, 0, -M_PI / 2));
    }
  }

  /// A link without inertia, fixed to another link.
  void write_frame(const std::string& name, const std::string& parent, const Pose& pose) {
    write(element("link", {{"name", name}}));
    write(joint_element(name + "_mount", "fixed", parent, name, pose));
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
      write_frame(sensor.name, joint.child, child.inverse() * joint.pose * sensor.pose);
    }
    if (!moves) {
      write(joint_element(joint.name, "fixed", joint.parent, joint.child, parent.inverse() * child));
      return;
    }
    const Pose rest = joint.pose.inverse() * child;
    const bool direct = rest.position.norm() < 1e-9 && std::abs(rest.orientation.w()) > 1 - 1e-12;
    const std::string carried = direct ? joint.child : joint.name + "_frame";
    write_moving(joint, carried, parent.inverse() * joint.pose);
    if (direct) return;
    write(element("link", {{"name", carried}}));
    write(joint_element(joint.name + "_mount", "fixed", carried, joint.child, rest));
  }

  /// `pose` is in the frame of the parent.
  void write_moving(const JointDescription& joint, const std::string& carried, const Pose& pose) {
    const AxisDescription& axis = joint.axes.at(0);
    const bool endless = !std::isfinite(axis.lower) && !std::isfinite(axis.upper) && joint.type != "prismatic";
    XmlElement made = joint_element(joint.name, endless ? "continuous" : joint.type, joint.parent, carried, pose);
    made.children.push_back(element("axis", {{"xyz", numbers(axis.direction)}}));
    XmlElement limit = element("limit", {});
    if (!endless) {
      limit.set_attribute("lower", number(std::max(axis.lower, -kNoLimit)));
      limit.set_attribute("upper", number(std::min(axis.upper, kNoLimit)));
    }
    limit.set_attribute("effort", number(std::min(axis.max_force, kNoLimit)));
    limit.set_attribute("velocity", number(std::min(axis.max_velocity, kNoLimit)));
    made.children.push_back(std::move(limit));
    write(std::move(made));
  }

  const ModelDescription& model_;
  XmlElement robot_;
  std::map<std::string, const JointDescription*> parent_joint_;  // by the child's name
};

}  // namespace

std::string to_urdf(const ModelDescription& model) { return UrdfWriter(model).write(); }

}  // namespace bubblesim
