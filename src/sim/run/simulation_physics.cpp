// SPDX-License-Identifier: BSD-3-Clause
// The physics of a step, and the handling of divergence and of fallen models.
#include <cstdio>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "rays/ray_scene.hpp"
#include "run/last_states_file.hpp"

namespace bubblesim {
namespace {

void warn(const std::string& text) { std::fprintf(stderr, "warning: %s\n", text.c_str()); }

}  // namespace

void Simulation::advance_physics(double substep) {
  try {
    world_.advance(time_step_, substep, time());
  } catch (const Diverged& divergence) {
    handle(divergence);
  }
  for (const ObjectId model : world_.fallen_models()) {
    warn(world_.tree().path(model) + " fell below the scene; removed");
    remove_model_now(model);
  }
}

void Simulation::handle(const Diverged& divergence) {
  std::string what = divergence.what();
  if (writes_last_states_) {
    const std::string file = write_last_states(world_);
    if (!file.empty()) what += "; the last states are in " + file;
  }
  const std::vector<ObjectId> lost = world_.diverged_models();
  if (scene().on_divergence == OnDivergence::kReset) {
    warn(what + "; world reset");
    world_.reset();
    randomize();
    restart_sensors();
    for (System* system : systems_) system->reset();
  } else if (scene().on_divergence == OnDivergence::kRemove && !lost.empty()) {
    for (const ObjectId model : lost) {
      warn(what + "; " + world_.tree().path(model) + " removed");
      remove_model_now(model);
    }
  } else {
    throw Diverged(what);
  }
}

}  // namespace bubblesim
