// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim::app {

/// Sends a signal to the child processes of this process and to the process groups that they lead.
void signal_child_processes(int signal);

}  // namespace bubblesim::app
