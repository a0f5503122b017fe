// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/urdf_model.hpp"

#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "load/sdf/documents/unique_names.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/sdf/models/frames.hpp"
#include "load/sdf/models/sdf_joints.hpp"
#include "load/sdf/models/sdf_links.hpp"
#include "load/sdf/models/sdf_models.hpp"
#include "load/urdf/fixed_joint_lumping.hpp"
#include "load/urdf/gazebo_extensions.hpp"
#include "load/urdf/link_element.hpp"
#include "load/urdf/urdf_robot.hpp"
#include "load/urdf/urdf_values.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

class ModelMaker {
 public:
  ModelMaker(const UrdfRobot& robot, GazeboExtensions extensions, LoadContext& context)
      : robot_(robot), extensions_(std::move(extensions)), context_(context) {
    std::set<std::string> kept = extensions_.preserved_joints;
    kept.insert(extensions_.unlumped_joints.begin(), extensions_.unlumped_joints.end());
    bodies_ = lump_fixed_joints(robot, kept, context);
    for (const LumpedLink& body : bodies_) {
      for (const LumpedPart& part : body.parts) places_.emplace(part.link->name, Place{&body, &part});
    }
    for (const UrdfJoint& joint : robot.joints) joints_.emplace(joint.name, &joint);
  }

  ModelDescription make() {
    name_joints();
    move_plugins();
    name_gripper_links();
    XmlElement& content = extensions_.model;
    content.set_attribute("name", robot_.name);
    make_names_unique(content, "/" + robot_.name, context_);
    const XmlElement all = with_frames(content);
    const Frames frames({&all, model_kind()}, "/" + robot_.name, context_);
    const SdfElement element(&content, model_kind());
    ModelDescription model = read_model(element, frames, element.child("pose").as_pose(), context_);
    model.source = robot_.source;
    path_ = "/" + model.name;
    add_links(model, frames, element.flag("enable_wind"));
    add_joints(model, frames);
    warn_of_unused();
    return model;
  }

 private:
  /// Where a link of the file is in the model.
  struct Place {
    const LumpedLink* body = nullptr;
    const LumpedPart* part = nullptr;
  };

  bool is_simulated(const LumpedLink& body) const {
    return body.joint != nullptr && body.joint->type != "floating" && body.joint->type != "planar";
  }

  /// In a model, joints do not have the names of links.
  void name_joints() {
    for (const LumpedLink& body : bodies_) {
      if (!is_simulated(body)) continue;
      std::string name = body.joint->name;
      if (const auto place = places_.find(name); place != places_.end() && place->second.part->joint == nullptr) {
        name += "_joint";
        context_.warn(body.joint->place.source(), "/" + robot_.name + "/" + name,
                      "renamed: a link has the name '" + body.joint->name + "'");
      }
      joint_names_.emplace(body.joint->name, name);
    }
  }

  /// Plugins that name a lumped link get the link that it is a part of, with the offset of the place.
  void move_plugins() {
    for (XmlElement& plugin : extensions_.model.children) {
      if (plugin.name != "plugin") continue;
      for (const char* name : {"bodyName", "frameName"}) {
        const std::string link = plugin.child_text(name);
        const auto place = places_.find(link);
        if (place == places_.end() || place->second.part->joint == nullptr) continue;  // it is no lumped link
        replace_text(plugin, name, place->second.body->link().name);
        move_offset(plugin, place->second.part->pose);
      }
    }
  }

  /// Grippers that name a lumped link get the link that it is a part of.
  void name_gripper_links() {
    for (XmlElement& gripper : extensions_.model.children) {
      if (gripper.name != "gripper") continue;
      for (XmlElement& child : gripper.children) {
        const auto place = places_.find(trimmed(child.text));
        const bool is_link = child.name == "palm_link" || child.name == "gripper_link";
        if (is_link && place != places_.end()) child.text = place->second.body->link().name;
      }
    }
  }

