// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Hash of all that determines how a scene or a model behaves: models, shapes, sensors, surroundings, time steps,
/// plugins. Names and places of files do not count. Equal in every process.
std::uint64_t hash_of(const SceneDescription& scene);
std::uint64_t hash_of(const ModelDescription& model);

}  // namespace bubblesim
