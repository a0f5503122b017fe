// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim {

/// Limits what roscpp's libraries log about connections, which anybody can open: of the lines of XML-RPC and of those
/// of roscpp itself, ten each a minute are printed, then one that more are left out. /rosout still gets all of
/// roscpp's. Call it after ros::init(), before other threads log.
void limit_peer_lines();

}  // namespace bubblesim
