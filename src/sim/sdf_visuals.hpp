// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <material>, <scene> and <light>: what a scene looks like.
#pragma once

#include <optional>
#include <sdf/Light.hh>
#include <sdf/Scene.hh>
#include <sdf/Visual.hh>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim {

/// The colour that a visual gives by values or by the name of a material script; grey without either.
Material read_material(const sdf::Visual& visual, std::vector<Problem>& problems);

/// Background, ambient light and shadows.
void read_surroundings(const sdf::Scene& scene, Environment& environment);

/// Nothing for a point light or a spotlight, which are not supported. `pose` is the light's in the world.
std::optional<DirectionalLight> read_light(const sdf::Light& light, const Pose& pose);

}  // namespace bubblesim
