// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <material>, <scene>, <spherical_coordinates> and <light>: what a scene looks like and where it is.
#pragma once

#include <ignition/math/SphericalCoordinates.hh>
#include <optional>
#include <sdf/Light.hh>
#include <sdf/Scene.hh>
#include <sdf/Visual.hh>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// What a visual gives by values, by the name of a material script that the model brings, or by one of Gazebo's names.
/// Nothing when it gives none that is known.
std::optional<Material> read_material(const sdf::Visual& visual, LoadContext& reading);

/// Background, ambient light and shadows.
void read_surroundings(const sdf::Scene& scene, Environment& environment);

/// Where on Earth the world's origin lies.
void read_origin(const ignition::math::SphericalCoordinates& place, GeographicOrigin& origin);

/// `pose` is the light's in the world, or in the frame of its link.
Light read_light(const sdf::Light& light, const Pose& pose);

}  // namespace bubblesim
