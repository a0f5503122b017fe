// SPDX-License-Identifier: BSD-3-Clause
// Sleep: islands of props at rest are not simulated until something wakes them, each as a whole.
#pragma once

#include "bubblesim/world.hpp"

namespace bubblesim {

class Fnv1a;
struct PlacedModel;

/// How long a model has been at rest, and with which models it sleeps.
struct Rest {
  bool may_sleep = false;
  double time = 0;             // s
  ObjectId group = kNoObject;  // first model of the group; kNoObject: awake
};

/// Wakes the groups of which a body was enabled by a command or a wrench.
void wake_commanded(World::State& state);
/// Wakes the groups that awake bodies touch; returns whether there were any.
bool wake_touched(World::State& state);
/// Measures rest after a substep, and puts islands to sleep.
void rest(World::State& state, double step);
/// Wakes all models, after one was moved or removed that may support them.
void wake(World::State& state);

/// Adds what the later sleep of a model depends on.
void add_rest(Fnv1a& hash, const PlacedModel& model);

}  // namespace bubblesim
