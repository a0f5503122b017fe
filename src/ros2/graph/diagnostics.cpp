// SPDX-License-Identifier: BSD-3-Clause
#include "graph/diagnostics.hpp"

#include <chrono>
#include <utility>

#include "bubblesim/messages/qos.hpp"
#include "graph/names.hpp"
#include "quiet_thread.hpp"

namespace bubblesim::ros2 {
namespace {

constexpr std::chrono::seconds kPeriod{1};

void put_now(messages::WireBuffer& message) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now);
  message.put(static_cast<std::int32_t>(seconds.count()));
  message.put(static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now - seconds).count()));
}

void put_status(const std::string& name, const Diagnosis& found, messages::WireBuffer& message) {
  message.put(static_cast<std::uint8_t>(found.level));
  message.put_string(name);
  message.put_string(found.message);
  message.put_string("bubblesim");  // hardware_id
  message.put(static_cast<std::uint32_t>(found.values.size()));
  for (const auto& [key, value] : found.values) {
    message.put_string(key);
    message.put_string(value);
  }
}

}  // namespace

Diagnostics::Diagnostics(Participant& participant, const messages::MessageType& type, std::string node,
                         std::function<RunReport()> take_report, std::function<TrafficReport()> take_traffic)
    : node_(std::move(node)),
      take_report_(std::move(take_report)),
      take_traffic_(std::move(take_traffic)),
      writer_(participant, message_topic("/diagnostics", type), messages::Qos(), nullptr),
      thread_(start_without_signals([this] { publish_each_second(); })) {}

Diagnostics::~Diagnostics() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  end_.notify_all();
  thread_.join();
}

void Diagnostics::publish_each_second() {
  auto next = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!end_.wait_until(lock, next += kPeriod, [this] { return ending_; })) {
    lock.unlock();
    publish();
    lock.lock();
  }
}

void Diagnostics::publish() {
  const std::lock_guard lock(publishing_);
  messages::WireBuffer message;
  message.begin(messages::Layout::kCdr);
  put_now(message);
  message.put_string("");         // frame_id
  message.put(std::uint32_t{2});  // statuses
  put_status(node_ + ": Simulation", diagnosis_.judge(take_report_()), message);
  put_status(node_ + ": Topics", judge(take_traffic_()), message);
  write(*writer_, message);
}

}  // namespace bubblesim::ros2
