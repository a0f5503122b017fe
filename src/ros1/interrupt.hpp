// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim {

/// Makes calls to the ROS master that wait for an answer fail at once. roscpp gives them no time limit, so a master
/// that hangs would keep a node from ending; shutting down the sockets under such calls is the only way to end them.
/// Meant for a process that is about to end: any other connection attempt that hangs is broken off too.
void interrupt_master_calls();

}  // namespace bubblesim
