// SPDX-License-Identifier: BSD-3-Clause
// Commands to a runner, their answers, the loop, and frames.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bubblesim/runner.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_runner {
namespace {

constexpr double kAsFastAsPossible = std::numeric_limits<double>::infinity();
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

RunnerOptions fast(RunState initial = RunState::kPaused) {
  RunnerOptions options;
  options.speed = kAsFastAsPossible;
  options.initial = initial;
  return options;
}

SceneDescription falling_ball() { return scene({model("Ball", link("link"))}); }

/// A ball in free fall, with a recorder.
struct Run : testing::Test {
  void make(RunnerOptions options) {
    simulation.add(witness);
    runner = std::make_unique<Runner>(simulation, std::move(options));
    witness.runner = runner.get();
  }

  Simulation simulation{falling_ball(), 1};
  Witness witness;
  std::unique_ptr<Runner> runner;
};

std::string reason(std::future<double> result) {
  try {
    result.get();
  } catch (const NotCarriedOut& error) {
    return error.what();
  }
  return "carried out";
}

TEST_F(Run, StepsOfAPauseAreDoneWhenTheAnswerComes) {
  make(fast());
  runner->run_in_background();
  EXPECT_DOUBLE_EQ(runner->step(3).get(), 3 * kStep);
  EXPECT_DOUBLE_EQ(runner->step().get(), 4 * kStep);
  EXPECT_DOUBLE_EQ(runner->step(0).get(), 4 * kStep);
  EXPECT_EQ(runner->state(), RunState::kPaused);
  runner->finish();
  EXPECT_EQ(witness.seen, Seen(4, "step paused"));
}

TEST_F(Run, CommandsAreCarriedOutInTheirOrder) {
  make(fast(RunState::kPaused));
  const auto stopped = runner->stop();
  runner->start();
  runner->call([&] { witness.note("call"); });
  auto paused = runner->pause();
  runner->run_in_background();
  EXPECT_EQ(paused.get(), RunState::kPaused);
  runner->finish();
  EXPECT_EQ(witness.seen, (Seen{"step stopping", "stop stopping", "start running", "call running"}));
}

TEST_F(Run, AStopGivesOneMoreStepAndThenTheStateOfANewSimulation) {
  make(fast());
  const std::uint64_t fresh = simulation.state_hash();
  runner->run_in_background();
  runner->step(1).get();
  EXPECT_EQ(runner->stop().get(), RunState::kStopped);
  EXPECT_EQ(runner->call([&] { return simulation.state_hash(); }).get(), fresh);
  EXPECT_EQ(runner->frame()->time, 0);
  EXPECT_EQ(runner->frame()->state, RunState::kStopped);
  runner->finish();
  EXPECT_EQ(witness.seen, (Seen{"step paused", "step stopping", "stop stopping"}));
}

TEST_F(Run, WhatIsStoppedCanNeitherBePausedNorStoppedNorStepped) {
  make(fast(RunState::kStopped));
  runner->run_in_background();
  EXPECT_EQ(runner->pause().get(), RunState::kStopped);
  EXPECT_EQ(runner->stop().get(), RunState::kStopped);
  EXPECT_NE(reason(runner->step()).find("start it first"), std::string::npos);
  runner->finish();
  EXPECT_EQ(witness.seen, Seen());
}

TEST_F(Run, WhatRunsByItselfCannotBeStepped) {
  make(fast(RunState::kRunning));
  runner->run_in_background();
  EXPECT_NE(reason(runner->step()).find("pause it first"), std::string::npos);
}

TEST_F(Run, ARequestForStepsIsInterruptedByAPauseAndRefusesASecondOne) {
  make(fast());
  runner->run_in_background();
  auto first = runner->step(1'000'000'000);
  EXPECT_NE(reason(runner->step()).find("already being stepped"), std::string::npos);
  runner->pause().get();
  EXPECT_NE(reason(std::move(first)).find("interrupted after"), std::string::npos);
  EXPECT_GT(runner->step().get(), 0);
}

TEST_F(Run, OtherCommandsAreCarriedOutBetweenRequestedSteps) {
  make(fast());
  runner->run_in_background();
  auto steps = runner->step(1'000'000'000);
  double last = -1;
  for (int i = 0; i < 5; ++i) {
    const double now = runner->call([&] { return simulation.time(); }).get();
    EXPECT_GE(now, last);
    last = now;
  }
  runner->stop().get();
  EXPECT_NE(reason(std::move(steps)), "carried out");
}

TEST_F(Run, AStepCannotAskForSteps) {
  make(fast());
  std::string why;
  witness.on_step = [&] { why = reason(runner->step()); };
  runner->run_in_background();
  runner->step().get();
  EXPECT_NE(why.find("by the step that made this request"), std::string::npos);
}

TEST_F(Run, CommandsOfASystemWaitForTheNextTime) {
  make(fast(RunState::kRunning));
  witness.on_stop = [&] {
    witness.on_stop = nullptr;
    runner->start();
    runner->end();
  };
  runner->stop();
  runner->run();
  EXPECT_EQ(witness.seen, (Seen{"step stopping", "stop stopping", "start running"}));
}

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
    for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
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
  for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
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
  for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
  EXPECT_EQ(runner->frame()->time, 0);
  arrived = true;
  runner->wake();
  while (runner->frame()->time == 0) std::this_thread::yield();
  for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
  EXPECT_DOUBLE_EQ(runner->frame()->time, kStep);
}

TEST_F(Run, AStepWaitsForAllGates) {
  make(fast(RunState::kRunning));
  bool first = false;
  bool second = true;
  const auto reason = [] { return "no answer"; };
  runner->add_gate({[&] { return first; }, reason});
  const GateId other = runner->add_gate({[&] { return second; }, reason});
  runner->run_in_background();
  for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
  EXPECT_EQ(runner->frame()->time, 0);
  runner->call([&] { std::swap(first, second); }).get();
  for (int rounds = 0; rounds < 3; ++rounds) runner->call([] {}).get();
  EXPECT_EQ(runner->frame()->time, 0);
  runner->call([&] { runner->remove_gate(other); }).get();
  while (runner->frame()->time == 0) std::this_thread::yield();
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

TEST_F(Run, AnswersACallWhileItWaitsForRealTime) {
  RunnerOptions options;
  options.speed = 1e-3;  // a step in 50 s
  options.initial = RunState::kRunning;
  make(options);
  runner->run_in_background();
  while (runner->frame()->time == 0) std::this_thread::yield();
  EXPECT_DOUBLE_EQ(runner->call([&] { return simulation.time(); }).get(), kStep);
}

TEST_F(Run, ACallThrowsToItsCaller) {
  make(fast());
  runner->run_in_background();
  auto result = runner->call([&] { return simulation.world().tree().find("/None"); });
  EXPECT_THROW(result.get(), NoSuchObject);
}

TEST_F(Run, FramesShowTheStateAfterTheStep) {
  make(fast());
  EXPECT_EQ(runner->frame()->time, 0);
  runner->run_in_background();
  runner->step(10).get();
  const std::shared_ptr<const Frame> frame = runner->frame();
  EXPECT_DOUBLE_EQ(frame->time, 0.5);
  ASSERT_EQ(frame->poses.size(), 1U);
  // Semi-implicit Euler: after n substeps of h, z = -g h^2 n (n + 1) / 2.
  const double fallen = kGravity * kSubstep * kSubstep * 100 * 101 / 2;
  EXPECT_NEAR(frame->poses[0][2], -fallen, 1e-5);
  EXPECT_EQ(frame->poses[0][6], 1) << "w of the quaternion";
  EXPECT_EQ(runner->frame()->layout, frame->layout) << "shared until models come or go";
  runner->call([&] { simulation.add_model(model("Second", link("link"), at(0, 0, 5))); }).get();
  EXPECT_NE(runner->frame()->layout->revision, frame->layout->revision);
  EXPECT_EQ(runner->frame()->poses.size(), 2U);
  EXPECT_EQ(frame->poses.size(), 1U) << "a frame does not change";
}

TEST_F(Run, FramesLeaveOutStaticLinks) {
  SceneDescription with_floor = scene({floor(), model("Ball", link("link"))});
  Simulation other{with_floor, 1};
  EXPECT_EQ(Runner(other).frame()->poses.size(), 1U);
}

TEST_F(Run, TheSimulationRefusesOtherThreadsMeanwhile) {
  make(fast());
  runner->run_in_background();
  EXPECT_THROW(simulation.step(), std::logic_error);
  EXPECT_THROW(simulation.process_input(), std::logic_error);
  EXPECT_THROW(simulation.reset(), std::logic_error);
  EXPECT_THROW(simulation.add_model(model("Second", link("link"))), std::logic_error);
  EXPECT_THROW(runner->run_in_background(), std::logic_error);
  runner->finish();
  simulation.step();
  EXPECT_THROW(runner->start().get(), NotCarriedOut);
  runner->run_in_background();
  EXPECT_DOUBLE_EQ(runner->step().get(), 2 * kStep) << "it may run again";
}

TEST_F(Run, ThreadsCommandAndReadWhileItSteps) {
  make(fast(RunState::kRunning));
  runner->run_in_background();
  std::vector<std::thread> others;
  std::atomic<int> refused{0};
  for (int i = 0; i < 3; ++i) {
    others.emplace_back([&] {
      double last = 0;
      for (int k = 0; k < 200; ++k) {
        runner->pause();
        runner->step(2);
        runner->start();
        const double time = runner->call([&] { return simulation.time(); }).get();
        EXPECT_GE(time, last);
        last = time;
        const std::shared_ptr<const Frame> frame = runner->frame();
        EXPECT_EQ(frame->poses.size(), frame->layout->links.size());
        try {
          simulation.reset_world();
        } catch (const std::logic_error&) {
          ++refused;
        }
      }
    });
  }
  for (std::thread& other : others) other.join();
  EXPECT_EQ(refused, 600);
  runner->finish();
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
}  // namespace bubblesim::test::test_runner
