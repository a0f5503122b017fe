// SPDX-License-Identifier: BSD-3-Clause
// An element of SDFormat with its line in the table of elements: its children and values, or their defaults.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "load/sdf/elements/element_kinds.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// Refers to an element that may be absent: then it has no children, and its values are the defaults. Names must be in
/// the table; a wrong one is an error of this program (std::logic_error). Values were checked before
/// (check_values.hpp).
class SdfElement {
 public:
  SdfElement(const XmlElement* xml, const ElementKind& kind) : xml_(xml), kind_(&kind) {}

  /// Whether the file has it.
  explicit operator bool() const { return xml_ != nullptr; }
  const XmlElement& xml() const { return *xml_; }
  const ElementKind& kind() const { return *kind_; }
  /// Its `name` attribute, or an empty string.
  std::string name() const { return xml_ != nullptr ? xml_->given_name() : std::string(); }
  /// Its place; an absent element has none.
  Source source() const { return xml_ != nullptr ? xml_->source() : Source{}; }
  /// The place of the child if the file has it, otherwise that of the element.
  Source source(std::string_view child) const;

  bool has(std::string_view child) const { return xml_ != nullptr && xml_->child(child) != nullptr; }
  /// The first child of that name, which may be absent.
  SdfElement child(std::string_view name) const;
  std::vector<SdfElement> children(std::string_view name) const;
  /// An attribute or its default.
  std::string attribute(std::string_view name) const;
  bool has_attribute(std::string_view name) const { return xml_ != nullptr && xml_->attribute(name) != nullptr; }

  // The value of a child or its default.
  double number(std::string_view child) const { return this->child(child).as_number(); }
  bool flag(std::string_view child) const { return this->child(child).as_flag(); }
  std::string text(std::string_view child) const { return this->child(child).as_text(); }
  Vector3 vector(std::string_view child) const { return this->child(child).as_vector(); }
  Color color(std::string_view child) const { return this->child(child).as_color(); }

  // Its own value or default.
  double as_number() const;
  bool as_flag() const;
  const std::string& as_text() const;
  Vector3 as_vector() const;
  Eigen::Vector2d as_vector2() const;
  Color as_color() const;
  Pose as_pose() const;  ///< as written, without regard to `relative_to`

 private:
  const ElementKind& kind_of(std::string_view child) const;

  const XmlElement* xml_;
  const ElementKind* kind_;
};

/// Whether a string is that of a set flag: true or 1.
bool is_true(std::string_view text);

/// The numbers with as many digits as are needed to read the same numbers, separated by spaces.
std::string write_numbers(const std::vector<double>& numbers);

}  // namespace bubblesim
