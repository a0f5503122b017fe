// SPDX-License-Identifier: BSD-3-Clause
// The axes of objects that child scripts and remote clients see: <bubblesim:axis_convention> of their model.
#pragma once

#include "bubblesim/world.hpp"

namespace bubblesim::bindings {

/// The rotation from an object's axes as scripts see them to its axes in the scene file. In CoppeliaSim's convention,
/// z of a joint is its axis (the shortest rotation from the file's z), and z of a proximity sensor or camera is where
/// it looks, with y up and x to the left. All other objects keep the axes of the file.
Quaternion object_axes(const World& world, ObjectId object);

}  // namespace bubblesim::bindings
