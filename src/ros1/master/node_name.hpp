// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// Why this node must not register at the master: another node of its name runs, which the master would end for it.
/// Empty when there is none, or only one that was killed and does not take connections any more.
std::string other_node_of_this_name();

/// Tells that node to shut down and waits until it has, 3 s at most. Were this one to register
/// before, the two would end each other: each registration of one has the master shut down the other.
void end_other_node_of_this_name();

/// Whether the master knows this very node by its name, not another that has taken the name.
bool master_knows_this_node();

}  // namespace bubblesim
