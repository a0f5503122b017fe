// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim {

/// Limits the log lines of roscpp about connections, which any peer can open: prints ten per minute, then one line that
/// more are suppressed. /rosout still gets all that is logged.
/// Call it after ros::init(), before other threads log.
void limit_peer_lines();

}  // namespace bubblesim
