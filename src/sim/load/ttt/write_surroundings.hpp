// SPDX-License-Identifier: BSD-3-Clause
// What is around the models of a scene: steps, gravity, light, and the floor on which the model of a .ttm stands.
#pragma once

#include <pugixml.hpp>

#include "load/ttt/structure.hpp"

namespace bubblesim::ttt {

void write_settings(pugi::xml_node world, const Settings& settings);
/// A floor at height 0, or below what of the file collides.
void write_floor(pugi::xml_node world, const SceneFile& file, const Structure& structure);

}  // namespace bubblesim::ttt
