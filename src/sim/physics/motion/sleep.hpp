// SPDX-License-Identifier: BSD-3-Clause
// Sleep: islands of props at rest are not simulated until something wakes them, each as a whole.
#pragma once

#include "physics/contacts/substep.hpp"

namespace bubblesim {

class Fnv1a;

/// Enables a body, because of a command or a wrench.
void command(MovingModels& moving, dBodyID body);
/// Wakes the groups of which a body was enabled.
void wake_commanded(Substep& substep);
/// Wakes the groups that awake bodies touch; returns whether there were any.
bool wake_touched(Substep& substep);
/// Measures rest after a substep, and puts islands to sleep.
void rest(Substep& substep);
/// Wakes all models, after one was moved or removed that may support them.
void wake(MovingModels& moving, Spaces& spaces, Contacts& contacts);
/// Updates the list of the models that are awake, the spaces, and the memories of contacts, after models were added,
/// went to sleep, or woke up.
void sort_by_sleep(MovingModels& moving, Spaces& spaces, Contacts& contacts);

/// Adds what the later sleep of a model depends on.
void add_rest(Fnv1a& hash, const PlacedModel& model);

}  // namespace bubblesim
