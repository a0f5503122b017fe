// SPDX-License-Identifier: BSD-3-Clause
// The static shapes and the sleeping models around a model that is awake.
#pragma once

#include <cstdint>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/contacts/spaces.hpp"

namespace bubblesim {

/// They are searched again when the model leaves the region around it, or when others have changed: ODE's quadtrees
/// take a tenth of a robot's substep to find that nothing is near.
class NearShapes {
 public:
  /// Of ODE: a shape, or the space of a sleeping model.
  struct Shape {
    dGeomID geom;
    Eigen::AlignedBox3d box;

    Shape(dGeomID near_geom, const Eigen::AlignedBox3d& near_box) : geom(near_geom), box(near_box) {}
  };

  /// All whose boxes may meet that of the model. Searches them if it must.
  const std::vector<Shape>& around(const Eigen::AlignedBox3d& model, const Spaces& spaces);

 private:
  void search(const Spaces& spaces);

  Eigen::AlignedBox3d region_;  // empty at first
  std::uint64_t changes_ = 0;   // of the spaces, when they were searched
  std::vector<Shape> shapes_;
};

}  // namespace bubblesim
