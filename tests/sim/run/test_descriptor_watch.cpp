// SPDX-License-Identifier: BSD-3-Clause
// A runner that serves a file descriptor.
#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "bubblesim/descriptor_watch.hpp"
#include "bubblesim/runner.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_descriptor_watch {
namespace {

/// A counter that is readable above 0.
struct DescriptorWatchTest : testing::Test {
  DescriptorWatchTest() : runner(simulation) {}
  ~DescriptorWatchTest() override { ::close(counter); }
  DescriptorWatchTest(const DescriptorWatchTest&) = delete;
  DescriptorWatchTest& operator=(const DescriptorWatchTest&) = delete;

  void add(std::uint64_t count) const { ASSERT_EQ(write(counter, &count, sizeof count), sizeof count); }
  std::uint64_t take() const {
    std::uint64_t count = 0;
    return read(counter, &count, sizeof count) < 0 ? 0 : count;
  }
  static void wait_until(const std::atomic<std::uint64_t>& value, std::uint64_t least) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (value < least && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    EXPECT_GE(value, least);
  }

  int counter = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  Simulation simulation{scene({model("Ball", link("link"))}), 1};
  Runner runner;
};

TEST_F(DescriptorWatchTest, CallsOnTheRunnersThreadWhenTheFileIsReadable) {
  std::atomic<std::uint64_t> served{0};
  std::atomic<bool> elsewhere{false};
  DescriptorWatch watch(runner, counter, [&] {
    if (!runner.is_this_thread()) elsewhere = true;
    served += take();
    return false;
  });
  runner.run_in_background();
  for (std::uint64_t round = 1; round <= 20; ++round) {
    add(1);
    wait_until(served, round);
  }
  EXPECT_FALSE(elsewhere);
  runner.finish();
}

TEST_F(DescriptorWatchTest, CallsAgainWhileThereIsMore) {
  std::atomic<std::uint64_t> calls{0};
  add(1);
  DescriptorWatch watch(runner, counter, [&] {
    take();
    return ++calls < 5;
  });
  runner.run_in_background();
  wait_until(calls, 5);
  runner.finish();
  EXPECT_EQ(calls, 5);
}

TEST_F(DescriptorWatchTest, StepsComeBetweenItsCalls) {
  DescriptorWatch watch(runner, counter, [] { return true; });
  runner.run_in_background();
  EXPECT_DOUBLE_EQ(runner.step(20).get(), 1.0);
  runner.finish();
}

TEST_F(DescriptorWatchTest, EndsOnTheRunnersThreadWhileACallIsPending) {
  std::atomic<std::uint64_t> calls{0};
  auto watch = std::make_unique<DescriptorWatch>(runner, counter, [&] {
    ++calls;
    return true;
  });
  runner.run_in_background();
  wait_until(calls, 3);
  std::uint64_t at_end = 0;
  runner
      .call([&] {
        watch->close();
        at_end = calls;
      })
      .get();
  runner.step(2).get();
  EXPECT_EQ(calls, at_end);
  runner.finish();
}

TEST_F(DescriptorWatchTest, IsServedWhileTheRunnerWaitsForRealTimeAndWhileItDoesNotWait) {
  for (const double speed : {0.01, std::numeric_limits<double>::infinity()}) {  // a step takes 5 s, or no time
    RunnerOptions options;
    options.speed = speed;
    options.initial = RunState::kRunning;
    Runner fast_or_slow(simulation, options);
    std::atomic<std::uint64_t> served{0};
    DescriptorWatch watch(fast_or_slow, counter, [&] {
      served += take();
      return false;
    });
    fast_or_slow.run_in_background();
    for (std::uint64_t round = 1; round <= 20; ++round) {
      add(1);
      wait_until(served, round);
    }
    fast_or_slow.finish();
  }
}

TEST_F(DescriptorWatchTest, LooksAgainWhenAsked) {
  std::atomic<std::uint64_t> calls{0};
  DescriptorWatch watch(runner, counter, [&] {
    ++calls;
    return false;
  });
  runner.run_in_background();
  wait_until(calls, 1);
  for (std::uint64_t round = 2; round <= 5; ++round) {
    runner.call([&] { watch.serve_again(); }).get();
    wait_until(calls, round);
  }
  runner.finish();
  EXPECT_EQ(calls, 5);
}

TEST_F(DescriptorWatchTest, AnExceptionEndsItAndNotTheRun) {
  std::atomic<std::uint64_t> calls{0};
  DescriptorWatch watch(runner, counter, [&]() -> bool {
    ++calls;
    throw std::runtime_error("a test");
  });
  add(1);
  runner.run_in_background();
  EXPECT_DOUBLE_EQ(runner.step(20).get(), 1.0);
  runner.finish();
  EXPECT_EQ(calls, 1);
}

TEST_F(DescriptorWatchTest, OneWatchMayEndAnother) {
  std::atomic<std::uint64_t> calls{0};
  std::unique_ptr<DescriptorWatch> second;
  DescriptorWatch first(runner, counter, [&] {
    second.reset();
    return false;
  });
  second = std::make_unique<DescriptorWatch>(runner, counter, [&] {
    ++calls;
    return false;
  });
  runner.run_in_background();
  runner.step(2).get();
  runner.finish();
  EXPECT_EQ(second, nullptr);
  EXPECT_EQ(calls, 0);
}

TEST_F(DescriptorWatchTest, EndsWithoutARun) {
  DescriptorWatch watch(runner, counter, [] { return false; });
  watch.close();
}

}  // namespace
}  // namespace bubblesim::test::test_descriptor_watch
