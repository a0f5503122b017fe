// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/urdf_robot.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/urdf/urdf_values.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

const std::vector<std::string> kTypes = {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};

std::string link_attribute(const XmlElement& joint, const char* which) {
  const XmlElement* end = joint.child(which);
  const std::string* link = end != nullptr ? end->attribute("link") : nullptr;
  return link != nullptr ? *link : "";
}

std::vector<std::string> texts_of(const XmlElement& parent, const std::string& name) {
  std::vector<std::string> strings;
  for (const XmlElement& child : parent.children) {
    if (child.name == name) strings.push_back(child.text);
  }
  return strings;
}

/// Reads the parts of a robot, one by one.
class PartReader {
 public:
  PartReader(const XmlElement& robot, LoadContext& context)
      : path_("/" + robot.given_name()), context_(context), materials_(robot, path_, context) {}

  UrdfLink link(const XmlElement& element) {
    const std::string path = path_ + "/" + element.given_name();
    UrdfLink link;
    link.name = element.given_name();
    link.place = in_place_of(element, "link");
    if (const XmlElement* inertial = element.child("inertial")) link.inertial = read_inertial(*inertial, path);
    for (const XmlElement& child : element.children) {
      if (child.name != "collision" && child.name != "visual") continue;
      auto shape = read_shape(child, materials_, path, context_);
      if (shape) (child.name == "visual" ? link.visuals : link.collisions).push_back(std::move(*shape));
    }
    return link;
  }

  UrdfJoint joint(const XmlElement& element) {
    const std::string path = path_ + "/" + element.given_name();
    UrdfJoint joint;
    joint.name = element.given_name();
    joint.place = in_place_of(element, "joint");
    joint.parent = link_attribute(element, "parent");
    joint.child = link_attribute(element, "child");
    joint.pose = origin_of(element, path, context_);
    read_type(element, path, joint);
    const bool has_axis = joint.type == "revolute" || joint.type == "continuous" || joint.type == "prismatic";
    if (has_axis) joint.axis = read_axis(element, joint.type, path);
    if (has_axis) joint.mimic = read_mimic(element, path);
    return joint;
  }

  TransmissionDescription transmission(const XmlElement& element) {
    const std::string path = path_ + "/" + element.given_name();
    TransmissionDescription transmission;
    transmission.name = element.given_name();
    transmission.source = element.source();
    const std::string* type = element.attribute("type");  // before ROS Groovy
    transmission.type = type != nullptr ? *type : element.child_text("type");
    for (const XmlElement& child : element.children) {
      const std::vector<std::string> interfaces = texts_of(child, "hardwareInterface");
      if (child.name == "joint") transmission.joints.push_back({child.given_name(), interfaces});
      if (child.name != "actuator") continue;
      const XmlElement* reduction = child.child("mechanicalReduction");
      if (reduction == nullptr) reduction = element.child("mechanicalReduction");
      transmission.actuators.push_back({child.given_name(), read_reduction(reduction, path), interfaces});
    }
    return transmission;
  }

