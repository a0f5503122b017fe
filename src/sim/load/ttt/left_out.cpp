// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/left_out.hpp"

#include <algorithm>
#include <set>

#include "load/ttt/main_script.hpp"
#include "load/ttt/names.hpp"
#include "load/ttt/script_files.hpp"
#include "load/ttt/write_joints.hpp"

namespace bubblesim::ttt {
namespace {

std::string object_kind(const Object& object) {
  static const std::map<std::string, std::string> kinds = {
      {"GRH", "graph: not shown"},
      {"MIL", "mill: no effect"},
      {"MIR", "mirror: not shown"},
      {"OCT", "octree: not shown, nothing collides with it"},
      {"PTC", "point cloud: not shown, nothing collides with it"},
      {"MKR", "marker: not shown"},
      {"CSO", "custom object: no effect"},
  };
  const auto found = kinds.find(object.tag);
  return found == kinds.end() ? "" : found->second;
}

void add_joints(const SceneFile& file, const Structure& structure, LeftOut& left_out) {
  std::set<int> simulated;
  for (const Connection& connection : structure.connections) simulated.insert(connection.object);
  for (std::size_t i = 0; i < file.objects.size(); ++i) {
    const Joint* joint = file.objects[i].as<Joint>();
    if (joint == nullptr) continue;
    const std::string& alias = file.objects[i].alias;
    if (simulated.count(static_cast<int>(i)) > 0 && is_left_over(*joint)) {
      left_out.add("joint with a target velocity that is left over from a run: it starts at rest", alias);
    }
    const bool has_memory = joint->gains[1] != 0 || joint->gains[2] != 0;
    if (simulated.count(static_cast<int>(i)) > 0 && joint->control == JointControl::kPosition && has_memory) {
      left_out.add("position control with gains I or D: only P counts", alias);
    }
  }
}

/// A main script of the scene's own, unless it does what the default one does.
void add_main_script(const Script& script, LeftOut& left_out) {
  constexpr std::size_t kShown = 6;
  const std::set<std::string> calls = calls_beside_phases(script.text);
  if (calls.empty() && !script.is_python) return;
  std::string names;
  std::size_t shown = 0;
  for (const std::string& call : calls) {
    if (shown++ == kShown) break;
    names += (names.empty() ? "" : ", ") + call;
  }
  if (calls.size() > kShown) names += " ...";
  left_out.add("main script: the default phases run" + (names.empty() ? "" : ", without its calls of " + names), "");
}

}  // namespace

std::vector<std::string> LeftOut::lines() const {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> lines;
  for (const auto& [what, objects] : objects_) {
    std::string line = std::to_string(objects.size()) + " x " + what;
    for (std::size_t i = 0; i < std::min(objects.size(), kShown); ++i) {
      if (!objects[i].empty()) line += (i == 0 ? " (" : ", ") + plain_name(objects[i]);
    }
    if (!objects.front().empty()) line += objects.size() > kShown ? ", ...)" : ")";
    lines.push_back(std::move(line));
  }
  return lines;
}

LeftOut left_out_of(const SceneFile& file, const Structure& structure) {
  LeftOut left_out;
  for (const Object& object : file.objects) {
    if (const std::string kind = object_kind(object); !kind.empty()) left_out.add(kind, object.alias);
    if (const auto* sensor = object.as<VisionSensor>()) {
      if (sensor->has_filters) left_out.add("image filters of a vision sensor: not applied", object.alias);
    }
    if (const auto* sensor = object.as<ForceSensor>(); sensor != nullptr && sensor->can_break) {
      left_out.add("force sensor that breaks: it holds", object.alias);
    }
  }
  add_joints(file, structure, left_out);
  for (const Script& script : file.scripts) {
    const int owner = structure.place(script.object);
    const std::string alias = owner == kNone ? "" : file.objects[static_cast<std::size_t>(owner)].alias;
    if (script.kind == ScriptKind::kMain && !script.is_default_main) add_main_script(script, left_out);
    if (script.kind == ScriptKind::kCustomization && !is_run(script))
      left_out.add("customization script: not run", alias);
    if (script.kind == ScriptKind::kChild && script.is_disabled)
      left_out.add("script that is disabled: not run", alias);
  }
  for (const DamagedPart& part : file.damaged) left_out.add("damaged part that is left out: " + part.what, part.object);
  for (const auto& [what, count] : file.left_out) {
    for (int i = 0; i < count; ++i) left_out.add(what + ": left out", "");
  }
  return left_out;
}

}  // namespace bubblesim::ttt
