// SPDX-License-Identifier: BSD-3-Clause
#include "validation/checker.hpp"

#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "bubblesim/scene_tree.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {

void Checker::at(const Source& source, std::string object) {
  source_ = source;
  object_ = as_path(std::move(object));
}

void Checker::report(std::string message) {
  problems_.push_back({source_.file, source_.line, object_, std::move(message)});
}

void Checker::require(bool fine, const std::string& what, const std::string& found, const std::string& wanted) {
  if (!fine) report(what + " is " + found + ", it must be " + wanted);
}

void Checker::check_pose(const Pose& pose) {
  require(within(pose.position, kMaxDistance), "the position", text(pose.position), "finite and within 1e6 m");
  require(within(pose.orientation.norm() - 1, 1e-3), "the orientation (x, y, z, w)", text(pose.orientation),
          "a rotation");
}

void Checker::check_length(const char* what, double value) {
  require(value > 0 && value <= kMaxSize, what, text(value) + " m", "above 0 and at most 1e5 m");
}

void Checker::check_color(const char* what, const Color& color) {
  const auto fine = [](float part) { return part >= 0 && part <= 1; };
  require(fine(color.r) && fine(color.g) && fine(color.b), what, text(Vector3(color.r, color.g, color.b)),
          "red, green and blue from 0 to 1");
}

void Checker::enter(const ModelDescription& model) {
  links_.clear();
  joints_.clear();
  for (const LinkDescription& link : model.links) links_.emplace(link.name, &link);
  for (const JointDescription& joint : model.joints) joints_.emplace(joint.name, &joint);
}

void Checker::check_link_name(const std::string& name, const std::string& role) {
  if (links_.count(name) > 0) return;
  std::vector<std::string> names;
  for (const auto& [known, link] : links_) names.emplace_back(known);
  report("the " + role + " '" + name + "' is not a link of this model" + did_you_mean(name, names));
}

const JointDescription* Checker::joint_named(const std::string& name) const {
  const auto found = joints_.find(name);
  return found == joints_.end() ? nullptr : found->second;
}

}  // namespace bubblesim