  /// A <ros2_control>: its joints with the interfaces of ros_control that correspond to their command interfaces.
  TransmissionDescription ros2_control(const XmlElement& element) {
    TransmissionDescription system;
    system.name = element.given_name();
    system.source = element.source();
    system.type = "ros2_control";
    for (const XmlElement& child : element.children) {
      if (child.name != "joint") continue;
      TransmissionJoint joint{child.given_name(), {}};
      for (const XmlElement& interface : child.children) {
        if (interface.name == "state_interface" && interface.given_name() == "position") {
          joint.initial_position = initial_value(interface, path_ + "/" + system.name + "/" + joint.name);
        }
        if (interface.name != "command_interface") continue;
        std::string kind = interface.given_name();
        if (kind != "position" && kind != "velocity" && kind != "effort") {
          context_.warn(
              interface.source(), path_ + "/" + system.name + "/" + joint.name,
              "<command_interface name='" + kind + "'> has no effect: it must be position, velocity or effort");
          continue;
        }
        kind.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(kind.front())));
        joint.hardware_interfaces.push_back("hardware_interface/" + kind + "JointInterface");
      }
      system.joints.push_back(std::move(joint));
    }
    return system;
  }

 private:
  UrdfInertial read_inertial(const XmlElement& element, const std::string& path) {
    UrdfInertial inertial;
    const Pose pose = origin_of(element, path, context_);
    inertial.centre_of_mass = pose.position;
    const XmlElement* mass = element.child("mass");
    if (mass != nullptr) inertial.mass = number_in(*mass, "value", path, context_).value_or(0);
    if (inertial.mass < 0) {
      context_.report(mass->source(), path,
                      "the mass is " + text(inertial.mass) + " kg, it must be above 0 and at most 1e6 kg");
    }
    const XmlElement* inertia = element.child("inertia");
    if (inertia != nullptr) {
      inertial.inertia = turned(read_inertia(*inertia, path), pose.orientation);
    } else if (inertial.has_mass()) {
      context_.warn(element.source(), path, "<inertial> has no <inertia>: taken as 0");
    }
    return inertial;
  }

  Matrix3 read_inertia(const XmlElement& element, const std::string& path) {
    std::string absent;
    const auto read = [&](const char* attribute) {
      if (element.attribute(attribute) == nullptr) absent += (absent.empty() ? "" : ", ") + std::string(attribute);
      return number_in(element, attribute, path, context_).value_or(0);
    };
    const double xx = read("ixx");
    const double xy = read("ixy");
    const double xz = read("ixz");
    const double yy = read("iyy");
    const double yz = read("iyz");
    const double zz = read("izz");
    if (!absent.empty()) context_.warn(element.source(), path, "<inertia> has no " + absent + ": taken as 0");
    Matrix3 inertia;
    inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return inertia;
  }

  /// From the axes of the <inertial> to those of the link.
  static Matrix3 turned(const Matrix3& inertia, const Quaternion& orientation) {
    const Matrix3 turn = orientation.toRotationMatrix();
    return turn.isIdentity(0) ? inertia : Matrix3(turn * inertia * turn.transpose());
  }

  void read_type(const XmlElement& element, const std::string& path, UrdfJoint& joint) {
    const std::string* type = element.attribute("type");
    if (type != nullptr) joint.type = *type;
    if (type == nullptr) {
      context_.report(element.source(), path, "<joint> has no attribute type: URDF requires it");
    } else if (std::find(kTypes.begin(), kTypes.end(), joint.type) == kTypes.end()) {
      context_.report(element.source(), path,
                      "unknown joint type '" + joint.type + "', it must be revolute, continuous, prismatic, fixed, " +
                          "floating or planar" + did_you_mean(joint.type, kTypes));
    }
  }

  XmlElement read_axis(const XmlElement& joint, const std::string& type, const std::string& path) {
    XmlElement axis = in_place_of(joint, "axis");
    axis.add_child("xyz", read_direction(joint, path));
    if (const XmlElement* limit = joint.child("limit")) {
      axis.children.push_back(read_limit(*limit, type, path));
    } else if (type != "continuous") {
      context_.report(
          joint.source(), path,
          "has no <limit>: URDF requires the limits of a " + type + " joint: lower, upper, effort, velocity");
    }
    if (const XmlElement* dynamics = joint.child("dynamics")) {
      XmlElement& target = axis.add_child("dynamics");
      target.line = dynamics->line;
      for (const char* name : {"damping", "friction"}) copy_number(*dynamics, name, path, target);
    }
    return axis;
  }

  std::string read_direction(const XmlElement& joint, const std::string& path) {
    constexpr double kShortest = 1e-6;
    const XmlElement* axis = joint.child("axis");
    if (axis == nullptr) return "1 0 0";
    const auto direction = required_vector_in(*axis, "xyz", path, context_);
    if (direction && direction->norm() < kShortest) {
      context_.report(axis->source(), path, "<axis> has xyz='" + *axis->attribute("xyz") + "': it needs a direction");
    }
    return direction ? *axis->attribute("xyz") : "1 0 0";
  }

  XmlElement read_limit(const XmlElement& limit, const std::string& type, const std::string& path) {
    XmlElement target = in_place_of(limit, "limit");
    for (const char* name : {"effort", "velocity"}) {
      if (required_number_in(limit, name, path, context_)) target.add_child(name, *limit.attribute(name));
    }
    const double lower = number_in(limit, "lower", path, context_).value_or(0);
    const double upper = number_in(limit, "upper", path, context_).value_or(0);
    if (type == "continuous") return target;
    if (lower > upper) {
      context_.warn(
          limit.source(), path,
          "the lower limit " + text(lower) + " is above the upper limit " + text(upper) + ": they are exchanged");
    }
    target.add_child("lower", write_numbers({std::min(lower, upper)}));
    target.add_child("upper", write_numbers({std::max(lower, upper)}));
    return target;
  }

  void copy_number(const XmlElement& from, const char* name, const std::string& path, XmlElement& to) {
    if (number_in(from, name, path, context_)) to.add_child(name, *from.attribute(name));
  }

  std::optional<MimicDescription> read_mimic(const XmlElement& joint, const std::string& path) {
    const XmlElement* element = joint.child("mimic");
    if (element == nullptr) return std::nullopt;
    const std::string* leader = element->attribute("joint");
    if (leader == nullptr || leader->empty()) {
      context_.report(element->source(), path, "<mimic> has no attribute joint: it must name the joint to follow");
      return std::nullopt;
    }
    MimicDescription mimic;
    mimic.joint = *leader;
    mimic.multiplier = number_in(*element, "multiplier", path, context_).value_or(1);
    mimic.offset = number_in(*element, "offset", path, context_).value_or(0);
    return mimic;
  }

  double read_reduction(const XmlElement* element, const std::string& path) {
    return element == nullptr ? 1 : number_of(*element, path).value_or(1);
  }

  /// The <param name="initial_value"> of an interface.
  std::optional<double> initial_value(const XmlElement& interface, const std::string& path) {
    for (const XmlElement& child : interface.children) {
      if (child.name == "param" && child.given_name() == "initial_value") return number_of(child, path);
    }
    return {};
  }

  /// The content of an element.
  std::optional<double> number_of(XmlElement element, const std::string& path) {
    element.set_attribute("value", element.text);
    return number_in(element, "value", path, context_);
  }

  std::string path_;
  LoadContext& context_;
  UrdfMaterials materials_;
};

