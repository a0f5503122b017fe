// SPDX-License-Identifier: BSD-3-Clause
// Runs of a small simulation, and what its systems see of them.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/runner.hpp"
#include "scenes.hpp"

namespace bubblesim::test {

constexpr double kStep = 0.05;      // s, of the scene
constexpr double kGravity = 9.81;   // m/s^2, of the scene
constexpr double kSubstep = 0.005;  // s

/// Records steps, stops and starts with the runner's state; calls functions.
struct Witness : System {
  void process_input() override {
    if (on_input) on_input();
  }
  void sense(const World&, double) override {
    note("step");
    if (on_step) on_step();
  }
  void stop() override {
    note("stop");
    if (on_stop) on_stop();
  }
  void start() override { note("start"); }

  void note(const std::string& what) {
    seen.push_back(what + " " + std::string(name(runner != nullptr ? runner->state() : RunState::kPaused)));
  }

  const Runner* runner = nullptr;
  std::vector<std::string> seen;
  std::function<void()> on_input;
  std::function<void()> on_step;
  std::function<void()> on_stop;
};

using Seen = std::vector<std::string>;

inline RunnerOptions fast(RunState initial = RunState::kPaused) {
  RunnerOptions options;
  options.speed = kInfinity;
  options.initial = initial;
  return options;
}

inline SceneDescription falling_ball() { return scene({model("Ball", link("link"))}); }

/// A ball in free fall, with a recorder.
struct Run : testing::Test {
  void make(RunnerOptions options) {
    simulation.add(witness);
    runner = std::make_unique<Runner>(simulation, std::move(options));
    witness.runner = runner.get();
  }

  /// Returns when the runner's loop, on its thread, has run a few times: what was due has been done.
  void let_it_go_round() const {
    for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
  }

  Simulation simulation{falling_ball(), 1};
  Witness witness;
  std::unique_ptr<Runner> runner;
};

/// Why a command was not carried out.
inline std::string reason(std::future<double> result) {
  try {
    result.get();
  } catch (const NotCarriedOut& error) {
    return error.what();
  }
  return "carried out";
}

}  // namespace bubblesim::test
