// SPDX-License-Identifier: BSD-3-Clause
// The physics substep that chains of links with a load need.
#pragma once

#include <optional>
#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

struct NeededSubstep {
  double step = 0;   // s, the longest that is stable
  std::string link;  // that needs it
  double load = 0;   // kg, what it carries
};

/// A link that hangs between two free joints and carries a load swings about its centre of mass with the frequency
/// sqrt(T d / I): T is the weight of the load, d the distance of the joints, I its moment of inertia. Substeps above
/// 2 / frequency are unstable. The result allows for three times the weight, as in a swing from the horizontal. Empty
/// without such links.
std::optional<NeededSubstep> needed_substep(const ModelDescription& model, double gravity);

}  // namespace bubblesim
