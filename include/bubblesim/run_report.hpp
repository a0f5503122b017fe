// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace bubblesim {

/// How a simulation has been running since the report before, for those who watch over it.
struct RunReport {
  bool running = false;            ///< or paused, stopped, ended
  std::string state;               ///< in a word
  std::string failure;             ///< why it has ended for good; empty while it has not
  double wanted_speed = 1;         ///< simulated seconds per second; infinity: as fast as it goes
  double simulation_time = 0;      ///< s
  std::uint64_t steps = 0;         ///< that ended since the report before
  double simulated_time = 0;       ///< s, by these steps
  double wall_time = 0;            ///< s that they took with the waits between them
  double step_time = 0;            ///< s that they took without
  double longest_step = 0;         ///< s
  double since_last_step = 0;      ///< s without the end of a step, while running
  int disabled_scripts = 0;        ///< that have failed and are not loaded again yet
  int script_errors = 0;           ///< since the node was started
  std::uint64_t measurements = 0;  ///< of all sensors, since the node was started; what nobody reads does not measure
};

}  // namespace bubblesim
