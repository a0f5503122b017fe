// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// Puts /use_sim_time back at the end of a launch file that has set it for the simulator. The file keeps what it was
/// in the parameter ~use_sim_time_before: "true", "false" or "unset"; without that, nothing is put back. All calls wait
/// for the master.
class UseSimTime {
 public:
  /// Takes the parameter from the master: it belongs to this run of the node alone.
  void take();
  /// Before the node leaves the master; nothing when another has taken its name, for that one goes on.
  void restore() const;

 private:
  std::string before_;
};

}  // namespace bubblesim
