// SPDX-License-Identifier: BSD-3-Clause
// Repairs files that Gazebo accepts and SDFormat does not, before SDFormat reads them.
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "load/load_context.hpp"

namespace bubblesim {

/// Warns about changes, and reports unusable files. Included files that it changes are copied to a temporary folder,
/// which exists during its lifetime.
class SdfRepairs {
 public:
  explicit SdfRepairs(LoadContext& reading) : reading_(reading) {}
  ~SdfRepairs();
  SdfRepairs(const SdfRepairs&) = delete;
  SdfRepairs& operator=(const SdfRepairs&) = delete;

  /// The text of the scene for SDFormat; empty when SDFormat can read the file itself.
  std::optional<std::string> repaired_scene();

 private:
  /// A model that a file includes.
  struct Included {
    std::filesystem::path file;    // the file to read
    bool is_changed = false;       // it differs from the original file
    std::string name;              // of the model
    std::set<std::string> frames;  // its links, joints, frames and models; those in nested models as inner::link
  };

  void warn(const std::string& file, const tinyxml2::XMLElement& element, const std::string& message);
  bool repair(tinyxml2::XMLElement& sdf, const std::string& file);
  bool repair_below(tinyxml2::XMLElement& parent, const std::string& file);
  bool repair_script(tinyxml2::XMLElement& script, const std::string& file);
  bool repair_uri(tinyxml2::XMLElement& uri, const std::string& file);
  bool leave_out_missing(tinyxml2::XMLElement& world, const std::string& file);
  bool number_models(tinyxml2::XMLElement& parent, const std::string& file);
  bool repair_joints(tinyxml2::XMLElement& model, const std::string& file);
  std::string name_of(const tinyxml2::XMLElement& include);
  std::set<std::string> frames_in(const tinyxml2::XMLElement& model);
  /// Null when the file does not exist or cannot be read.
  const Included* included(const tinyxml2::XMLElement& include);
  void read_included(const std::filesystem::path& file, Included& included);
  std::filesystem::path keep(const std::filesystem::path& original, const std::string& text);

  LoadContext& reading_;
  std::map<std::filesystem::path, Included> included_;
  std::filesystem::path folder_;  // empty until a copy is made
};

}  // namespace bubblesim
