// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/urdf_reading.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "load/sdf/sdf_document.hpp"
#include "load/sdf/sdf_values.hpp"

namespace bubblesim {
namespace {

using tinyxml2::XMLElement;

// SDFormat's message for all files without a link; URDF files always have links.
constexpr std::string_view kNoLink = "A model must have at least one link";
constexpr const char* kNoOwnLink = "contains no <link> except the world";
constexpr const char* kWorld = "world";
constexpr int kMostLinks = 1000;  // one below the other

void each(const XMLElement& parent, const char* name, const std::function<void(const XMLElement&)>& visit) {
  for (const auto* element = parent.FirstChildElement(name); element != nullptr;
       element = element->NextSiblingElement(name)) {
    visit(*element);
  }
}

std::string attribute(const XMLElement* element, const char* name) {
  const char* value = element != nullptr ? element->Attribute(name) : nullptr;
  return value != nullptr ? value : "";
}

std::string child_attribute(const XMLElement& parent, const char* child, const char* name) {
  return attribute(parent.FirstChildElement(child), name);
}

/// Whether a joint does not hold its child.
bool lets_go(const XMLElement& joint) {
  const std::string type = attribute(&joint, "type");
  return type == "floating" || type == "planar";
}

bool is_massless(const XMLElement& link) {
  const auto* inertial = link.FirstChildElement("inertial");
  const auto* mass = inertial != nullptr ? inertial->FirstChildElement("mass") : nullptr;
  return mass == nullptr || !(mass->DoubleAttribute("value") > 0);
}

/// SDFormat drops a link without mass, so fixed joints of such a link must be lumped, whatever the file requests.
void lump_massless(XMLElement& robot) {
  std::set<std::string> massless;
  each(robot, "link", [&](const XMLElement& link) {
    if (is_massless(link)) massless.insert(attribute(&link, "name"));
  });
  std::set<std::string> lumped;
  each(robot, "joint", [&](const XMLElement& joint) {
    for (const char* end : {"parent", "child"}) {
      if (massless.count(child_attribute(joint, end, "link")) > 0) lumped.insert(attribute(&joint, "name"));
    }
  });
  for (auto* extension = robot.FirstChildElement("gazebo"); extension != nullptr;
       extension = extension->NextSiblingElement("gazebo")) {
    if (lumped.count(attribute(extension, "reference")) == 0) continue;
    for (const char* name : {"preserveFixedJoint", "disableFixedJointLumping"}) {
      if (auto* element = extension->FirstChildElement(name)) extension->DeleteChild(element);
    }
  }
}

/// Whether the link has mass, including links that are fixed to it.
bool has_mass(const XMLElement& robot, const std::string& name, int depth = 0) {
  if (depth > kMostLinks) return false;  // a cycle of links, which SDFormat reports
  bool found = false;
  each(robot, "link",
       [&](const XMLElement& link) { found = found || (attribute(&link, "name") == name && !is_massless(link)); });
  each(robot, "joint", [&](const XMLElement& joint) {
    if (found || attribute(&joint, "type") != "fixed" || child_attribute(joint, "parent", "link") != name) return;
    found = has_mass(robot, child_attribute(joint, "child", "link"), depth + 1);
  });
  return found;
}

/// A root link without mass would be dropped with the whole robot. Nothing can move it, so it is fixed to the world.
void hold_massless_root(XMLElement& robot, LoadContext& reading) {
  std::set<std::string> children;
  each(robot, "joint", [&](const XMLElement& joint) { children.insert(child_attribute(joint, "child", "link")); });
  auto* root = robot.FirstChildElement("link");
  while (root != nullptr && children.count(attribute(root, "name")) > 0) root = root->NextSiblingElement("link");
  const std::string name = attribute(root, "name");
  if (root == nullptr || name == kWorld || has_mass(robot, name)) return;
  reading.warn({reading.xml().file(), root->GetLineNum()}, "/" + attribute(&robot, "name") + "/" + name,
               "has no mass: it is fixed to the world; add an <inertial> if it shall move");
  if (auto* inertial = root->FirstChildElement("inertial")) root->DeleteChild(inertial);
  auto* inertial = root->InsertNewChildElement("inertial");
  inertial->InsertNewChildElement("mass")->SetAttribute("value", 1);
  auto* inertia = inertial->InsertNewChildElement("inertia");
  for (const char* moment : {"ixx", "iyy", "izz"}) inertia->SetAttribute(moment, 1);
  for (const char* product : {"ixy", "ixz", "iyz"}) inertia->SetAttribute(product, 0);
  robot.InsertNewChildElement("link")->SetAttribute("name", kWorld);
  auto* joint = robot.InsertNewChildElement("joint");
  joint->SetAttribute("name", (std::string(kWorld) + "_holds_" + name).c_str());
  joint->SetAttribute("type", "fixed");
  joint->InsertNewChildElement("parent")->SetAttribute("link", kWorld);
  joint->InsertNewChildElement("child")->SetAttribute("link", name.c_str());
}

/// The content of a <gazebo> for a link or the model is SDFormat, except for some own elements.
void repair_extension(XMLElement& extension, LoadContext& reading) {
  const std::string& file = reading.xml().file();
  const std::string link = attribute(&extension, "reference");
  const std::string path = "/" + attribute(reading.xml().document().RootElement(), "name") + "/" + link;
  for (auto* child = extension.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::string_view name = child->Name();
    if ((name == "mu1" || name == "mu2") && child->DoubleText() < 0) {
      reading.warn({file, child->GetLineNum()}, path,
                   "<" + std::string(name) + "> is below 0: using infinite friction");
      child->SetText("inf");
    } else if (name == "sensor") {
      replace_bad_values(*child, link.empty() ? "model" : "link", file, reading);
    }
  }
}

std::optional<MimicDescription> mimic_of(const XMLElement& joint) {
  const auto* mimic = joint.FirstChildElement("mimic");
  if (mimic == nullptr) return std::nullopt;
  return MimicDescription{attribute(mimic, "joint"), 0, mimic->DoubleAttribute("multiplier", 1),
                          mimic->DoubleAttribute("offset", 0), 0};
}

}  // namespace

std::string prepared_urdf(LoadContext& reading) {
  XMLElement& original = *reading.xml().document().RootElement();  // copies have no line numbers
  for (auto* extension = original.FirstChildElement("gazebo"); extension != nullptr;
       extension = extension->NextSiblingElement("gazebo")) {
    repair_extension(*extension, reading);
  }
  tinyxml2::XMLDocument document;
  reading.xml().document().DeepCopy(&document);
  XMLElement& robot = *document.RootElement();
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    // SDFormat does not support such joints and loses the pose of the link; finish_urdf() removes the joint.
    if (lets_go(*joint)) joint->SetAttribute("type", "continuous");
  }
  lump_massless(robot);
  hold_massless_root(robot, reading);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

sdf::Errors load_urdf(sdf::Root& root, const sdf::ParserConfig& config, const std::string& prepared) {
  sdf::Errors errors = load_document_text(root, prepared, config);
  for (sdf::Error& error : errors) {
    if (error.Message().find(kNoLink) != std::string::npos) error = sdf::Error(error.Code(), kNoOwnLink);
  }
  return errors;
}

void finish_urdf(ModelDescription& model, LoadContext& reading) {
  const auto find = [&model](const std::string& name) {
    return std::find_if(model.joints.begin(), model.joints.end(),
                        [&name](const JointDescription& joint) { return joint.name == name; });
  };
  const XMLElement& robot = *reading.xml().document().RootElement();
  each(robot, "link", [&](const XMLElement& link) {
    const auto* inertial = link.FirstChildElement("inertial");
    const std::string mass = inertial != nullptr ? child_attribute(*inertial, "mass", "value") : "";
    if (mass.empty() || mass.front() != '-') return;  // a link without mass is ignored, or lumped into its parent
    reading.report({reading.xml().file(), link.GetLineNum()}, "/" + model.name + "/" + attribute(&link, "name"),
                   "the mass is " + mass + " kg, it must be above 0 and at most 1e6 kg");
  });
  each(robot, "joint", [&](const XMLElement& joint) {
    const std::string name = attribute(&joint, "name");
    const std::string path = "/" + model.name + "/" + name;
    const Source source{reading.xml().file(), joint.GetLineNum()};
    const auto found = find(name);
    if (found == model.joints.end()) {
      if (attribute(&joint, "type") == "fixed") return;  // lumped
      reading.warn(source, path,
                   "is ignored with all links below it: '" + child_attribute(joint, "child", "link") +
                       "' or one of its parent links has no mass; add an <inertial>");
    } else if (lets_go(joint)) {
      model.joints.erase(found);
      if (attribute(&joint, "type") == "planar") {
        reading.warn(source, path, "planar joints are not simulated: its child moves freely");
      }
    }
  });
  each(robot, "joint", [&](const XMLElement& joint) {
    const auto found = find(attribute(&joint, "name"));
    const std::optional<MimicDescription> mimic = mimic_of(joint);
    if (!mimic || found == model.joints.end() || found->axes.empty()) return;
    // A leader that is in the file and not in the model does not move.
    const auto* leader = robot.FirstChildElement("joint");
    while (leader != nullptr && attribute(leader, "name") != mimic->joint) leader = leader->NextSiblingElement("joint");
    if (leader != nullptr && find(mimic->joint) == model.joints.end()) {
      reading.warn({reading.xml().file(), joint.GetLineNum()}, "/" + model.name + "/" + found->name,
                   "mimics '" + mimic->joint + "', which does not move: the mimic is ignored");
      return;
    }
    found->axes.front().mimic = mimic;
  });
}

}  // namespace bubblesim
