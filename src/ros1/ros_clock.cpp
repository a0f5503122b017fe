// SPDX-License-Identifier: BSD-3-Clause
#include "ros_clock.hpp"

#include <ros/names.h>
#include <ros/subscribe_options.h>
#include <ros/time.h>
#include <ros/topic_manager.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "console/log_line.hpp"
#include "master/master_call.hpp"
#include "peers/own_types.hpp"
#include "topics/topics.hpp"

namespace bubblesim {
namespace {

using messages::BridgeTime;
using messages::WireBuffer;

constexpr std::uint32_t kQueueSize = 10;
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

BridgeTime to_bridge_time(std::int64_t nanoseconds) {
  return {static_cast<std::uint32_t>(nanoseconds / kNanosecondsPerSecond),
          static_cast<std::uint32_t>(nanoseconds % kNanosecondsPerSecond)};
}

}  // namespace

RosClock::RosClock(ros::CallbackQueue& queue)
    : queue_(queue),
      publisher_(std::make_shared<PublisherEndpoint>(ros::names::resolve("/clock"), clock_type(), kQueueSize, false)) {}

void RosClock::register_at_master() {
  use_sim_time_ = ros::Time::isSimTime();  // roscpp has just read the parameter
  publisher_->register_at_master();
}

/// As roscpp does when it starts. Once its own time follows /clock it cannot be stopped; it keeps following, because it
/// only stamps log messages.
void RosClock::read_use_sim_time() {
  RpcAnswer answer = ask_master("getParam", {"/use_sim_time"});
  if (!answer.answered) return;  // no master again: keep the last value
  use_sim_time_ =
      answer.succeeded && answer.value.getType() == XmlRpc::XmlRpcValue::TypeBoolean && static_cast<bool>(answer.value);
  if (!use_sim_time_ || ros::Time::isSimTime() || follows_.exchange(true)) return;
  ros::Time::setNow(ros::Time());
  ros::SubscribeOptions options;
  options.init<rosgraph_msgs::Clock>(
      topic(), 1, [](const rosgraph_msgs::Clock::ConstPtr& message) { ros::Time::setNow(message->clock); });
  options.callback_queue = &queue_;
  ros::TopicManager::instance()->subscribe(options);
}

void RosClock::check_type(const std::string& other_topic, const messages::MessageType& type) const {
  if (other_topic == topic()) check_same_type(other_topic, type, "advertised", publisher_->type());
}

void RosClock::say_left_to_script() {
  if (std::exchange(said_script_, true)) return;
  log_line("a script advertises " + topic() + ": the simulator does not publish it");
}

void RosClock::set(double sim_time) {
  sim_time_ = std::max<std::int64_t>(0, std::llround(sim_time * kNanosecondsPerSecond));
}

void RosClock::publish() {
  if (!publisher_->wants_messages()) return;
  const BridgeTime time = to_bridge_time(sim_time_);
  WireBuffer message;
  message.put(time.sec);
  message.put(time.nanosec);
  publisher_->publish(std::move(message));
}

bool RosClock::reaches_others() const {
  const bool to_itself = follows_ || ros::Time::isSimTime();  // roscpp's subscription or ours, possibly still pending
  return !use_sim_time_ || publisher_->subscribers() > (to_itself ? 1U : 0U);
}

BridgeTime RosClock::now() const {
  // Before the first answer of the master, use wall time, as any other node would.
  if (use_sim_time_) return to_bridge_time(sim_time_);
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  return to_bridge_time(std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count());
}

}  // namespace bubblesim
