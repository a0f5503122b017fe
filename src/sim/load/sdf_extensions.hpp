// SPDX-License-Identifier: BSD-3-Clause
// The elements that bubblesim adds to SDFormat, in the namespace `bubblesim:`.
#pragma once

#include <optional>
#include <sdf/Element.hh>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/math.hpp"

namespace bubblesim {

/// The text without white space at its ends.
std::string trimmed(const std::string& text);

/// The numbers in a text, separated by spaces; empty when the text has other content.
std::optional<std::vector<double>> to_numbers(const std::string& text);

/// The only element of the namespace that may occur several times in its parent.
inline constexpr const char* kRandomize = "bubblesim:randomize";

bool is_own_element(const std::string& name);

/// Reports elements of the namespace, anywhere below `root`, that are unknown, in the wrong place or occur twice.
void check_own_elements(const sdf::ElementPtr& root, std::vector<Problem>& problems);

/// The text of a bubblesim element, if it exists.
std::optional<std::string> own_text(const sdf::ElementPtr& parent, const std::string& name);

/// The three numbers of a bubblesim element, if it exists; other text is reported.
std::optional<Vector3> own_vector(const sdf::ElementPtr& parent, const std::string& name,
                                  std::vector<Problem>& problems);

/// The number of a bubblesim element, if it exists; other text is reported.
std::optional<double> own_number(const sdf::ElementPtr& parent, const std::string& name,
                                 std::vector<Problem>& problems);

}  // namespace bubblesim
