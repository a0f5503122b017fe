// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/describe.hpp"

#include <algorithm>
#include <map>
#include <ostream>

#include "load/ttt/left_out.hpp"
#include "scene/describe.hpp"

namespace bubblesim::ttt {
namespace {

/// A name in one line, without what a terminal might obey.
std::string shown(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char sign) { return sign < ' ' || sign == 0x7f; }, '?');
  return name;
}

std::string about(const Shape& shape) {
  std::string words = shape.is_static ? "static shape" : "shape of " + text(shape.mass) + " kg";
  if (shape.is_respondable) words += ", respondable";
  std::size_t triangles = 0;
  for (const Part& part : shape.parts) triangles += part.triangles->size();
  return words + ", " + text(static_cast<double>(triangles)) + " triangles";
}

std::string about(const Joint& joint) {
  const char* type = joint.type == JointType::kRevolute    ? (joint.lead != 0 ? "screw" : "revolute joint")
                     : joint.type == JointType::kPrismatic ? "prismatic joint"
                                                           : "spherical joint";
  std::string words = type;
  if (!joint.is_dynamic) return words + (joint.is_dependent ? ", dependent" : ", kinematic");
  switch (joint.control) {
    case JointControl::kFree:
      return words + ", free";
    case JointControl::kForce:
      return words + ", force control";
    case JointControl::kVelocity:
      return words + ", velocity control, target " + text(joint.target_velocity);
    case JointControl::kPosition:
      return words + ", position control, target " + text(joint.target_position);
    case JointControl::kSpring:
      return words + ", spring";
    case JointControl::kCallback:
      return words + ", controlled by a callback";
  }
  return words;
}

std::string about(const Object& object) {
  if (const auto* shape = object.as<Shape>()) return about(*shape);
  if (const auto* joint = object.as<Joint>()) return about(*joint);
  if (const auto* sensor = object.as<ProximitySensor>()) return "proximity sensor, " + text(sensor->range) + " m";
  if (const auto* sensor = object.as<VisionSensor>()) {
    return std::string(sensor->is_perspective ? "" : "orthographic ") + "vision sensor, " +
           std::to_string(sensor->columns) + " x " + std::to_string(sensor->rows) + " pixels";
  }
  if (object.as<ForceSensor>() != nullptr) return "force sensor";
  if (object.as<Dummy>() != nullptr) return "dummy";
  if (object.as<Lamp>() != nullptr) return "light";
  static const std::map<std::string, std::string> others = {{"CMA", "camera of the editor"},
                                                            {"SCT", "script"},
                                                            {"GRH", "graph"},
                                                            {"PAT", "path"},
                                                            {"MIL", "mill"},
                                                            {"MIR", "mirror"},
                                                            {"OCT", "octree"},
                                                            {"PTC", "point cloud"},
                                                            {"MKR", "marker"},
                                                            {"CSO", "custom object"}};
  const auto found = others.find(object.tag);
  return found == others.end() ? "object" : found->second;
}

const char* kind_of(const Script& script) {
  switch (script.kind) {
    case ScriptKind::kMain:
      return "main script";
    case ScriptKind::kChild:
      return script.is_threaded ? "threaded child script" : "child script";
    case ScriptKind::kCustomization:
      return "customization script";
    case ScriptKind::kOther:
      break;
  }
  return "script";
}

}  // namespace

void describe(const SceneFile& file, const Structure& structure, std::ostream& out) {
  const int version = file.program_version;
  out << (file.is_scene ? "scene" : "model") << " of V" << version / 10000 << "." << version / 100 % 100 << "."
      << version % 100 << ", format " << file.serialization << ", " << structure.bodies.size() << " bodies, "
      << structure.connections.size() << " connections\n";
  if (file.is_scene) {
    out << "time step " << text(file.settings.time_step) << " s, engine step " << text(file.settings.engine_step)
        << " s, gravity " << text(file.settings.gravity) << "\n";
  }
  out << "\nTree:\n";
  std::vector<std::pair<int, int>> open;  // object, depth
  for (auto root = structure.roots.rbegin(); root != structure.roots.rend(); ++root) open.emplace_back(*root, 1);
  while (!open.empty()) {
    const auto [i, depth] = open.back();
    open.pop_back();
    const Object& object = file.objects[static_cast<std::size_t>(i)];
    constexpr int kDeepest = 40;  // deeper ones are shown there
    out << std::string(2U * static_cast<unsigned>(std::min(depth, kDeepest)), ' ') << shown(object.alias) << ": "
        << about(object) << (object.is_model ? ", model" : "") << "\n";
    const auto& children = structure.nodes[static_cast<std::size_t>(i)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) open.emplace_back(*child, depth + 1);
  }
  out << "\nScripts:\n";
  for (const Script& script : file.scripts) {
    const int owner = structure.place(script.object);
    const auto lines = std::count(script.text.begin(), script.text.end(), '\n') + 1;
    out << "  " << kind_of(script)
        << (owner == kNone ? "" : " of " + shown(file.objects[static_cast<std::size_t>(owner)].alias)) << ", "
        << (script.is_python ? "Python" : "Lua") << ", " << lines << " lines"
        << (script.is_disabled ? ", disabled" : "") << "\n";
  }
  const LeftOut left_out = left_out_of(file, structure);
  out << "\nLeft out or changed:\n";
  for (const std::string& line : left_out.lines()) out << "  " << line << "\n";
  if (left_out.empty()) out << "  nothing\n";
}

}  // namespace bubblesim::ttt
