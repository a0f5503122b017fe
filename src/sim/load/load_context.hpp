// SPDX-License-Identifier: BSD-3-Clause
// What the readers of SDFormat's elements share: the file that is being read and all that is wrong with it.
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
  /// Of a file, whose neighbours are the scene's own files. Throws as SceneXml does.
  explicit LoadContext(const std::filesystem::path& file) : xml_(file), folder_(file.parent_path()) {}
  /// Of a text that errors call `name`; its own files are in `folder`.
  LoadContext(const std::string& text, std::string name, std::filesystem::path folder)
      : xml_(text, std::move(name)), folder_(std::move(folder)) {}

  const SceneXml& xml() const { return xml_; }
  SceneXml& xml() { return xml_; }
  /// In which the scene's own files are.
  const std::filesystem::path& folder() const { return folder_; }
  std::vector<Problem>& problems() { return problems_; }
  MeshReader& meshes() { return meshes_; }

  void report(const Source& source, const std::string& object, std::string message);
  /// Says on stderr what is odd but stops nothing.
  static void warn(const Source& source, const std::string& object, std::string message);
  /// Takes over what SDFormat found wrong while it read the object at that path, or the whole file when it is empty.
  void take(const sdf::Errors& errors, const std::string& object);

  /// ` (searched in ...)`, for a model that is not found.
  std::string where_models_are() const;

  /// The pose of an element in the frame named, by default in the one of what holds it.
  template <class T>
  Pose resolved(const T& element, const std::string& object, const std::string& frame = "") {
    Pose pose;
    take(element.SemanticPose().Resolve(pose, frame), object);
    return pose;
  }

 private:
  SceneXml xml_;
  std::filesystem::path folder_;
  bool frames_broken_ = false;  // SDFormat found errors that are no fault of a single object
  std::vector<Problem> problems_;
  MeshReader meshes_;
};

}  // namespace bubblesim
