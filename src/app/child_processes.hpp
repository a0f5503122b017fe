// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim::app {

/// Sends a signal to the programs that this process has started, and to the process groups that they lead.
void signal_child_processes(int signal);

}  // namespace bubblesim::app
