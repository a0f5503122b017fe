// SPDX-License-Identifier: BSD-3-Clause
// Where an element of SDFormat was written, and how readers of elements tell what is wrong there.
#pragma once

#include <functional>
#include <sdf/Element.hh>
#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

using Report = std::function<void(const Source&, std::string message)>;

inline Source source_of(const sdf::ElementPtr& element) {
  return {element->FilePath(), element->LineNumber().value_or(0)};
}

/// The child `name` of an element where it is written, or the element itself.
inline Source source_of(const sdf::ElementPtr& element, const std::string& name) {
  const Source own = element->HasElement(name) ? source_of(element->GetElement(name)) : Source{};
  return own.line > 0 ? own : source_of(element);
}

}  // namespace bubblesim
