// SPDX-License-Identifier: BSD-3-Clause
// Prints the warnings of the loader, for programs: the library prints nothing.
#pragma once

#include <cstdio>
#include <vector>

#include "bubblesim/error.hpp"

namespace bubblesim {

/// Writes each as a line `warning: file:line: /Object: message` to stderr.
inline void print_warnings(const std::vector<Problem>& warnings) {
  for (const Problem& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.text().c_str());
}

}  // namespace bubblesim
