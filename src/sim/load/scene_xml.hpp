// SPDX-License-Identifier: BSD-3-Clause
// A scene file as plain XML, for line numbers that SDFormat does not have.
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
  /// Throws SceneError when the file is not XML or not a scene.
  explicit SceneXml(const std::filesystem::path& file);
  /// The same for the text of a file; `name` is its name in errors.
  SceneXml(const std::string& text, std::string name);

  /// Sets the lines of elements below `root` that SDFormat does not know, because it copies them without; and the file
  /// name of all elements of a text without a file.
  void place_elements(const sdf::ElementPtr& root) const;

  /// The location of an element with this name and text: SDFormat does not store locations of the content of an
  /// <include>.
  Source place_of(const std::string& element, const std::string& text) const;

  /// The path of the object that an element in this line of the file belongs to, or empty.
  std::string object_at(const std::string& file, int line) const;

  const tinyxml2::XMLDocument& document() const { return document_; }
  tinyxml2::XMLDocument& document() { return document_; }
  /// Declares that SDFormat reads `copy` in place of `original`; errors name the original.
  void stands_for(const std::filesystem::path& copy, const std::filesystem::path& original);
  /// Its name in errors.
  const std::string& file() const { return file_; }
  /// Whether it is URDF, which SDFormat converts.
  bool is_urdf() const;

  /// SDFormat's errors without consequential errors, with lines where they are known. `object` is the path of the
  /// object that was being read, or empty.
  std::vector<Problem> located(const sdf::Errors& errors, const std::string& object) const;

 private:
  void read(const std::string& text);
  std::string original_of(const std::string& file) const;
  std::string file_of(const sdf::Error& error) const;
  int line_of_named(const std::string& message) const;
  int line_of_object(const std::string& path) const;
  std::string unusable_text(const std::string& element, int line) const;

  std::string file_;
  std::map<std::string, std::string> originals_;  // by the copies that replace them
  tinyxml2::XMLDocument document_;
};

}  // namespace bubblesim
