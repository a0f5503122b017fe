// SPDX-License-Identifier: BSD-3-Clause
// Shared state of the readers of elements: the file that is being read, its problems and warnings.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "meshes/mesh_reader.hpp"

namespace bubblesim {

class LoadContext {
 public:
  /// `file` is its name in errors; the files it refers to are in `folder`.
  LoadContext(std::string file, std::filesystem::path folder) : file_(std::move(file)), folder_(std::move(folder)) {}

  const std::string& file() const { return file_; }
  /// The folder of the scene's files.
  const std::filesystem::path& folder() const { return folder_; }
  /// The folder of the files that an element refers to: that of its own file, or the scene's for a string without a
  /// file.
  std::filesystem::path folder_of(const Source& source) const;
  std::vector<Problem>& problems() { return problems_; }
  std::vector<Problem>& warnings() { return warnings_; }
  MeshReader& meshes() { return meshes_; }
  /// The models of URDF files that are included, by their file.
  std::map<std::string, ModelDescription>& included_robots() { return included_robots_; }
  /// Of the models of the world that have no <bubblesim:axis_convention> themselves.
  AxisConvention& axes() { return axes_; }

  void report(const Source& source, const std::string& object, std::string message);
  void warn(const Source& source, const std::string& object, std::string message);

  /// Returns `; did you mean ...? (searched in ...)`, for a model that is not found.
  std::string where_models_are(const std::string& uri) const;

 private:
  std::string file_;
  std::filesystem::path folder_;
  std::vector<Problem> problems_;
  std::vector<Problem> warnings_;
  MeshReader meshes_;
  std::map<std::string, ModelDescription> included_robots_;
  AxisConvention axes_ = AxisConvention::kSdformat;
};

}  // namespace bubblesim
