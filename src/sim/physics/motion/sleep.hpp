// SPDX-License-Identifier: BSD-3-Clause
// Sleep: islands of props at rest are not simulated until something wakes them, each as a whole.
#pragma once

#include "physics/contacts/substep.hpp"

namespace bubblesim {

class Fnv1a;

/// Wakes the groups of which a body was enabled by a command or a wrench.
void wake_commanded(const MovingModels& moving);
/// Wakes the groups that awake bodies touch; returns whether there were any.
bool wake_touched(const MovingModels& moving, const FoundContacts& found);
/// Measures rest after a substep, and puts islands to sleep.
void rest(Substep& substep);
/// Wakes all models, after one was moved or removed that may support them.
void wake(const MovingModels& moving);

/// Adds what the later sleep of a model depends on.
void add_rest(Fnv1a& hash, const PlacedModel& model);

}  // namespace bubblesim
