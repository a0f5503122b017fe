// SPDX-License-Identifier: BSD-3-Clause
// Requests to start, pause, stop and end a simulation, and their effects.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_simulation_run {
namespace {

/// Records steps, stops and starts with the simulation's state; calls a function when stopped.
struct Witness : System {
  explicit Witness(const Simulation& watched) : simulation(watched) {}

  void sense(const World&, double) override { note("pass"); }
  void stop() override {
    note("stop");
    if (on_stop) on_stop();
  }
  void start() override { note("start"); }

  void note(const std::string& what) {
    static const char* const kStates[] = {"stopped", "paused", "running", "stopping"};
    seen.push_back(what + " " + kStates[static_cast<int>(simulation.state())]);
  }

  const Simulation& simulation;
  std::vector<std::string> seen;
  std::function<void()> on_stop;
};

using Seen = std::vector<std::string>;

/// A ball in free fall, with a recorder.
struct Run : testing::Test {
  Run() { simulation.add(witness); }

  Simulation simulation{scene({model("Ball", link("link"))}), 1};
  Witness witness{simulation};
};

TEST_F(Run, StepDoesNotLookAtRequests) {
  simulation.stop();
  simulation.step();
  EXPECT_EQ(simulation.state(), RunState::kRunning);
  EXPECT_TRUE(simulation.has_requests());
  EXPECT_DOUBLE_EQ(simulation.time(), 0.05);
}

TEST_F(Run, APauseKeepsTimeAndAStartGoesOn) {
  simulation.step();
  simulation.pause();
  simulation.carry_out_requests();
  EXPECT_EQ(simulation.state(), RunState::kPaused);
  EXPECT_FALSE(simulation.has_requests());
  simulation.start();
  simulation.carry_out_requests();
  EXPECT_EQ(simulation.state(), RunState::kRunning);
  EXPECT_DOUBLE_EQ(simulation.time(), 0.05);
  EXPECT_EQ(witness.seen, Seen{"pass running"});
}

TEST_F(Run, AStopGivesOneMorePassAndThenThatOfANewSimulation) {
  const std::uint64_t fresh = simulation.state_hash();
  simulation.step();
  simulation.stop();
  simulation.carry_out_requests();
  EXPECT_EQ(witness.seen, (Seen{"pass running", "pass stopping", "stop stopping"}));
  EXPECT_EQ(simulation.state(), RunState::kStopped);
  EXPECT_EQ(simulation.time(), 0);
  EXPECT_EQ(simulation.state_hash(), fresh);
  EXPECT_FALSE(simulation.ending());
}

TEST_F(Run, AStopFromAPauseGivesOneMorePass) {
  simulation.pause();
  simulation.stop();
  simulation.carry_out_requests();
  EXPECT_EQ(witness.seen, (Seen{"pass stopping", "stop stopping"}));
}

TEST_F(Run, RequestsAreCarriedOutInTheirOrder) {
  simulation.stop();
  simulation.start();
  simulation.pause();
  simulation.carry_out_requests();
  EXPECT_EQ(witness.seen, (Seen{"pass stopping", "stop stopping", "start running"}));
  EXPECT_EQ(simulation.state(), RunState::kPaused);
}

TEST_F(Run, WhatIsStoppedCanNeitherBePausedNorStopped) {
  simulation.stop();
  simulation.carry_out_requests();
  witness.seen.clear();
  simulation.pause();
  simulation.stop();
  simulation.carry_out_requests();
  EXPECT_EQ(simulation.state(), RunState::kStopped);
  EXPECT_EQ(witness.seen, Seen());
}

TEST_F(Run, RequestsThatComeMeanwhileWaitForTheNextTime) {
  witness.on_stop = [&] {
    simulation.start();
    simulation.stop();
  };
  simulation.stop();
  simulation.carry_out_requests();
  EXPECT_EQ(simulation.state(), RunState::kStopped);
  EXPECT_TRUE(simulation.has_requests());
}

TEST_F(Run, AStopMayBeAnEnd) {
  simulation.end_at_stop();
  simulation.stop();
  simulation.stop();
  simulation.start();
  simulation.carry_out_requests();
  EXPECT_TRUE(simulation.ending());
  EXPECT_EQ(witness.seen, Seen{"pass stopping"});
  EXPECT_EQ(simulation.state(), RunState::kStopping) << "seen by systems in the last step";
  EXPECT_DOUBLE_EQ(simulation.time(), 0.05);
}

TEST_F(Run, InSynchronousModeEachTriggerIsGoodForOnePass) {
  EXPECT_TRUE(simulation.step_is_due());
  simulation.trigger_step();  // no effect: not in synchronous mode
  simulation.set_synchronous(true);
  EXPECT_FALSE(simulation.step_is_due());
  simulation.trigger_step();
  simulation.trigger_step();
  simulation.set_synchronous(true);
  int passes = 0;
  for (; simulation.step_is_due(); ++passes) simulation.run_step();
  EXPECT_EQ(passes, 2);
  simulation.trigger_step();
  simulation.set_synchronous(false);
  EXPECT_TRUE(simulation.step_is_due());
  simulation.set_synchronous(true);
  EXPECT_FALSE(simulation.step_is_due()) << "an earlier trigger";
}

TEST_F(Run, APauseKeepsTriggersAndAStopForgetsThem) {
  simulation.set_synchronous(true);
  simulation.trigger_step();
  simulation.pause();
  simulation.carry_out_requests();
  EXPECT_FALSE(simulation.step_is_due());
  simulation.start();
  simulation.carry_out_requests();
  EXPECT_TRUE(simulation.step_is_due());
  simulation.stop();
  simulation.start();
  simulation.carry_out_requests();
  EXPECT_FALSE(simulation.step_is_due()) << "still synchronous, and waiting";
  EXPECT_EQ(simulation.state(), RunState::kRunning);
}

TEST_F(Run, OtherThreadsMayAsk) {
  std::vector<std::thread> others;
  for (int i = 0; i < 4; ++i) {
    others.emplace_back([this] {
      for (int k = 0; k < 50; ++k) {
        simulation.stop();
        simulation.start();
      }
    });
  }
  for (std::thread& other : others) other.join();
  while (simulation.has_requests()) simulation.carry_out_requests();
  EXPECT_EQ(simulation.state(), RunState::kRunning);
}

}  // namespace
}  // namespace bubblesim::test::test_simulation_run
