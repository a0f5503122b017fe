// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of textures that are projected on a mesh.
#pragma once

#include <array>
#include <vector>

#include "load/ttt/scene_file.hpp"

namespace bubblesim::ttt {

enum class ProjectionMode { kPlane = 0, kCylinder = 1, kSphere = 2, kCube = 3 };

struct Projection {
  ProjectionMode mode = ProjectionMode::kPlane;
  std::array<double, 2> size{1, 1};  ///< m, of the image
  Pose frame;  ///< in the shape's frame; the middle of the image is at its origin, z towards the eye
  std::array<bool, 2> repeats{false, false};  ///< along u and v
};

/// Three a triangle. Empty for cylinders and spheres, and for an image that neither repeats nor covers the mesh.
std::vector<std::array<float, 2>> projected(const Part& part, const Projection& projection);

}  // namespace bubblesim::ttt
