// SPDX-License-Identifier: BSD-3-Clause
// Location of an SDFormat element, for error messages.
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

/// The location of the child element `name` if it exists, otherwise that of the element.
inline Source source_of(const sdf::ElementPtr& element, const std::string& name) {
  const Source own = element->HasElement(name) ? source_of(element->GetElement(name)) : Source{};
  return own.line > 0 ? own : source_of(element);
}

}  // namespace bubblesim
