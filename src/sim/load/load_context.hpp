// SPDX-License-Identifier: BSD-3-Clause
// Shared state of the readers of SDFormat's elements: the file that is being read, its problems and warnings.
#pragma once

#include <filesystem>
#include <sdf/Error.hh>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "load/scene_xml.hpp"
#include "meshes/mesh_reader.hpp"

namespace bubblesim {

class LoadContext {
 public:
  /// For a file. The files it refers to are in the same folder. Throws like SceneXml.
  explicit LoadContext(const std::filesystem::path& file) : xml_(file), folder_(file.parent_path()) {}
  /// For a text. `name` is its name in errors; the files it refers to are in `folder`.
  LoadContext(const std::string& text, std::string name, std::filesystem::path folder)
      : xml_(text, std::move(name)), folder_(std::move(folder)) {}

  const SceneXml& xml() const { return xml_; }
  SceneXml& xml() { return xml_; }
  /// The folder of the scene's files.
  const std::filesystem::path& folder() const { return folder_; }
  std::vector<Problem>& problems() { return problems_; }
  std::vector<Problem>& warnings() { return warnings_; }
  MeshReader& meshes() { return meshes_; }
  /// Of the models of the world that have no <bubblesim:axis_convention> themselves.
  AxisConvention& axes() { return axes_; }

  void report(const Source& source, const std::string& object, std::string message);
  void warn(const Source& source, const std::string& object, std::string message);
  /// Adds SDFormat's errors of the object at that path, or of the whole file when the path is empty.
  void take(const sdf::Errors& errors, const std::string& object);

  /// Returns ` (searched in ...)`, for a model that is not found.
  std::string where_models_are() const;

  /// The pose of an element in the named frame, by default in the frame of its parent.
  template <class T>
  Pose resolved(const T& element, const std::string& object, const std::string& frame = "") {
    Pose pose;
    take(element.SemanticPose().Resolve(pose, frame), object);
    return pose;
  }

 private:
  SceneXml xml_;
  std::filesystem::path folder_;
  bool frames_broken_ = false;  // SDFormat found errors that concern no single object
  std::vector<Problem> problems_;
  std::vector<Problem> warnings_;
  MeshReader meshes_;
  AxisConvention axes_ = AxisConvention::kSdformat;
};

}  // namespace bubblesim
