// SPDX-License-Identifier: BSD-3-Clause
// The prepared parts of a scene: what its simulations share besides the description.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bubblesim/prepared_scene.hpp"

namespace bubblesim {

struct PreparedModel;  // see physics/parts/prepared_model.hpp
namespace rays {
struct PreparedRays;  // see rays/prepared_rays.hpp
}

struct Scene::Prepared {
  std::vector<std::shared_ptr<const PreparedModel>> models;  // in the order of the description

  /// Made at the first call: many scenes have no sensor with rays. Thread-safe.
  const rays::PreparedRays& rays(const Scene& scene) const;
  /// The physics at the start, for resets: saved by `save` at the first call. Thread-safe.
  const std::shared_ptr<const std::string>& start(const std::function<std::string()>& save) const;
  std::uint64_t hash(const Scene& scene) const;

 private:
  mutable std::once_flag rays_made_;
  mutable std::shared_ptr<const rays::PreparedRays> rays_;
  mutable std::once_flag hash_made_;
  mutable std::uint64_t hash_ = 0;
  mutable std::once_flag start_made_;
  mutable std::shared_ptr<const std::string> start_;
};

}  // namespace bubblesim
