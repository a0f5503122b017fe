// SPDX-License-Identifier: BSD-3-Clause
// The quantities that a batch knows, besides those that kinds of sensors have (SensorDefinition::quantities).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "bubblesim/quantity.hpp"

namespace bubblesim {

/// `shape` is empty for objects that do not have the quantity.
struct Quantities::Kind {
  using Shape = std::optional<std::vector<std::size_t>>;
  struct Place {
    ObjectId object;
    ObjectId relative_to;  // kNoObject: the world
  };

  std::string_view name;
  Shape (*shape)(const World&, ObjectId);
  void (*observe)(Simulation&, const Place&, Row&);
  void (*command)(Simulation&, ObjectId, Row&);  // null: cannot be set
  bool relative = false;                         // to another object
};

/// The quantities of objects.
const std::vector<Quantities::Kind>& quantity_kinds();
/// Those of the world, which have no path.
const std::vector<Quantities::Kind>& world_quantity_kinds();

}  // namespace bubblesim
