// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// Returns why this node must not register at the master: another node of its name runs, which the master would shut
/// down. Empty if there is none, or only a killed one that no longer accepts connections.
std::string other_node_of_this_name();

/// Returns whether a node that the master knows runs: one that was killed does not take connections.
bool node_takes_connections(const std::string& node);

/// Requests that node to shut down and waits until it has, at most 3 s. If this node registered before, the two would
/// end each other: each registration of one makes the master shut down the other.
void end_other_node_of_this_name();

/// Returns whether the master has this node under its name, not another node that took the name.
bool master_knows_this_node();

}  // namespace bubblesim