/// Checks that the links and joints of a robot are a tree.
class TreeCheck {
 public:
  TreeCheck(const UrdfRobot& robot, LoadContext& context) : robot_(robot), path_("/" + robot.name), context_(context) {
    for (const UrdfLink& link : robot.links) names_.insert(link.name);
  }

  void check() {
    check_names();
    for (const UrdfJoint& joint : robot_.joints) check_ends(joint);
    if (is_broken_) return;
    check_roots();
  }

 private:
  void report(const Source& source, const std::string& name, const std::string& message) {
    is_broken_ = true;
    context_.report(source, name.empty() ? path_ : path_ + "/" + name, message);
  }

  void check_names() {
    if (std::all_of(names_.begin(), names_.end(), [](const std::string& name) { return name == kUrdfWorld; })) {
      report(robot_.source, "", "contains no <link> except the world");
    }
    check_unique(robot_.links, "link");
    check_unique(robot_.joints, "joint");
  }

  template <class Part>
  void check_unique(const std::vector<Part>& parts, const std::string& kind) {
    std::map<std::string, int> lines;
    for (const Part& part : parts) {
      if (part.name.empty()) {
        report(part.place.source(), "", "<" + kind + "> has no name: add the attribute name");
        continue;
      }
      const auto [known, is_new] = lines.emplace(part.name, part.place.line);
      if (is_new) continue;
      report(part.place.source(), part.name,
             "another " + kind + ", in line " + std::to_string(known->second) + ", has the name '" + part.name +
                 "': rename one of them");
    }
  }

