// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/batch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {
namespace {

/// Parts for each thread: enough that none waits long for the others, and few enough that handing out costs nothing.
constexpr std::size_t kPartsPerThread = 8;
constexpr std::size_t kMaxWorlds = 1'000'000;

std::size_t checked_worlds(std::size_t worlds) {
  if (worlds >= 1 && worlds <= kMaxWorlds) return worlds;
  throw InvalidInput("a batch of " + std::to_string(worlds) + " worlds is not usable: it must have from 1 to 1000000");
}

std::vector<std::unique_ptr<Simulation>> first_world(std::shared_ptr<const Scene> scene, const BatchOptions& options) {
  std::vector<std::unique_ptr<Simulation>> worlds(checked_worlds(options.worlds));
  worlds[0] = std::make_unique<Simulation>(std::move(scene), options.seed);
  return worlds;
}

template <class Number>
bool all_finite(const void* data, std::size_t count) {
  const auto* numbers = static_cast<const Number*>(data);
  return std::all_of(numbers, numbers + count, [](Number number) { return std::isfinite(number); });
}

}  // namespace

Batch::Batch(std::shared_ptr<const Scene> scene, const BatchOptions& options)
    : numbers_(options.numbers),
      pool_(std::make_unique<WorkerPool>((options.threads == 0 ? usable_cores() : options.threads) - 1)),
      worlds_(first_world(scene, options)),
      actions_(*worlds_[0], options.actions, Quantities::Use::kCommand),
      observations_(*worlds_[0], options.observations, Quantities::Use::kObserve),
      randomization_(*worlds_[0], options.randomized),
      failed_(options.worlds) {
  for_all([&](std::size_t i) {
    if (i > 0) worlds_[i] = std::make_unique<Simulation>(scene, options.seed + i);
    worlds_[i]->set_writes_last_states(false);  // no caller would learn its name
    randomization_.apply(*worlds_[i]);
  });
}

Batch::~Batch() = default;

std::size_t Batch::threads() const { return pool_->threads(); }

void Batch::for_all(const std::function<void(std::size_t)>& work) {
  const std::size_t count = worlds_.size();
  const std::size_t parts = std::min(count, threads() == 1 ? 1 : threads() * kPartsPerThread);
  pool_->run(parts, [&](std::size_t part) {
    for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i) work(i);
  });
}

const void* Batch::row(const void* data, std::size_t world, std::size_t width) const {
  const std::size_t size = numbers_ == NumberType::kFloat32 ? sizeof(float) : sizeof(double);
  return static_cast<const char*>(data) + world * width * size;
}

void Batch::reset_world(std::size_t i, std::uint64_t seed) {
  worlds_[i]->reset_to_scene(seed);
  randomization_.apply(*worlds_[i]);
}

/// Returns whether the world is still usable.
bool Batch::step_world(std::size_t i, const void* actions, std::size_t steps) {
  Simulation& world = *worlds_[i];
  try {
    for (std::size_t done = 0; done < steps; ++done) {
      if (actions != nullptr) {
        actions_.command(world, Row(const_cast<void*>(row(actions, i, actions_.width())), numbers_));
      }
      world.step();
      if (!world.has_scene_models()) return false;
    }
  } catch (const Diverged&) {
    return false;
  } catch (const InvalidInput& error) {
    throw InvalidInput("world " + std::to_string(i) + ": " + error.what());
  }
  return true;
}

void Batch::step(const void* actions, std::size_t steps, void* observed) {
  if (actions != nullptr) {
    const std::size_t count = size() * actions_.width();
    const bool finite =
        numbers_ == NumberType::kFloat32 ? all_finite<float>(actions, count) : all_finite<double>(actions, count);
    if (!finite) throw InvalidInput("the actions of a batch must be finite numbers");
  }
  for_all([&](std::size_t i) {
    failed_[i] = step_world(i, actions, steps) ? 0 : 1;
    if (failed_[i] != 0) reset_world(i, worlds_[i]->seed());
    observations_.observe(*worlds_[i], Row(const_cast<void*>(row(observed, i, observations_.width())), numbers_));
  });
}

void Batch::observe(void* observed) {
  for_all([&](std::size_t i) {
    observations_.observe(*worlds_[i], Row(const_cast<void*>(row(observed, i, observations_.width())), numbers_));
  });
}

void Batch::reset(const std::vector<std::uint8_t>& mask, const std::vector<std::uint64_t>& seeds,
                  const std::vector<std::string_view>& states) {
  const auto check = [this](std::size_t given, const char* what) {
    if (given == size()) return;
    throw InvalidInput("the batch has " + std::to_string(size()) + " worlds: reset() needs as many " + what + ", not " +
                       std::to_string(given));
  };
  if (!mask.empty()) check(mask.size(), "marks");
  if (!seeds.empty()) check(seeds.size(), "seeds");
  if (states.size() > 1) check(states.size(), "states");
  for_all([&](std::size_t i) {
    if (!mask.empty() && mask[i] == 0) return;
    Simulation& world = *worlds_[i];
    if (states.empty() || !world.has_scene_models()) reset_world(i, seeds.empty() ? world.seed() : seeds[i]);
    if (states.empty()) return;
    world.restore(states.size() == 1 ? states[0] : states[i]);
    if (!seeds.empty()) world.set_seed(seeds[i]);
  });
}

}  // namespace bubblesim
