// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim {

/// Limits the log lines of roscpp's libraries about connections, which any peer can open: prints ten lines per minute
/// each of XML-RPC and of roscpp, then one line that more are suppressed. /rosout still gets all lines of roscpp.
/// Call it after ros::init(), before other threads log.
void limit_peer_lines();

}  // namespace bubblesim