  void check_ends(const UrdfJoint& joint) {
    check_end(joint, "parent", joint.parent);
    check_end(joint, "child", joint.child);
    if (!joint.parent.empty() && joint.parent == joint.child) {
      report(joint.place.source(), joint.name, "joins '" + joint.parent + "' to itself: parent and child must differ");
    }
    const auto [known, is_new] = holder_.emplace(joint.child, &joint);
    if (is_new || joint.child.empty() || joint.name == known->second->name) return;
    report(joint.place.source(), joint.name,
           "'" + joint.child + "' is the child of '" + known->second->name + "', too, in line " +
               std::to_string(known->second->place.line) +
               ": URDF is a tree, a link has one parent; a <joint> in a <gazebo> closes a loop");
  }

  void check_end(const UrdfJoint& joint, const std::string& which, const std::string& link) {
    if (link.empty()) {
      return report(joint.place.source(), joint.name, "has no <" + which + " link=\"...\">: it must name a link");
    }
    if (link == kUrdfWorld && which == "parent") return;  // it need not be in the file
    if (names_.count(link) > 0) return;
    constexpr std::size_t kMost = 1000;  // comparing with more takes too long
    const std::string hint = names_.size() > kMost ? "" : did_you_mean(link, {names_.begin(), names_.end()});
    report(joint.place.source(), joint.name,
           "the " + which + " link [" + link + "] of joint [" + joint.name +
               "] is not in the file: add this <link> or correct the name" + hint);
  }

  void check_roots() {
    std::vector<const UrdfLink*> roots;
    std::map<std::string, std::vector<const UrdfJoint*>> below;
    for (const UrdfJoint& joint : robot_.joints) below[joint.parent].push_back(&joint);
    for (const UrdfLink& link : robot_.links) {
      if (holder_.count(link.name) == 0) roots.push_back(&link);
    }
    std::set<std::string> reached = {kUrdfWorld};
    std::vector<std::string> open = {kUrdfWorld};
    for (const UrdfLink* root : roots) open.push_back(root->name);
    while (!open.empty()) {
      const std::string name = open.back();
      open.pop_back();
      reached.insert(name);
      for (const UrdfJoint* joint : below[name]) open.push_back(joint->child);
    }
    for (const UrdfLink& link : robot_.links) {
      if (reached.count(link.name) > 0) continue;
      report(link.place.source(), link.name,
             "is in a loop of joints, or below one: URDF is a tree; a <joint> in a <gazebo> closes a loop");
      return;  // one error is enough for a loop
    }
    if (roots.size() < 2) return;
    std::string names;
    for (const UrdfLink* root : roots) names += (names.empty() ? "'" : ", '") + root->name + "'";
    report(roots[1]->place.source(), roots[1]->name,
           "is not attached to the other links: the links that are no child of a joint are " + names +
               ", there must be one: add a joint, such as a fixed one");
  }

  const UrdfRobot& robot_;
  std::string path_;
  LoadContext& context_;
  std::set<std::string> names_;                     // of the links
  std::map<std::string, const UrdfJoint*> holder_;  // by the child's name
  bool is_broken_ = false;
};

void check_version(const XmlElement& robot, LoadContext& context) {
  const std::string* version = robot.attribute("version");
  if (version == nullptr || version->rfind("1.", 0) == 0) return;
  context.report(robot.source(), "/" + robot.given_name(),
                 "<robot> has version='" + *version + "', it must be 1.0, 1.1 or 1.2");
}

}  // namespace

UrdfRobot read_robot(const XmlElement& robot, LoadContext& context) {
  UrdfRobot read;
  read.name = robot.given_name();
  read.source = robot.source();
  if (read.name.empty()) {
    context.report({robot.source().file, 0}, "", "No name given for the robot.");
  }
  check_version(robot, context);
  PartReader reader(robot, context);
  for (const XmlElement& child : robot.children) {
    if (child.name == "link") read.links.push_back(reader.link(child));
    if (child.name == "joint") read.joints.push_back(reader.joint(child));
    if (child.name == "transmission") read.transmissions.push_back(reader.transmission(child));
    if (child.name == "ros2_control") read.transmissions.push_back(reader.ros2_control(child));
  }
  TreeCheck(read, context).check();
  return read;
}

}  // namespace bubblesim
