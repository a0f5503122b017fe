// SPDX-License-Identifier: BSD-3-Clause
// A scene file as plain XML: where things are written that SDFormat does not know the place of.
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <map>
#include <sdf/Element.hh>
#include <sdf/Error.hh>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

class SceneXml {
 public:
  /// Throws SceneError when the file is no XML or no scene.
  explicit SceneXml(const std::filesystem::path& file);
  /// The same from the text of a file; `name` is what errors call it.
  SceneXml(const std::string& text, std::string name);

  /// Gives elements below `root` that SDFormat does not know their lines, for it copies those without; and
  /// all elements the name of a text that came from no file.
  void place_elements(const sdf::ElementPtr& root) const;

  /// Where an element of this name and text is written: SDFormat keeps no places of what stands in an <include>.
  Source place_of(const std::string& element, const std::string& text) const;

  const tinyxml2::XMLDocument& document() const { return document_; }
  tinyxml2::XMLDocument& document() { return document_; }
  /// SDFormat reads `copy` in place of `original`, which errors name.
  void stands_for(const std::filesystem::path& copy, const std::filesystem::path& original);
  /// What errors call it.
  const std::string& file() const { return file_; }
  /// Whether it is a robot in URDF, which SDFormat converts.
  bool is_urdf() const;

  /// What SDFormat found wrong, without what only follows from it, and with lines where they can be told.
  /// `object` is the path of the object that was being read, or empty.
  std::vector<Problem> located(const sdf::Errors& errors, const std::string& object) const;

 private:
  void read(const std::string& text);
  std::string original_of(const std::string& file) const;
  std::string file_of(const sdf::Error& error) const;
  int line_of_named(const std::string& message) const;
  int line_of_object(const std::string& path) const;
  std::string unusable_text(const std::string& element, int line) const;

  std::string file_;
  std::map<std::string, std::string> originals_;  // by the copies that are read in their place
  tinyxml2::XMLDocument document_;
};

}  // namespace bubblesim
