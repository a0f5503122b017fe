// SPDX-License-Identifier: BSD-3-Clause
// How long SDFormat takes to place the links, joints and frames of a model: for each it looks at all of them, once for
// each step of the way to the world.
#pragma once

#include <tinyxml2.h>

#include <string>

namespace bubblesim {

/// What is wrong with a <model> or <robot> that would take minutes; empty for all others and for other elements.
std::string frame_work_problem(const tinyxml2::XMLElement& model);

}  // namespace bubblesim
