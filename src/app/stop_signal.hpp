// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM as a flag that the main loop reads.
#pragma once

namespace bubblesim::app {

/// From now on SIGINT and SIGTERM set stop_requested(); a second one ends the process at once.
void watch_stop_signals();
bool stop_requested();

}  // namespace bubblesim::app
