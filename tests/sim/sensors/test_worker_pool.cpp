// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sensors/worker_pool.hpp"

namespace bubblesim::test::test_worker_pool {
namespace {

TEST(WorkerPool, DoesEachPartOnce) {
  for (const std::size_t workers : {0U, 1U, 3U}) {
    WorkerPool pool(workers);
    for (const std::size_t count : {0U, 1U, 2U, 100U}) {
      std::vector<std::atomic<int>> calls(count);
      pool.run(count, [&](std::size_t part) { ++calls[part]; });
      for (const std::atomic<int>& number : calls) EXPECT_EQ(number, 1);
    }
  }
}

/// How often threads of this process other than the calling one went to sleep.
long sleeps_of_other_threads() {
  long sum = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    if (thread.path().filename() == std::to_string(gettid())) continue;
    std::ifstream status(thread.path() / "status");
    const std::string key = "voluntary_ctxt_switches:";
    for (std::string line; std::getline(status, line);) {
      if (line.rfind(key, 0) == 0) sum += std::stol(line.substr(key.size()));
    }
  }
  return sum;
}

TEST(WorkerPool, WakesNoThreadForATaskOfOnePart) {
  WorkerPool pool(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the new threads begin to wait
  const long before = sleeps_of_other_threads();
  for (int i = 0; i < 200; ++i) {
    pool.run(1, [](std::size_t) {});
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  EXPECT_LT(sleeps_of_other_threads() - before, 20);
}

TEST(WorkerPool, TakesTasksFromWithinTasks) {
  WorkerPool pool(3);
  std::atomic<int> calls{0};
  pool.run(8, [&](std::size_t) { pool.run(8, [&](std::size_t) { pool.run(8, [&](std::size_t) { ++calls; }); }); });
  EXPECT_EQ(calls, 512);
}

TEST(WorkerPool, TakesTasksOfSeveralThreads) {
  WorkerPool pool(2);
  std::atomic<int> calls{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int task = 0; task < 50; ++task) pool.run(10, [&](std::size_t) { ++calls; });
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(calls, 2000);
}

TEST(WorkerPool, ThrowsTheExceptionOfTheFirstPartThatFails) {
  WorkerPool pool(3);
  std::atomic<int> calls{0};
  try {
    pool.run(50, [&](std::size_t part) {
      ++calls;
      if (part % 10 == 7) throw std::runtime_error(std::to_string(part));
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "7");
  }
  EXPECT_EQ(calls, 50);
  pool.run(5, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 55);
}

TEST(WorkerPool, WorksAndEndsInAForkedProcess) {
  WorkerPool::shared().run(4, [](std::size_t) {});
  const pid_t child = fork();
  if (child == 0) {
    std::atomic<int> calls{0};
    WorkerPool::shared().run(4, [&](std::size_t) { ++calls; });
    std::exit(calls == 4 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace bubblesim::test::test_worker_pool
