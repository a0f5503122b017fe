// SPDX-License-Identifier: BSD-3-Clause
// Where a part of a scene stands in a file.
#pragma once

#include <string>

namespace bubblesim {

/// Location in a file, for error messages.
struct Source {
  std::string file;
  int line = 0;
};

}  // namespace bubblesim
