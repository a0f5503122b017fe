// SPDX-License-Identifier: BSD-3-Clause
// A scene that is read, checked and prepared once, for any number of simulations.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {

/// Immutable, so simulations in several threads may share it.
class Scene {
 public:
  /// Checks and prepares a description. Throws SceneError with all its problems.
  explicit Scene(SceneDescription description);
  /// Prepares a description that was checked; `warnings` are those of its files.
  static std::shared_ptr<const Scene> of_checked(SceneDescription description, std::vector<Problem> warnings);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const SceneDescription& description() const { return *description_; }
  /// Values that were replaced and elements that have no effect, with the file and line of each.
  const std::vector<Problem>& warnings() const { return warnings_; }
  /// The objects at the start of each simulation, with their handles.
  const std::shared_ptr<const SceneTree>& tree() const { return tree_; }

  /// The frames of no model, for a world that outlives the scene.
  std::shared_ptr<const std::vector<FrameDescription>> shared_frames() const {
    return {description_, &description_->frames};
  }

  /// Of all that determines how the scene behaves, equal in every process; computed at the first call. Thread-safe.
  std::uint64_t hash() const;

  struct Prepared;  // see src/sim/scene/prepared.hpp
  const Prepared& prepared() const { return *prepared_; }

 private:
  struct Checked {};
  Scene(Checked checked, SceneDescription description, std::vector<Problem> warnings);

  std::shared_ptr<const SceneDescription> description_;
  std::vector<Problem> warnings_;
  std::shared_ptr<const SceneTree> tree_;
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace bubblesim
