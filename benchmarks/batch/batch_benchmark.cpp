// SPDX-License-Identifier: BSD-3-Clause
// Saves, restores and resets a tricycle; steps 64 tricycles on one and two threads, beside plain loops over simulations
// in as many threads; makes 4,096 of them.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bubblesim/batch.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"

namespace {

using namespace bubblesim;

constexpr std::size_t kWorlds = 64;
constexpr std::size_t kSteps = 20;
constexpr int kRounds = 15;

double microseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double median_of(int times, const std::function<void()>& work) {
  std::vector<double> all;
  for (int i = 0; i < times; ++i) all.push_back(microseconds(work));
  return median(all);
}

std::size_t heap() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

void snapshots(const std::shared_ptr<const Scene>& scene) {
  Simulation simulation(scene);
  for (int i = 0; i < 20; ++i) simulation.step();
  std::string state;
  const double save = median_of(2000, [&] { simulation.save(state); });
  const double restore = median_of(2000, [&] { simulation.restore(state); });
  const double reset = median_of(2000, [&] { simulation.reset(); });
  std::printf("save %.1f us, restore %.1f us (%zu bytes), reset %.1f us\n", save, restore, state.size(), reset);
}

BatchOptions options(std::size_t worlds, std::size_t threads) {
  BatchOptions made;
  made.worlds = worlds;
  made.threads = threads;
  made.actions = {"/FrontMotor.target_velocity", "/Steering.target_position"};
  made.observations = {"/Tricycle.pose", "/Tricycle.velocity"};
  return made;
}

/// Steps simulations in plain loops, one in each thread.
void loop(std::vector<std::unique_ptr<Simulation>>& worlds, std::size_t threads) {
  const auto part = [&](std::size_t k) {
    for (std::size_t i = worlds.size() * k / threads; i < worlds.size() * (k + 1) / threads; ++i) {
      for (std::size_t step = 0; step < kSteps; ++step) worlds[i]->step();
    }
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < threads; ++k) others.emplace_back(part, k);
  part(0);
  for (std::thread& other : others) other.join();
}

void threads(const std::shared_ptr<const Scene>& scene) {
  Batch one(scene, options(kWorlds, 1));
  Batch two(scene, options(kWorlds, 2));
  std::vector<std::unique_ptr<Simulation>> plain;
  for (std::size_t i = 0; i < kWorlds; ++i) {
    plain.push_back(std::make_unique<Simulation>(scene, i));
    const SceneTree& tree = plain.back()->world().tree();
    plain.back()->world().joints().set_target_velocity(tree.find("/FrontMotor"), 2);
    plain.back()->world().joints().set_target_position(tree.find("/Steering"), 0.2);
  }
  std::vector<float> actions;
  for (std::size_t i = 0; i < kWorlds; ++i) actions.insert(actions.end(), {2.0F, 0.2F});
  std::vector<float> observed(kWorlds * one.observations().width());
  const auto run = [&](Batch& batch) {
    for (std::size_t step = 0; step < kSteps; ++step) batch.step(actions.data(), 1, observed.data());
  };
  std::vector<double> speedup;
  std::vector<double> relative;
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const double with_one = microseconds([&] { run(one); });
    const double with_two = microseconds([&] { run(two); });
    const double looped = microseconds([&] { loop(plain, 2); });
    speedup.push_back(with_one / with_two);
    relative.push_back(looped / with_two);
    times.push_back(with_one / (kWorlds * kSteps));
  }
  std::printf("%zu tricycles: %.1f us for each step of a world; two threads %.2f x one, %.2f x plain loops\n", kWorlds,
              median(times), median(speedup), median(relative));
}

void many(const std::shared_ptr<const Scene>& scene) {
  constexpr std::size_t kMany = 4096;
  const std::size_t before = heap();
  std::unique_ptr<Batch> batch;
  const double time = microseconds([&] { batch = std::make_unique<Batch>(scene, options(kMany, 2)); });
  std::vector<float> observed(kMany * batch->observations().width());
  batch->step(nullptr, 1, observed.data());
  std::printf("%zu tricycles: made in %.2f s, %.0f kB each after a step\n", kMany, time / 1e6,
              static_cast<double>(heap() - before) / kMany / 1e3);
}

}  // namespace

int main() {
  const std::shared_ptr<const Scene> scene = load_scene("tricycle");
  snapshots(scene);
  threads(scene);
  many(scene);
  return 0;
}
