// SPDX-License-Identifier: BSD-3-Clause
// The elements that bubblesim adds to SDFormat, in the namespace `bubblesim:`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/math.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The text of one of bubblesim's elements, if the file has it.
std::optional<std::string> own_text(const SdfElement& parent, std::string_view name);

/// The number of one of bubblesim's elements, if the file has it; other text is reported for the object at `path`.
std::optional<double> own_number(const SdfElement& parent, std::string_view name, const std::string& path,
                                 LoadContext& context);

/// The three numbers of one of bubblesim's elements, if the file has it; other text is reported for the object at
/// `path`.
std::optional<Vector3> own_vector(const SdfElement& parent, std::string_view name, const std::string& path,
                                  LoadContext& context);

/// The numbers in a string, separated by spaces; empty when the text has other content.
std::optional<std::vector<double>> to_numbers(const std::string& text);

}  // namespace bubblesim
