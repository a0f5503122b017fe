// SPDX-License-Identifier: BSD-3-Clause
// Draws the quantities that differ at random, by the seed of a simulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bubblesim/quantity.hpp"
#include "bubblesim/random_quantity.hpp"

namespace bubblesim {

/// Quantities that were looked up once, for all simulations of a scene. What is drawn depends on the seed of the
/// simulation, the full name of the quantity and the index of the number alone: not on other quantities, simulations,
/// threads or earlier draws.
class Randomization {
 public:
  /// Throws SceneError for quantities of a scene's file that it does not have or whose distribution cannot be used, and
  /// InvalidInput for others.
  Randomization(Simulation& example, const std::vector<RandomQuantity>& quantities);

  /// Draws the quantities and sets them, in order. Throws like the constructor when a drawn value cannot be used.
  void apply(Simulation& simulation) const;

 private:
  struct Item {
    RandomQuantity quantity;
    Quantities commands;
    Quantities present;  // the same, to be observed; empty unless the operation needs it
  };

  std::vector<Item> items_;
};

/// The numbers that a quantity of `size` numbers with this name gets in a simulation with this seed, where the
/// operation is to set them. Throws InvalidInput for distributions that cannot be used.
std::vector<double> draw(const Distribution& distribution, std::uint64_t seed, const std::string& name,
                         std::size_t size);

}  // namespace bubblesim
