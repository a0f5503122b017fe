// SPDX-License-Identifier: BSD-3-Clause
// Adds the kind of rate_of_turn.cpp to a process that loads this library.
#include "bubblesim/sensor_definition.hpp"

namespace bubblesim {

template <class Kind>
std::unique_ptr<SensorDefinition> define();

extern "C" void add_rate_of_turn() { add_sensor_definition(define<class RateOfTurnKind>()); }

}  // namespace bubblesim
