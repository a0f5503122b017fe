// SPDX-License-Identifier: BSD-3-Clause
// Collects the problems of a description, with the object that is being checked.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

class Checker {
 public:
  void at(const Source& source, std::string object);
  void report(std::string message);
  void require(bool fine, const std::string& what, const std::string& found, const std::string& wanted);

  void check_pose(const Pose& pose);
  void check_length(const char* what, double value);
  void check_color(const char* what, const Color& color);
  /// From here on, links and joints are those of this model.
  void enter(const ModelDescription& model);
  /// Reports a problem unless the model has a link of this name.
  void check_link_name(const std::string& name, const std::string& role);
  /// Null when the model has no such joint.
  const JointDescription* joint_named(const std::string& name) const;

  bool found_any() const { return !problems_.empty(); }
  std::vector<Problem> found() { return std::move(problems_); }

 private:
  Source source_;
  std::string object_;
  std::vector<Problem> problems_;
  std::unordered_map<std::string_view, const LinkDescription*> links_;  // by name, of the model
  std::unordered_map<std::string_view, const JointDescription*> joints_;
};

/// The checks of each file; they set the checker's object with at().
void check_shapes(Checker& checker, const ModelDescription& model, const LinkDescription& link,
                  const std::string& path);
void check_sensors(Checker& checker, const LinkDescription& link, const std::string& path);
void check_sensors(Checker& checker, const JointDescription& joint, const std::string& path);
void check_joint(Checker& checker, const ModelDescription& model, const JointDescription& joint);
void check_places(Checker& checker, const SceneDescription& scene);
/// Of a model alone, whose objects may have had their parents elsewhere.
void check_places(Checker& checker, const ModelDescription& model);

}  // namespace bubblesim
