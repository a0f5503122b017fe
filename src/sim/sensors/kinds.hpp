// SPDX-License-Identifier: BSD-3-Clause
// The maker of each sensor kind; a new kind adds its file, its description in scene.hpp and its line here and in
// registry.cpp.
#pragma once

#include "bubblesim/sensor.hpp"

namespace bubblesim {

std::unique_ptr<Sensor> make_sonar(const SonarDescription&, ObjectId, const World&);

}  // namespace bubblesim
