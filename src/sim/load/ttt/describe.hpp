// SPDX-License-Identifier: BSD-3-Clause
// A file as text for people.
#pragma once

#include <iosfwd>

#include "load/ttt/structure.hpp"

namespace bubblesim::ttt {

/// Writes the tree with joints and sensors, the scripts, and what does not come over. Control characters of names and
/// strings are replaced.
void describe(const SceneFile& file, const Structure& structure, std::ostream& out);

}  // namespace bubblesim::ttt
