// SPDX-License-Identifier: BSD-3-Clause
// Which elements SDFormat has, with types and defaults, and what becomes of each here: one table for reading, checking,
// warnings and documentation.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace bubblesim {

enum class ValueType {
  kNone,  ///< child elements only
  kAny,   ///< any content, which is not checked
  kText,
  kFlag,
  kInteger,
  kNumber,
  kVector2,
  kVector3,
  kColor,
  kPose,
};

/// Its name in the table.
std::string type_name(ValueType type);

/// What becomes of an element.
enum class Effect {
  kRead,
  kNone,     ///< it is for other programs or has no meaning here
  kLeftOut,  ///< the simulation differs from what the file asks for: a warning
};

struct AttributeKind {
  std::string name;
  ValueType type = ValueType::kText;
  std::string default_text;
};

struct ElementKind {
  std::string name;
  ValueType type = ValueType::kNone;
  std::string default_text;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool required = false;  ///< a value that cannot be read is an error: the default would change the meaning
  Effect effect = Effect::kRead;
  std::string reason;  ///< why it is left out
  std::vector<AttributeKind> attributes;
  std::vector<const ElementKind*> children;

  /// Null when the element has no such child.
  const ElementKind* child(std::string_view child_name) const;
  const AttributeKind* attribute(std::string_view attribute_name) const;
};

/// <sdf>, with all elements below. Elements of SDFormat 1.0 to 1.12 under their newest names, and those of bubblesim.
const ElementKind& sdf_kind();
// Elements below it.
const ElementKind& world_kind();
const ElementKind& model_kind();
const ElementKind& link_kind();
const ElementKind& joint_kind();
const ElementKind& light_kind();

/// Whether an element is one that bubblesim adds to SDFormat, by its prefix.
bool is_own_element(std::string_view name);

/// The names of the elements that may have bubblesim's element as a child, in the order of the table.
std::vector<std::string> parents_of_own(std::string_view name);

/// The names of all of bubblesim's elements, sorted.
std::vector<std::string> own_elements();

}  // namespace bubblesim
