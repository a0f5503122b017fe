// SPDX-License-Identifier: BSD-3-Clause
// An XML element as a plain value. Each knows its file and line, also after it was moved into another document, so that
// errors refer to the user's file.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

struct XmlAttribute {
  std::string name;
  std::string value;
};

struct XmlElement {
  std::string name;  ///< with its prefix: bubblesim:alias
  std::string text;  ///< all text directly inside, without white space at its ends
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::shared_ptr<const std::string> file;  ///< its name in errors
  int line = 0;

  Source source() const { return {file != nullptr ? *file : std::string(), line}; }

  /// The value of an attribute; null when it is not set.
  const std::string* attribute(std::string_view name) const;
  void set_attribute(std::string_view name, std::string value);
  void remove_attribute(std::string_view name);
  /// The `name` attribute, or an empty string.
  const std::string& given_name() const;

  /// The first child of that name; null when there is none.
  const XmlElement* child(std::string_view name) const;
  XmlElement* child(std::string_view name);
  /// The text of the first child of that name, or an empty string.
  const std::string& child_text(std::string_view name) const;
  /// Appends a child in the line of this element.
  XmlElement& add_child(std::string name, std::string text = "");
  void remove_children(std::string_view name);
  /// Removes the children of the same name and appends this one.
  void replace_child(XmlElement replacement);
};

/// The number of elements, with all below.
std::size_t count_elements(const XmlElement& element);

}  // namespace bubblesim