  static void move_offset(XmlElement& plugin, const Pose& part) {
    const auto vector_of = [&plugin](const char* name) {
      std::vector<double> numbers;
      read_numbers(plugin.child_text(name), numbers);
      numbers.resize(3);
      return Vector3(numbers[0], numbers[1], numbers[2]);
    };
    const Vector3 rpy = vector_of("rpyOffset");
    const Pose offset = part * Pose(vector_of("xyzOffset"), from_rpy(rpy.x(), rpy.y(), rpy.z()));
    const Vector3 turn = to_rpy(offset.orientation);
    replace_text(plugin, "xyzOffset", write_numbers({offset.position.x(), offset.position.y(), offset.position.z()}));
    replace_text(plugin, "rpyOffset", write_numbers({turn.x(), turn.y(), turn.z()}));
    replace_text(plugin, "ignition::corrected_offsets", "1");
  }

  /// Puts a parameter behind the others.
  static void replace_text(XmlElement& plugin, const std::string& name, const std::string& text) {
    plugin.remove_children(name);
    plugin.add_child(name, text);
  }

  /// The <model> in <gazebo> with all that poses and joints in it can refer to: links, lumped links and joints.
  XmlElement with_frames(const XmlElement& content) const {
    XmlElement all = content;
    const auto add = [&all](const std::string& kind, const std::string& name, const std::string& link,
                            const Pose& pose) {
      XmlElement frame = named_element(kind, name, all);
      if (kind == "frame") frame.set_attribute("attached_to", link);
      frame.children.push_back(pose_element(pose, all));
      all.children.push_back(std::move(frame));
    };
    for (const LumpedLink& body : bodies_) {
      const std::string& link = body.link().name;
      for (const LumpedPart& part : body.parts) {
        if (part.joint == nullptr) add("link", link, link, body.pose);
        if (part.joint != nullptr) add("frame", part.link->name, link, part.pose);
        const UrdfJoint* joint = part.joint != nullptr ? part.joint : body.joint;
        if (joint != nullptr) add("frame", name_of(*joint), link, part.pose);
      }
    }
    return all;
  }

  std::string name_of(const UrdfJoint& joint) const {
    const auto found = joint_names_.find(joint.name);
    return found != joint_names_.end() ? found->second : joint.name;
  }

  /// Those of the file come before those that <gazebo> adds.
  void add_links(ModelDescription& model, const Frames& frames, bool has_wind) {
    std::vector<LinkDescription> links;
    for (const LumpedLink& body : bodies_) {
      const std::string path = path_ + "/" + body.link().name;
      XmlElement element = link_element(body, extensions_, path, context_);
      make_names_unique(element, path, context_);
      LinkDescription link = read_link({&element, link_kind()}, frames, path_, model.is_static, context_);
      if (element.child("enable_wind") == nullptr) link.wind_enabled = has_wind;
      set_inertial(body.inertial, link);
      if (!model.is_static) repair_inertia(link, path, context_);
      links.push_back(std::move(link));
    }
    std::move(model.links.begin(), model.links.end(), std::back_inserter(links));
    model.links = std::move(links);
  }

