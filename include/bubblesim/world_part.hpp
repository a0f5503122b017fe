// SPDX-License-Identifier: BSD-3-Clause
// What the parts of a World share.
#pragma once

#include <memory>

namespace bubblesim {

struct WorldState;  // see src/sim/physics/world/state.hpp

struct DiscardWorldState {
  void operator()(WorldState* state) const;
};

using WorldStateHandle = std::unique_ptr<WorldState, DiscardWorldState>;

/// Some of the functions of a World, which owns it.
class WorldPart {
 public:
  /// `handle` must live as long as the part.
  explicit WorldPart(const WorldStateHandle& handle) : handle_(handle) {}
  WorldPart(const WorldPart&) = delete;
  WorldPart& operator=(const WorldPart&) = delete;

 protected:
  ~WorldPart() = default;
  WorldState& state() { return *handle_; }
  const WorldState& state() const { return *handle_; }

 private:
  const WorldStateHandle& handle_;  // a reset replaces the state
};

}  // namespace bubblesim
