// SPDX-License-Identifier: BSD-3-Clause
// Commands to a runner and their answers, also from several threads.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bubblesim/descriptor_watch.hpp"
#include "bubblesim/runner.hpp"
#include "runs.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_runner {
namespace {

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

std::string refusal_of(Runner& runner) {
  try {
    runner.run_in_background();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST_F(Run, ASecondRunnerIsRefusedUntilTheFirstIsClosed) {
  make(fast());
  Runner second(simulation, fast());
  runner->run_in_background();
  EXPECT_NE(refusal_of(second).find("a Runner runs this simulation already"), std::string::npos);
  EXPECT_THROW(Runner(simulation, fast()), InvalidInput);
  EXPECT_NE(reason(second.step()), "carried out") << "nothing waits for a run that was refused";
  EXPECT_DOUBLE_EQ(runner->step().get(), kStep) << "the first is not disturbed";
  runner->finish();
  EXPECT_EQ(refusal_of(second), "not refused");
  EXPECT_DOUBLE_EQ(second.step().get(), 2 * kStep);
  second.finish();
}

TEST_F(Run, AThreadThatLetTheRunnerInGetsTheLockBack) {
  make(fast());
  AccessLock& access = simulation.world().access();
  {
    const AccessLock::Hold hold(access);
    const AccessLock::Pause others_may_use_it(access);
    runner->run_in_background();
  }
  EXPECT_DOUBLE_EQ(runner->step().get(), kStep);
}

TEST_F(Run, ItsGatesFilesAndFrameMemoryRefuseOtherThreadsWhileItRuns) {
  make(fast());
  const StepGate open{[] { return true; }, [] { return ""; }};
  const GateId gate = runner->add_gate(open);
  auto file = std::make_unique<DescriptorWatch>(*runner, STDIN_FILENO, [] { return false; });
  runner->run_in_background();
  EXPECT_THROW(runner->add_gate(open), std::logic_error);
  EXPECT_THROW(runner->remove_gate(gate), std::logic_error);
  EXPECT_THROW(runner->remove_gates(), std::logic_error);
  EXPECT_THROW(DescriptorWatch(*runner, STDIN_FILENO, [] { return false; }), std::logic_error);
  EXPECT_THROW(file->close(), std::logic_error);
  EXPECT_THROW(runner->share_frames(), std::logic_error);
  file.reset();  // leaves its end to the runner's thread
  runner->call([&] { runner->remove_gate(runner->add_gate(open)); }).get();
  EXPECT_NO_THROW(runner->call([&] { runner->share_frames(); }).get());
  runner->finish();
  EXPECT_NO_THROW(runner->share_frames());
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

}  // namespace
}  // namespace bubblesim::test::test_runner
