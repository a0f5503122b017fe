// SPDX-License-Identifier: BSD-3-Clause
// What the file of a foreign scene has for objects beside physics: old names, data, parameters of scripts, collections.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/simulation.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim::bindings {

void bind_file_places(pybind11::class_<World>& world);
void bind_file_collections(pybind11::class_<Simulation>& simulation);

}  // namespace bubblesim::bindings
