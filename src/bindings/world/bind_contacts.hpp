// SPDX-License-Identifier: BSD-3-Clause
// The contact points of bubblesim._core.World.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/world.hpp"

namespace bubblesim::bindings {

void bind_contacts(pybind11::class_<World>& world);

}  // namespace bubblesim::bindings
