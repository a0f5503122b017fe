// SPDX-License-Identifier: BSD-3-Clause
// What a simulation looks like at one time, for viewers, recorders and plots in any thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bubblesim/run_state.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

/// Which objects the rows of frames are of. Constant until models are added or removed.
struct FrameLayout {
  std::uint64_t revision = 0;  ///< World::revision()
  /// Of models that are not static, and those of others that were moved, in the order of the models.
  std::vector<ObjectId> links;
  /// An axis of a joint that has a position.
  struct Axis {
    ObjectId joint = kNoObject;
    int axis = 0;
  };
  std::vector<Axis> axes;
};

/// A pose in the world: x, y, z in m, and the quaternion x, y, z, w.
using FramePose = std::array<float, 7>;

/// Immutable once it is published.
struct Frame {
  double time = 0;  ///< s, simulation time of the state
  RunState state = RunState::kPaused;
  std::shared_ptr<const FrameLayout> layout;
  std::vector<FramePose> poses;        ///< of each link
  std::vector<float> joint_positions;  ///< rad or m, of each axis
};

FrameLayout frame_layout(const World& world);

}  // namespace bubblesim
