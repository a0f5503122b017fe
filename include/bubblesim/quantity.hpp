// SPDX-License-Identifier: BSD-3-Clause
// Named quantities of a simulation: what a batch reads as observations and writes as actions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bubblesim/row.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

struct ReadingQuantity;

/// Numbers of one quantity in the row of a world.
struct Quantity {
  std::string name;                ///< such as /Tricycle.pose
  std::vector<std::size_t> shape;  ///< empty: a single number
  std::size_t start = 0;           ///< of its numbers in the row
  std::size_t size = 1;            ///< their number
};

/// Quantities that were looked up once, for all simulations of a scene: their handles are equal.
class Quantities {
 public:
  enum class Use { kObserve, kCommand };

  /// `names`: `PATH.QUANTITY`, `PATH.QUANTITY@PATH` relative to another object, `time` or `gravity`. Wildcards in a
  /// path stand for all objects that have the quantity. Throws InvalidInput or NoSuchObject, with the names that there
  /// are.
  Quantities(Simulation& example, const std::vector<std::string>& names, Use use);

  const std::vector<Quantity>& list() const { return list_; }
  /// Numbers in a row.
  std::size_t width() const { return width_; }

  /// Writes a row. Sensors measure when they are due.
  void observe(Simulation& simulation, Row row) const;
  /// Sets commands from a row. Throws InvalidInput for values that cannot be used.
  void command(Simulation& simulation, Row row) const;

  struct Kind;

 private:
  struct Target {
    const Kind* kind = nullptr;
    const ReadingQuantity* of_reading = nullptr;  // in place of a kind
    ObjectId object = kNoObject;
    ObjectId relative_to = kNoObject;
  };
  void add(Simulation& example, const std::string& name, Use use);
  void add(const Target& target, std::vector<std::size_t> shape, std::string name);

  std::vector<Quantity> list_;
  std::vector<Target> targets_;
  std::size_t width_ = 0;
};

}  // namespace bubblesim
