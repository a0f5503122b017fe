// SPDX-License-Identifier: BSD-3-Clause
// Distributions of quantities from Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "bubblesim/random_quantity.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim::bindings {

/// By quantity, in the order in which they are drawn.
using Distributions = pybind11::dict;

/// Throws TypeError unless the keys are strings and the values Distributions.
std::vector<RandomQuantity> to_random_quantities(const Distributions& distributions);

/// Draws quantities by the simulation's seed, and sets them.
void randomize(Simulation& simulation, const Distributions& distributions);

}  // namespace bubblesim::bindings
