// SPDX-License-Identifier: BSD-3-Clause
// Reads a document with the files that it includes, up to the element tree that the readers of models take.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "load/load_context.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// What is left of an <include> of a file of CoppeliaSim in a world: its <uri> is the file, its name is given.
constexpr const char* kForeignInclude = "foreign_include";

/// Reads each file once: it is parsed, brought to the newest version, checked, and its <include>s are replaced by the
/// models, with what the <include> changes of them. An <include> of URDF stays, with the file as its <uri>; the model
/// is in LoadContext::included_robots(). An <include> of a file of CoppeliaSim becomes a kForeignInclude. Models that
/// are not found are left out, with a warning; a file of CoppeliaSim that is not found is an error.
class Documents {
 public:
  explicit Documents(LoadContext& context) : context_(context) {}

  /// The root of a document, <sdf> or <robot>; a <robot> is as in the file. Throws SceneError when it is neither, or
  /// when a file includes itself, is not a regular file, is too large, or when there are too many elements.
  XmlElement read(const std::string& text, const std::string& file);

 private:
  /// A file that is included.
  struct Included {
    XmlElement model;  // <model>, <light> or <actor>; or <robot>
    std::size_t elements = 0;
  };

  void prepare(XmlElement& sdf);
  void expand_includes(XmlElement& parent, const std::string& path);
  void expand(const XmlElement& include, std::vector<XmlElement>& into);
  XmlElement foreign(const XmlElement& include, const XmlElement& parent);
  const Included* find(const XmlElement& include);
  std::filesystem::path file_of(const std::string& uri, const XmlElement& include);
  std::filesystem::path file_in(const std::filesystem::path& folder, const XmlElement& include);
  void merge(const XmlElement& include, const XmlElement& model, std::vector<XmlElement>& into);
  std::string read_file(const std::filesystem::path& file);

  LoadContext& context_;
  std::map<std::string, Included> included_;  // by file
  std::vector<std::string> open_;             // the files whose content is being read, from the outermost
  std::size_t elements_ = 0;
};

/// Throws SceneError when the file is larger than the limit, 100 MB.
void check_size(const std::filesystem::path& file);

}  // namespace bubblesim
