// SPDX-License-Identifier: BSD-3-Clause
// The physics of a step, and the handling of divergence and of fallen models.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "rays/ray_scene.hpp"

namespace bubblesim {
namespace {

/// Writes the last states to a file. Returns a note with the file name, or an empty string when it cannot be written.
std::string dump(const World& world) {
  std::error_code failed;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(failed);
  if (failed) return "";
  const std::filesystem::path file = folder / ("bubblesim_diverged_" + std::to_string(::getpid()) + ".csv");
  std::ofstream out(file);
  world.write_last_states(out);
  return out.flush() ? "; the last states are in " + file.string() : "";
}

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
  const std::string what = divergence.what() + dump(world_);
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
