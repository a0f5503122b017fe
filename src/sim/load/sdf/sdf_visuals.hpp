// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <material>, <scene>, <spherical_coordinates> and <light>: appearance and geographic origin of a scene.
#pragma once

#include <ignition/math/SphericalCoordinates.hh>
#include <optional>
#include <sdf/Light.hh>
#include <sdf/Scene.hh>
#include <sdf/Visual.hh>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// The material of a visual, given by values, by the name of a material script of the model, or by one of Gazebo's
/// names. Empty when it is not given or unknown.
std::optional<Material> read_material(const sdf::Visual& visual, LoadContext& reading);

/// Background, ambient light and shadows.
void read_surroundings(const sdf::Scene& scene, Environment& environment);

/// The geographic coordinates of the world's origin.
void read_origin(const ignition::math::SphericalCoordinates& place, GeographicOrigin& origin);

/// `pose` is in the world, or in the frame of the light's link.
Light read_light(const sdf::Light& light, const Pose& pose);

}  // namespace bubblesim
