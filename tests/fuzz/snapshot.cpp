// SPDX-License-Identifier: BSD-3-Clause
// Saved states change in any byte; most bytes that are no state at all fail at the first one.
#include <cstdint>
#include <memory>
#include <string>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {
namespace {

/// The state with changes: each takes three bytes, two of the place and one of the value. With an odd number of bytes
/// the last one is left out and the state ends at the last place.
std::string changed(std::string state, std::string_view changes) {
  std::size_t place = state.size();
  for (std::size_t i = 0; i + 2 < changes.size(); i += 3) {
    place = (static_cast<std::uint8_t>(changes[i]) * 256U + static_cast<std::uint8_t>(changes[i + 1])) % state.size();
    state[place] = changes[i + 2];
  }
  if (changes.size() % 2 == 1) state.resize(place);
  return state;
}

}  // namespace

void read_snapshot(std::string_view data) {
  static const std::shared_ptr<const Scene> kScene = load_scene("tricycle");
  static Simulation simulation(kScene);
  static const std::string kState = simulation.save();
  const std::uint64_t before = simulation.state_hash();
  try {
    simulation.restore(changed(kState, data));
  } catch (const InvalidInput&) {
    require(simulation.state_hash() == before, "a state that is refused changes nothing");
    return;
  }
  try {
    simulation.step();
  } catch (const Diverged&) {
  }
  simulation.restore(kState);
  require(simulation.state_hash() == before, "a saved state is restored whatever was restored before");
}

}  // namespace bubblesim::fuzz
