// SPDX-License-Identifier: BSD-3-Clause
// Many simulations of one scene, stepped together by threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/quantity.hpp"
#include "bubblesim/randomization.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

class WorkerPool;

struct BatchOptions {
  std::size_t worlds = 1;
  std::uint64_t seed = 0;   ///< of world 0; world i has seed + i
  std::size_t threads = 0;  ///< 0: as many as the process may use cores
  std::vector<std::string> actions;
  std::vector<std::string> observations;
  NumberType numbers = NumberType::kFloat32;
  std::vector<RandomQuantity> randomized;  ///< beside what the scene randomizes, at the start and after resets
};

/// World i equals, bit by bit, a Simulation with its seed that gets the same commands, whatever the number of worlds
/// and threads. One thread at a time may use a batch.
class Batch {
 public:
  /// Throws InvalidInput or NoSuchObject for quantities that the scene does not have, or that cannot be randomized so.
  Batch(std::shared_ptr<const Scene> scene, const BatchOptions& options);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  std::size_t size() const { return worlds_.size(); }
  std::size_t threads() const;
  NumberType numbers() const { return numbers_; }
  const Quantities& actions() const { return actions_; }
  const Quantities& observations() const { return observations_; }
  Simulation& operator[](std::size_t i) { return *worlds_[i]; }

  /// Sets the commands of `actions` (size() rows, or null to keep the last ones), runs `steps` steps of each world and
  /// writes its row to `observed`. A world that diverges or loses a model is reset. Throws InvalidInput with the world
  /// when a command cannot be used.
  void step(const void* actions, std::size_t steps, void* observed);
  /// Writes the observations of the present state.
  void observe(void* observed);
  /// Whether each world diverged or lost a model in the last step(), and was therefore reset.
  const std::vector<std::uint8_t>& failed() const { return failed_; }

  /// Resets the worlds with a mark, all when `mask` is empty, to the start or to `states` (one for all, or one for each
  /// world of the batch). `seeds`: empty, or one for each world of the batch.
  void reset(const std::vector<std::uint8_t>& mask, const std::vector<std::uint64_t>& seeds,
             const std::vector<std::string_view>& states);

 private:
  void for_all(const std::function<void(std::size_t)>& work);
  void reset_world(std::size_t i, std::uint64_t seed);
  bool step_world(std::size_t i, const void* actions, std::size_t steps);
  const void* row(const void* data, std::size_t world, std::size_t width) const;

  NumberType numbers_;
  std::unique_ptr<WorkerPool> pool_;
  std::vector<std::unique_ptr<Simulation>> worlds_;
  Quantities actions_;
  Quantities observations_;
  Randomization randomization_;
  std::vector<std::uint8_t> failed_;
};

}  // namespace bubblesim
