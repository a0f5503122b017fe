// SPDX-License-Identifier: BSD-3-Clause
// <bubblesim:randomize>: what differs at random between simulations of a scene.
#pragma once

#include <vector>

#include "bubblesim/random_quantity.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// Reads the elements of a <world>. Reports unknown attributes and strings that cannot be used; quantities are looked
/// up when a simulation is made.
std::vector<RandomQuantity> read_randomized(const SdfElement& world, LoadContext& context);

}  // namespace bubblesim
