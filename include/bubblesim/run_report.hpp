// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace bubblesim {

/// Statistics of a running simulation since the previous report.
struct RunReport {
  bool running = false;        ///< false: paused, stopped or ended
  std::string state;           ///< one word, such as "running"
  std::string failure;         ///< why the run failed; empty if it did not
  double wanted_speed = 1;     ///< requested simulated seconds per second; infinity: as fast as possible
  double simulation_time = 0;  ///< s
  std::uint64_t steps = 0;     ///< completed since the previous report
  double simulated_time = 0;   ///< s, simulated by these steps
  double wall_time = 0;        ///< s, duration of these steps including the waits between them
  double step_time = 0;        ///< s, duration of these steps without the waits
  double longest_step = 0;     ///< s
  double since_last_step = 0;  ///< s since the last step ended, while running
  int disabled_scripts = 0;    ///< failed and not reloaded yet
  int script_errors = 0;       ///< since the node was started
  std::uint64_t measurements =
      0;  ///< of all sensors since the start of the node; sensors without readers do not measure
};

}  // namespace bubblesim
