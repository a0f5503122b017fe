// SPDX-License-Identifier: BSD-3-Clause
#include "topics/outbox.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "quiet_thread.hpp"

namespace bubblesim::ros2 {
namespace {

constexpr std::chrono::milliseconds kMostForWriting{10};  // a subscriber that is stopped holds up writes

}  // namespace

Outbox::Outbox() : thread_(start_without_signals([this] { run(); })) {}

Outbox::~Outbox() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  added_.notify_one();
  thread_.join();
}

void Outbox::add(const std::shared_ptr<Outgoing>& outgoing, messages::WireBuffer message) {
  {
    std::unique_lock lock(mutex_);
    const auto has_place = [&] { return outgoing->depth == 0 || outgoing->messages.size() < outgoing->depth; };
    if (has_place() || written_.wait_for(lock, kMostForWriting, has_place)) {
      order_.push_back(outgoing);
    } else {
      outgoing->messages.pop_front();
    }
    outgoing->messages.push_back(std::move(message));
  }
  added_.notify_one();
}

void Outbox::settle() {
  std::unique_lock lock(mutex_);
  written_.wait_for(lock, kMostForWriting, [this] { return order_.empty() && in_hand_ == nullptr; });
}

void Outbox::wait_until_written(const Outgoing& outgoing, std::chrono::steady_clock::time_point end) {
  std::unique_lock lock(mutex_);
  written_.wait_until(lock, end, [&] { return outgoing.messages.empty() && in_hand_ != &outgoing; });
}

void Outbox::drop(const Outgoing& outgoing) {
  std::unique_lock lock(mutex_);
  order_.erase(std::remove_if(order_.begin(), order_.end(), [&](const auto& each) { return each.get() == &outgoing; }),
               order_.end());
  written_.wait(lock, [&] { return in_hand_ != &outgoing; });
}

void Outbox::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    added_.wait(lock, [this] { return ending_ || !order_.empty(); });
    if (ending_) return;
    const std::shared_ptr<Outgoing> outgoing = std::move(order_.front());
    order_.pop_front();
    in_hand_ = outgoing.get();
    {
      messages::WireBuffer message = std::move(outgoing->messages.front());
      outgoing->messages.pop_front();
      lock.unlock();
      write(*outgoing->writer, message);
    }
    lock.lock();
    in_hand_ = nullptr;
    written_.notify_all();
  }
}

}  // namespace bubblesim::ros2
