// SPDX-License-Identifier: BSD-3-Clause
// Measures what a scene costs when it is loaded, simulated again and reset, and how much slower a step is on two
// threads at once than on one.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/triangle_mesh.hpp"

namespace {

using namespace bubblesim;
using Clock = std::chrono::steady_clock;

constexpr int kSimulations = 1000;
constexpr int kResets = 1000;
constexpr int kSteps = 20;
constexpr int kRounds = 200;

double microseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

template <class Work>
double shortest_of(int rounds, const Work& work) {
  double shortest = 1e12;
  for (int i = 0; i < rounds; ++i) {
    const Clock::time_point start = Clock::now();
    work();
    shortest = std::min(shortest, microseconds_since(start));
  }
  return shortest;
}

template <class Work>
double median_of(int rounds, const Work& work) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    const Clock::time_point start = Clock::now();
    work();
    times.push_back(microseconds_since(start));
  }
  return median(times);
}

std::size_t heap() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

Geometry box_mesh(float half) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (int i = 0; i < 8; ++i) {
    mesh->vertices.push_back({(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half});
  }
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh->low = Vector3::Constant(-half);
  mesh->high = Vector3::Constant(half);
  return Mesh{std::move(mesh)};
}

ModelDescription model_of(const std::string& name, Geometry geometry, const Pose& pose, bool is_static) {
  CollisionDescription shape;
  shape.name = "shape";
  shape.geometry = std::move(geometry);
  LinkDescription link;
  link.name = "link";
  link.collisions.push_back(std::move(shape));
  ModelDescription model;
  model.name = name;
  model.pose = pose;
  model.is_static = is_static;
  model.links.push_back(std::move(link));
  return model;
}

/// A tower of boxes on the ground, kept awake by its plugin.
SceneDescription tower(const Geometry& box, int boxes) {
  SceneDescription scene;
  scene.models.push_back(model_of("Floor", Plane{}, Pose(), true));
  for (int i = 0; i < boxes; ++i) {
    scene.models.push_back(
        model_of("Box" + std::to_string(i), box, Pose(0.01 * (i % 3), 0, 0.11 + 0.205 * i, 0, 0, 0), false));
    scene.models.back().plugins.emplace_back();
  }
  return scene;
}

/// Shortest time of kSteps steps, in us per step, of a simulation on each of the threads: the one with the least other
/// load.
double step_on(const SceneDescription& scene, int threads) {
  std::vector<std::unique_ptr<Simulation>> simulations;
  for (int i = 0; i < threads; ++i) simulations.push_back(std::make_unique<Simulation>(scene));
  return shortest_of(kRounds,
                     [&] {
                       std::vector<std::thread> running;
                       for (const auto& simulation : simulations) {
                         running.emplace_back([&simulation] {
                           simulation->reset();
                           for (int i = 0; i < kSteps; ++i) simulation->step();
                         });
                       }
                       for (std::thread& thread : running) thread.join();
                     }) /
         kSteps;
}

void compare_threads(const char* name, const SceneDescription& scene) {
  const double one = step_on(scene, 1);
  const double two = step_on(scene, 2);
  std::printf("%-44s %8.1f us on one thread, %8.1f us on two: %.2f x\n", name, one, two, two / one);
}

}  // namespace

int main() {
  std::printf("load tricycle, first time                    %10.1f ms\n",
              median_of(1, [] { load_scene("tricycle"); }) / 1e3);
  std::printf("load tricycle, again                         %10.1f ms\n",
              median_of(11, [] { load_scene("tricycle"); }) / 1e3);
  const std::shared_ptr<const Scene> scene = load_scene("tricycle");
  Simulation first(scene);
  first.step();
  std::vector<std::unique_ptr<Simulation>> simulations;
  const std::size_t before = heap();
  const double made = median_of(kSimulations, [&] { simulations.push_back(std::make_unique<Simulation>(scene)); });
  const double bytes = static_cast<double>(heap() - before) / kSimulations;
  std::printf("another simulation of the tricycle           %10.1f us, %.0f kB\n", made, bytes / 1e3);
  simulations.clear();
  std::vector<double> resets;
  for (int i = 0; i < kResets; ++i) {
    first.step();
    resets.push_back(median_of(1, [&] { first.reset(); }));
  }
  std::printf("reset of the tricycle                        %10.1f us\n", median(resets));
  const Geometry box = Box{{0.2, 0.2, 0.2}};
  compare_threads("step of a tower of 4 boxes (exact solver)", tower(box, 4));
  compare_threads("step of a tower of 12 boxes (iterative)", tower(box, 12));
  compare_threads("step of a tower of 4 meshes", tower(box_mesh(0.1F), 4));
  return 0;
}
