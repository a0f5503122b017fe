// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/math.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

/// Force and torque on a body.
struct Wrench {
  Vector3 force;   ///< N
  Vector3 torque;  ///< N m
};

/// The frame of the vectors of a wrench.
enum class WrenchFrame { kWorld, kObject };

void transfer(StateArchive& archive, Wrench& wrench);

}  // namespace bubblesim
