// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "topics/endpoints.hpp"

namespace bubblesim {

/// ROS time, as this node publishes it on /clock and uses it.
class RosClock {
 public:
  /// Messages on /clock are processed when `queue` is called.
  explicit RosClock(ros::CallbackQueue& queue);

  const std::string& topic() const { return publisher_->topic(); }

  /// On the master thread: after roscpp has started, and after each change of the master.
  void register_at_master();
  void read_use_sim_time();

  /// On the simulation thread, like everything below. Throws std::invalid_argument for another type on the topic.
  void check_type(const std::string& topic, const messages::MessageType& type) const;
  /// Logs once that a script publishes the topic.
  void say_left_to_script();
  /// Sets the time that now() returns under /use_sim_time and that publish() publishes [s].
  void set(double sim_time);
  void publish();
  messages::BridgeTime now() const;
  /// See messages::Bridge.
  bool reaches_others() const;

 private:
  ros::CallbackQueue& queue_;
  const std::shared_ptr<PublisherEndpoint> publisher_;
  bool said_script_ = false;
  std::int64_t sim_time_ = 0;  // [ns]
  std::atomic<bool> use_sim_time_{false};
  std::atomic<bool> follows_{false};  // roscpp's own time follows /clock, from our subscription
};

}  // namespace bubblesim
