// SPDX-License-Identifier: BSD-3-Clause
// Compares a simulation step of the tricycle, without a script and with a Python script with five calls, with the same
// scene implemented directly with ODE. The candidates run alternately, so that other load affects them equally.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "raw_tricycle.hpp"

namespace {

using namespace bubblesim;

constexpr int kStepsPerRound = 400;
constexpr double kSteering = 1.0;  // a circle without contact with walls
constexpr double kSpeed = 0.5;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Candidate {
  const char* name;
  std::function<void()> pass;
  std::vector<double> rounds;  // us per step

  void run() {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kStepsPerRound; ++i) pass();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    rounds.push_back(took.count() / kStepsPerRound);
  }
};

SceneDescription tricycle_without_script() {
  SceneDescription scene = read_scene("tricycle");
  for (ModelDescription& model : scene.models) model.child_script.clear();
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 41;

  benchmarks::RawTricycle raw;
  raw.drive(kSteering, kSpeed);

  Simulation plain(tricycle_without_script());
  plain.world().joints().set_target_position(plain.world().tree().find("/Steering"), kSteering);
  plain.world().joints().set_target_velocity(plain.world().tree().find("/FrontMotor"), kSpeed);

  Simulation scripted(tricycle_without_script());
  ScriptOptions options;
  options.replacements = {{"/Tricycle", FIVE_CALLS_SCRIPT}};
  Runner runner(scripted);
  PythonEngine python;
  python.begin(runner, {});
  ChildScripts scripts(python, options);
  scripted.add(scripts);

  // Both must simulate the same motion.
  for (int i = 0; i < 100; ++i) {
    raw.step();
    plain.step();
  }
  const auto position = plain.world().pose(plain.world().tree().find("/base_link")) * Vector3(0.4, 0, 0.4);
  const double apart = std::hypot(position.x() - raw.x(), position.y() - raw.y());
  std::printf("after 5 s the tricycles are %.2g m apart\n", apart);

  std::vector<Candidate> candidates = {{"ODE alone", [&] { raw.step(); }, {}},
                                       {"step", [&] { plain.step(); }, {}},
                                       {"step with a 5-call script", [&] { scripted.step(); }, {}}};
  for (int round = 0; round < rounds; ++round) {
    for (Candidate& candidate : candidates) candidate.run();
  }
  const double limit = median(candidates.front().rounds);
  std::printf("%-28s %12s %24s\n", "median of rounds", "us per step", "speed relative to ODE");
  for (const Candidate& candidate : candidates) {
    const double time = median(candidate.rounds);
    std::printf("%-28s %12.1f %24.3f\n", candidate.name, time, limit / time);
  }
  return apart < 1e-3 && scripts.failures() == 0 ? 0 : 1;
}
