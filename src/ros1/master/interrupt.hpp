// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim {

/// Makes pending calls to the ROS master fail at once. roscpp sets no time limit, so a master that hangs would keep a
/// node from ending; shutting down the sockets of such calls is the only way to end them. For a process that is about
/// to end: also cancels any other connection attempt that hangs.
void interrupt_master_calls();

}  // namespace bubblesim
