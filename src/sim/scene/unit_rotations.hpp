// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/scene.hpp"

namespace bubblesim {

/// Scales the quaternions of a model's poses to unit length. Those that have it but for rounding stay the same, to the
/// bit, so that a copy of a model is that model.
void make_rotations_unit(ModelDescription& model);
void make_rotation_unit(Pose& pose);

}  // namespace bubblesim
