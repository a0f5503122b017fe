// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/node_graph.hpp"
#include "dds/participant.hpp"

namespace bubblesim::ros2 {

/// What other nodes publish, receive and offer, as far as they are discovered.
NodeGraph read_graph(const Participant& participant);

}  // namespace bubblesim::ros2
