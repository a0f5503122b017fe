// SPDX-License-Identifier: BSD-3-Clause
// The exponential decay of links' velocities: SDFormat's <velocity_decay>.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Slows the links that have a LinkDescription::linear_decay or angular_decay: a link on which nothing else acts has
/// the velocity v exp(-t decay) of its centre of mass, whatever the physics substep is.
class VelocityDecay final : public Device {
 public:
  void update(World& world, double time, double duration) override;

 private:
  std::vector<ObjectId> slowed_;
  std::optional<std::uint64_t> revision_;  // of the world in which the links were found
};

}  // namespace bubblesim
