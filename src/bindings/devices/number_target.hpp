// SPDX-License-Identifier: BSD-3-Clause
// What takes the numbers of messages without Python in between, such as the motors of a drive.
#pragma once

#include <functional>
#include <vector>

namespace bubblesim::bindings {

/// Called on the simulation's thread, without the GIL. Returns whether the numbers were usable.
struct NumberTarget {
  std::function<bool(const std::vector<double>&)> take;
};

}  // namespace bubblesim::bindings
