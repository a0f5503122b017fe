// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_reading.hpp"

#include <console_bridge/console.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace bubblesim {
namespace {

using tinyxml2::XMLElement;

// SDFormat says it of all files without a link, and URDF has links always.
constexpr std::string_view kNoLink = "A model must have at least one link";
constexpr const char* kNoMass =
    "no link that would be left has a mass: links without one are left out, and all that hangs on them by joints that "
    "move; give the first one an <inertial>";

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

/// Neither the world's motion nor the parent's holds the child of such a joint.
bool lets_go(const XMLElement& joint) {
  const std::string type = attribute(&joint, "type");
  return type == "floating" || type == "planar";
}

bool is_massless(const XMLElement& link) {
  const auto* inertial = link.FirstChildElement("inertial");
  const auto* mass = inertial != nullptr ? inertial->FirstChildElement("mass") : nullptr;
  return mass == nullptr || !(mass->DoubleAttribute("value") > 0);
}

/// SDFormat keeps a link without mass out of the model, so a fixed joint of it must be lumped, whatever a file asks.
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

/// The text that SDFormat is to read in place of the file's.
std::string prepared(const tinyxml2::XMLDocument& file) {
  tinyxml2::XMLDocument document;
  file.DeepCopy(&document);
  XMLElement& robot = *document.RootElement();
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    // SDFormat knows no such joints and loses the pose of the link; finish_urdf() takes the joint away.
    if (lets_go(*joint)) joint->SetAttribute("type", "continuous");
  }
  lump_massless(robot);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

/// What the parser of URDF would write to stderr, as long as this lives.
class ParserMessages final : public console_bridge::OutputHandler {
 public:
  ParserMessages() : lock_(mutex()) { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }
  ParserMessages(const ParserMessages&) = delete;
  ParserMessages& operator=(const ParserMessages&) = delete;

  const std::vector<std::string>& messages() const { return messages_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_WARN) return;
    if (std::find(messages_.begin(), messages_.end(), text) == messages_.end()) messages_.push_back(text);
  }

  std::scoped_lock<std::mutex> lock_;
  std::vector<std::string> messages_;
};

std::optional<MimicDescription> mimic_of(const XMLElement& joint) {
  const auto* mimic = joint.FirstChildElement("mimic");
  if (mimic == nullptr) return std::nullopt;
  return MimicDescription{attribute(mimic, "joint"), 0, mimic->DoubleAttribute("multiplier", 1),
                          mimic->DoubleAttribute("offset", 0), 0};
}

}  // namespace

void load_urdf(sdf::Root& root, const sdf::ParserConfig& config, SceneReading& reading) {
  const ParserMessages parser;
  const sdf::Errors errors = root.LoadSdfString(prepared(reading.xml().document()), config);
  const Source file{reading.xml().file(), 0};
  if (!errors.empty() && root.Model() == nullptr && !parser.messages().empty()) {
    for (const std::string& message : parser.messages()) reading.report(file, "", message);
    return;
  }
  for (const std::string& message : parser.messages()) SceneReading::warn(file, "", message);
  const std::size_t before = reading.problems().size();
  reading.take(errors, "");
  for (std::size_t i = before; i < reading.problems().size(); ++i) {
    std::string& message = reading.problems()[i].message;
    if (message.find(kNoLink) != std::string::npos) message = kNoMass;
  }
}

sdf::Errors without_urdf_messages(const std::function<sdf::Errors()>& load) {
  const ParserMessages unheard;
  return load();
}

void finish_urdf(ModelDescription& model, SceneReading& reading) {
  const auto find = [&model](const std::string& name) {
    return std::find_if(model.joints.begin(), model.joints.end(),
                        [&name](const JointDescription& joint) { return joint.name == name; });
  };
  const XMLElement& robot = *reading.xml().document().RootElement();
  each(robot, "joint", [&](const XMLElement& joint) {
    const std::string name = attribute(&joint, "name");
    const std::string path = "/" + model.name + "/" + name;
    const Source source{reading.xml().file(), joint.GetLineNum()};
    const auto found = find(name);
    if (found == model.joints.end()) {
      if (attribute(&joint, "type") == "fixed") return;  // lumped
      SceneReading::warn(source, path,
                         "is left out with all that hangs on it: '" + child_attribute(joint, "child", "link") +
                             "', or a link that carries it, has no mass; give it an <inertial>");
    } else if (lets_go(joint)) {
      model.joints.erase(found);
      if (attribute(&joint, "type") == "planar") {
        SceneReading::warn(source, path, "planar joints are not simulated: its child moves freely");
      }
    }
  });
  each(robot, "joint", [&](const XMLElement& joint) {
    const auto found = find(attribute(&joint, "name"));
    const std::optional<MimicDescription> mimic = mimic_of(joint);
    if (!mimic || found == model.joints.end() || found->axes.empty()) return;
    // One that is in the file but not in the model stands still.
    const auto* leader = robot.FirstChildElement("joint");
    while (leader != nullptr && attribute(leader, "name") != mimic->joint) leader = leader->NextSiblingElement("joint");
    if (leader != nullptr && find(mimic->joint) == model.joints.end()) {
      SceneReading::warn({reading.xml().file(), joint.GetLineNum()}, "/" + model.name + "/" + found->name,
                         "mimics '" + mimic->joint + "', which does not move: it is free instead");
      return;
    }
    found->axes.front().mimic = mimic;
  });
}

}  // namespace bubblesim
