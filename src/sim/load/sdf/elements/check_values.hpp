// SPDX-License-Identifier: BSD-3-Clause
// Compares elements with the table: names, values, and what is left out.
#pragma once

#include <string>

#include "load/load_context.hpp"
#include "load/sdf/elements/element_kinds.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// Checks the value of an element and all elements below it; `path` is that of its object. A value that cannot be read
/// is replaced: by what Gazebo would use or by the default, with a warning, or with a problem where that would change
/// the meaning. Warns about unknown elements and those that are left out; reports elements of bubblesim that are
/// unknown, in the wrong place, or twice in their parent. The content of plugins is not checked.
void check_values(XmlElement& element, const ElementKind& kind, const std::string& path, LoadContext& context);

}  // namespace bubblesim
