// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/worker_pool.hpp"

#include <sched.h>

#include <algorithm>
#include <memory>
#include <system_error>

#include "bubblesim/signals_blocked.hpp"

namespace bubblesim {
std::size_t usable_cores() {
  cpu_set_t usable;
  CPU_ZERO(&usable);
  if (sched_getaffinity(0, sizeof usable, &usable) == 0) return static_cast<std::size_t>(CPU_COUNT(&usable));
  return std::max(1U, std::thread::hardware_concurrency());
}

struct WorkerPool::Job {
  const Task& task;
  std::size_t count;
  std::size_t next = 0;     // the first part that no thread has begun
  std::size_t running = 0;  // parts begun and not ended
  bool awaited = false;     // the thread that gave the task waits for the last parts
  std::size_t failed_part = 0;
  std::exception_ptr failure = nullptr;
};

WorkerPool& WorkerPool::shared() {
  // Never destroyed: a process may end, or a fork of it without the threads, while threads wait.
  static WorkerPool& pool = *std::make_unique<WorkerPool>(usable_cores() - 1).release();
  return pool;
}

WorkerPool::WorkerPool(std::size_t workers) {
  const SignalsBlocked blocked;
  try {
    while (workers_.size() < workers) workers_.emplace_back([this] { serve(); });
  } catch (const std::system_error&) {
    // The system allows no more threads.
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (ending_) return;
    do_part(*jobs_.front(), lock);
  }
}

void WorkerPool::do_part(Job& job, std::unique_lock<std::mutex>& lock) {
  const std::size_t part = job.next++;
  if (job.next == job.count) jobs_.remove(&job);
  ++job.running;
  lock.unlock();
  std::exception_ptr failure;
  try {
    job.task(part);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  if (failure && (!job.failure || part < job.failed_part)) {
    job.failure = failure;
    job.failed_part = part;
  }
  --job.running;
  if (job.awaited && job.running == 0) changed_.notify_all();
}

void WorkerPool::run(std::size_t count, const Task& task) {
  if (count == 0) return;
  if (count == 1) return task(0);
  Job job{task, count};
  std::unique_lock lock(mutex_);
  jobs_.push_back(&job);
  for (std::size_t i = 1; i < count && i <= workers_.size(); ++i) changed_.notify_one();
  while (job.next < job.count) do_part(job, lock);
  // Parts of other jobs meanwhile: those that this one waits for may have given them.
  while (job.running > 0) {
    if (jobs_.empty()) {
      job.awaited = true;
      changed_.wait(lock);
    } else {
      do_part(*jobs_.front(), lock);
    }
  }
  if (job.failure) std::rethrow_exception(job.failure);
}

}  // namespace bubblesim
