// SPDX-License-Identifier: BSD-3-Clause
// The boxes that the lidars of the benchmarks see, for a scene and for Embree alone.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "raw_lidar.hpp"

namespace bubblesim::benchmarks {

/// Boxes of 1 m height on the ground, up to 15 m from `centre` in x and y, none with its middle nearer than `clear`.
std::vector<RawLidar::PlacedBox> boxes_around(const Vector3& centre, double clear, std::size_t count);

/// A model of one link, `link`, with one collision.
ModelDescription model_of(const std::string& name, const Geometry& geometry, const Pose& pose, bool is_static);

}  // namespace bubblesim::benchmarks
