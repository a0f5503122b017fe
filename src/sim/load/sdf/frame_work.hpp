// SPDX-License-Identifier: BSD-3-Clause
// Limits the time that SDFormat takes to resolve the poses of links, joints and frames of a model: for each it visits
// all of them, once per step to the world.
#pragma once

#include <tinyxml2.h>

#include <string>

namespace bubblesim {

/// The error of a <model> or <robot> that would take minutes; empty for all others and for other elements.
std::string frame_work_problem(const tinyxml2::XMLElement& model);

}  // namespace bubblesim