  static void set_inertial(const UrdfInertial& inertial, LinkDescription& link) {
    const Matrix3& inertia = inertial.inertia;
    link.mass = inertial.mass;
    link.centre_of_mass = inertial.centre_of_mass;
    link.inertia_diagonal = inertia.diagonal();
    link.inertia_products = {inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  }

  void add_joints(ModelDescription& model, const Frames& frames) {
    std::vector<JointDescription> joints;
    for (const LumpedLink& body : bodies_) {
      if (body.is_held) joints.push_back(holding(body));
      if (is_simulated(body)) joints.push_back(joint_of(body, frames));
      if (body.joint != nullptr && body.joint->type == "planar") {
        context_.warn(body.joint->place.source(), path_ + "/" + body.joint->name,
                      "planar joints are not simulated: its child moves freely");
      }
    }
    std::move(model.joints.begin(), model.joints.end(), std::back_inserter(joints));
    model.joints = std::move(joints);
  }

  static JointDescription holding(const LumpedLink& body) {
    JointDescription joint;
    joint.name = std::string(kUrdfWorld) + "_holds_" + body.link().name;
    joint.type = "fixed";
    joint.parent = kUrdfWorld;
    joint.child = body.link().name;
    joint.source = body.link().place.source();
    return joint;
  }

  JointDescription joint_of(const LumpedLink& body, const Frames& frames) {
    const UrdfJoint& joint = *body.joint;
    XmlElement element = named_element("joint", name_of(joint), joint.place);
    element.add_child("parent", body.parent);
    element.add_child("child", body.link().name);
    add_axis(joint, element);
    if (const auto extension = extensions_.joints.find(joint.name); extension != extensions_.joints.end()) {
      for (const XmlElement& child : extension->second.children) {
        if (child.name != "axis") element.children.push_back(child);
      }
    }
    make_names_unique(element, path_ + "/" + name_of(joint), context_);
    JointDescription description = *read_joint({&element, joint_kind()}, frames, path_, context_);
    if (!description.axes.empty()) description.axes.front().mimic = mimic_of(joint);
    return description;
  }

  void add_axis(const UrdfJoint& joint, XmlElement& element) const {
    element.set_attribute("type", joint.type == "continuous" ? "revolute" : joint.type);
    XmlElement axis = joint.axis;
    if (joint.type == "fixed") {
      const bool stays = extensions_.preserved_joints.count(joint.name) > 0 || joint.parent == kUrdfWorld;
      if (stays || extensions_.unlumped_joints.count(joint.name) == 0) return;
      element.set_attribute("type", "revolute");
      axis = named_element("axis", "", joint.place);
      XmlElement& limit = axis.add_child("limit");
      for (const char* side : {"lower", "upper"}) limit.add_child(side, "0");
    }
    const auto extension = extensions_.joints.find(joint.name);
    const XmlElement* added = extension != extensions_.joints.end() ? extension->second.child("axis") : nullptr;
    if (added != nullptr) merge(*added, axis, *joint_kind().child("axis"));
    element.children.push_back(std::move(axis));
  }

  /// Empty when the leader does not move.
  std::optional<MimicDescription> mimic_of(const UrdfJoint& joint) {
    if (!joint.mimic) return std::nullopt;
    MimicDescription mimic = *joint.mimic;
    const auto leader = joints_.find(mimic.joint);
    if (leader == joints_.end()) return mimic;  // the check reports it
    const auto known = joint_names_.find(mimic.joint);
    if (known != joint_names_.end() && leader->second->type != "fixed") {
      mimic.joint = known->second;
      return mimic;
    }
    context_.warn(joint.place.source(), path_ + "/" + name_of(joint),
                  "mimics '" + mimic.joint + "', which does not move: the mimic is ignored");
    return std::nullopt;
  }

  /// Warns about what the file has and the model has not.
  void warn_of_unused() {
    for (const LumpedLink& body : bodies_) {
      for (const LumpedPart& part : body.parts) {
        if (part.joint == nullptr) continue;
        const auto extension = extensions_.joints.find(part.joint->name);
        if (extension == extensions_.joints.end() || extension->second.child("sensor") == nullptr) continue;
        context_.warn(extension->second.source(), path_ + "/" + part.joint->name,
                      "<gazebo> is ignored: the joint is fixed and its links become one; keep the joint by "
                      "<preserveFixedJoint>true</preserveFixedJoint>");
      }
    }
    for (const UrdfLink& link : robot_.links) {
      if (link.name != kUrdfWorld || (link.collisions.empty() && link.visuals.empty())) continue;
      context_.warn(link.place.source(), path_ + "/" + link.name,
                    "the shapes of the world are ignored: put them into a link");
    }
  }

  const UrdfRobot& robot_;
  GazeboExtensions extensions_;
  LoadContext& context_;
  std::string path_;
  std::vector<LumpedLink> bodies_;
  std::map<std::string, Place> places_;             // of the links in the file
  std::map<std::string, const UrdfJoint*> joints_;  // of the file
  std::map<std::string, std::string> joint_names_;  // of the simulated joints, by those in the file
};

}  // namespace

ModelDescription read_urdf(const XmlElement& robot, LoadContext& context) {
  const std::size_t known = context.problems().size();
  const UrdfRobot read = read_robot(robot, context);
  GazeboExtensions extensions = read_extensions(robot, read, context);
  // Without its parts, a robot would have other problems, which would only hide the cause.
  if (context.problems().size() > known) {
    throw SceneError(std::move(context.problems()), std::move(context.warnings()));
  }
  ModelDescription model = ModelMaker(read, std::move(extensions), context).make();
  model.transmissions = read.transmissions;
  return model;
}

}  // namespace bubblesim
