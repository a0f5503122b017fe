// SPDX-License-Identifier: BSD-3-Clause
// When a run steps, and when it ends.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "bubblesim/runner.hpp"
#include "runs.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_run_loop {
namespace {

TEST_F(Run, AStopMayBeTheEnd) {
  RunnerOptions options = fast(RunState::kRunning);
  options.ends_at_stop = true;
  make(options);
  runner->stop();
  auto late = runner->start();
  runner->run();
  EXPECT_EQ(witness.seen, Seen{"step stopping"});
  EXPECT_DOUBLE_EQ(simulation.time(), kStep) << "not reset";
  EXPECT_THROW(late.get(), NotCarriedOut);
}

TEST_F(Run, EndsAtItsTimeLimit) {
  RunnerOptions options = fast(RunState::kRunning);
  options.until = 1;
  make(options);
  runner->run();
  EXPECT_DOUBLE_EQ(simulation.time(), 1);
  EXPECT_EQ(witness.seen, Seen(20, "step running"));
}

TEST_F(Run, InSynchronousModeEachTriggerGivesOneStepAndAStopForgetsThem) {
  make(fast(RunState::kRunning));
  runner->trigger_step();  // no effect: not in synchronous mode
  runner->set_synchronous(true);
  runner->trigger_step();
  runner->trigger_step();
  runner->set_synchronous(true);
  runner->run_in_background();
  const auto wait_for_steps = [&](int steps) {
    while (runner->frame()->time < (steps - 0.5) * kStep) std::this_thread::yield();
    let_it_go_round();
    EXPECT_DOUBLE_EQ(runner->frame()->time, steps * kStep);
  };
  wait_for_steps(2);
  runner->trigger_step();
  wait_for_steps(3);
  runner->pause().get();
  runner->trigger_step();
  EXPECT_DOUBLE_EQ(runner->call([&] { return simulation.time(); }).get(), 3 * kStep);
  runner->start();
  wait_for_steps(4);
  runner->pause();
  runner->trigger_step();
  runner->stop();
  runner->start().get();
  let_it_go_round();
  EXPECT_EQ(runner->frame()->time, 0) << "the trigger was forgotten";
}

TEST_F(Run, AClosedGateHoldsBackStepsUntilInputOpensIt) {
  make(fast(RunState::kRunning));
  std::atomic<bool> arrived{false};
  bool open = false;
  witness.on_input = [&] { open = open || arrived; };
  witness.on_step = [&] { open = arrived = false; };
  runner->add_gate({[&] { return open; }, [] { return "no answer"; }});
  runner->run_in_background();
  let_it_go_round();
  EXPECT_EQ(runner->frame()->time, 0);
  arrived = true;
  runner->wake();
  while (runner->frame()->time == 0) std::this_thread::yield();
  let_it_go_round();
  EXPECT_DOUBLE_EQ(runner->frame()->time, kStep);
  runner->finish();  // before the variables of the gate are gone
}

TEST_F(Run, AStepWaitsForAllGates) {
  make(fast(RunState::kRunning));
  bool first = false;
  bool second = true;
  const auto reason = [] { return "no answer"; };
  runner->add_gate({[&] { return first; }, reason});
  const GateId other = runner->add_gate({[&] { return second; }, reason});
  runner->run_in_background();
  let_it_go_round();
  EXPECT_EQ(runner->frame()->time, 0);
  runner->call([&] { std::swap(first, second); }).get();
  let_it_go_round();
  EXPECT_EQ(runner->frame()->time, 0);
  runner->call([&] { runner->remove_gate(other); }).get();
  while (runner->frame()->time == 0) std::this_thread::yield();
  runner->finish();  // before the variables of the gates are gone
}

TEST_F(Run, KeepsToItsSpeed) {
  RunnerOptions options;
  options.speed = 2;
  options.initial = RunState::kRunning;
  options.until = 0.5;
  make(options);
  const auto begin = std::chrono::steady_clock::now();
  runner->run();
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(220))
      << "the last step begins at 0.45 s";
}

TEST_F(Run, KeepsToASpeedAtWhichTheNextStepIsDueAfterTheEndOfTheClock) {
  for (const double speed : {1e-12, 1e-300}) {
    RunnerOptions options;
    options.speed = speed;
    options.initial = RunState::kRunning;
    Simulation slow{falling_ball(), 1};
    Runner slow_runner(slow, options);
    slow_runner.run_in_background();
    while (slow_runner.frame()->time == 0) std::this_thread::yield();
    for (int i = 0; i < 5; ++i) slow_runner.call([] {}).get();
    EXPECT_DOUBLE_EQ(slow_runner.frame()->time, kStep) << speed;
  }
}

/// A ball that is about to leave the finite world.
struct Leaving {
  Leaving() {
    World& world = simulation.world();
    world.set_pose(world.tree().find("/Ball"), at(999999, 0, 5));
    world.set_velocity(world.tree().find("/Ball"), {{1e5, 0, 0}, {}});
  }
  Simulation simulation{falling_ball(), 1};
};

TEST(RunnerOfADivergingSimulation, PausesAndAStopPutsTheWorldBack) {
  Leaving leaving;
  std::promise<std::string> reported;
  RunnerOptions options = fast(RunState::kRunning);
  options.on_divergence = [&](const std::string& why) { reported.set_value(why); };
  Runner runner(leaving.simulation, options);
  runner.run_in_background();
  EXPECT_NE(reported.get_future().get().find("/Ball"), std::string::npos);
  EXPECT_NE(reason(runner.step()).find("diverged"), std::string::npos) << "also to who asks for steps";
  EXPECT_EQ(runner.state(), RunState::kPaused);
  EXPECT_EQ(runner.stop().get(), RunState::kStopped);
  runner.start();
  while (runner.frame()->time == 0) std::this_thread::yield();
}

TEST(RunnerOfADivergingSimulation, EndsWhereNothingCanResetIt) {
  Leaving leaving;
  RunnerOptions options = fast(RunState::kRunning);
  options.ends_at_stop = true;
  Runner runner(leaving.simulation, options);
  EXPECT_THROW(runner.run(), Diverged);
}

TEST(RunnerOfAFailingSystem, ThrowsItsErrorAtTheEnd) {
  struct Failing : System {
    void actuate(World&, double) override { throw std::runtime_error("broken"); }
  } failing;
  Simulation simulation{falling_ball(), 1};
  simulation.add(failing);
  Runner runner(simulation, fast());
  runner.run_in_background();
  EXPECT_THROW(runner.step().get(), NotCarriedOut);
  EXPECT_THROW(runner.finish(), std::runtime_error);
}

}  // namespace
}  // namespace bubblesim::test::test_run_loop
