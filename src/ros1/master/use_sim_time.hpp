// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// Restores /use_sim_time at the end of a launch file that has set it for the simulator. The launch file stores the
/// previous value in the parameter ~use_sim_time_before: "true", "false" or "unset"; without it, nothing is restored.
/// All calls wait for the master.
class UseSimTime {
 public:
  /// Reads and deletes the parameter: it belongs to this run of the node only.
  void take();
  /// Call it before the node leaves the master. Does nothing if another node took its name, because that one continues.
  void restore() const;

 private:
  std::string before_;
};

}  // namespace bubblesim
