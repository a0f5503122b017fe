// SPDX-License-Identifier: BSD-3-Clause
// The prepared parts of a scene: what its simulations share besides the description.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "bubblesim/prepared_scene.hpp"
#include "physics/prepared_model.hpp"
#include "rays/prepared_rays.hpp"

namespace bubblesim {

struct Scene::Prepared {
  std::vector<std::shared_ptr<const PreparedModel>> models;  // in the order of the description

  /// Made at the first call: many scenes have no sensor with rays. Thread-safe.
  const rays::PreparedRays& rays(const Scene& scene) const;

 private:
  mutable std::once_flag rays_made_;
  mutable rays::PreparedRays rays_;
};

}  // namespace bubblesim
