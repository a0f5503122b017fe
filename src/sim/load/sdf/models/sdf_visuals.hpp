// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <material>, <scene>, <spherical_coordinates> and <light>: appearance and geographic origin of a scene.
#pragma once

#include <optional>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The material of the visual at a path, given by values, by the name of a material script of the model, or by one of
/// Gazebo's names. Empty when it is not given or unknown.
std::optional<Material> read_material(const SdfElement& visual, const std::string& path, LoadContext& context);

/// Background, ambient light and shadows.
void read_surroundings(const SdfElement& scene, Environment& environment);

/// The geographic coordinates of the world's origin.
void read_origin(const SdfElement& spherical_coordinates, GeographicOrigin& origin, LoadContext& context);

/// `pose` is in the world, or in the frame of the light's link. `path` is that of the light.
Light read_light(const SdfElement& light, const Pose& pose, const std::string& path, LoadContext& context);

}  // namespace bubblesim
