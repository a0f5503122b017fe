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

bool is_own_element(const std::string& name);

/// Reports elements of our namespace that do not exist, stand in the wrong place or there twice, anywhere below `root`.
void check_own_elements(const sdf::ElementPtr& root, std::vector<Problem>& problems);

/// The text of one of our elements, if it is there.
std::optional<std::string> own_text(const sdf::ElementPtr& parent, const std::string& name);

/// The three numbers in one of our elements, if it is there; a text that is none is reported.
std::optional<Vector3> own_vector(const sdf::ElementPtr& parent, const std::string& name,
                                  std::vector<Problem>& problems);

/// The number in one of our elements, if it is there; a text that is no number is reported.
std::optional<double> own_number(const sdf::ElementPtr& parent, const std::string& name,
                                 std::vector<Problem>& problems);

}  // namespace bubblesim
