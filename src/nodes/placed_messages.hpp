// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <message_filters/subscriber.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace bubblesim {

/// Messages of a topic, each once its frame can be transformed to a target frame, in the order of their time stamps.
/// tf2's filter notifies when that is, but of messages that waited for the same transform in any order.
template <typename Message>
class PlacedMessages {
 public:
  using Ptr = typename Message::ConstPtr;
  using Take = std::function<void(const Ptr&)>;
  using Lose = std::function<void(const Ptr&, tf2_ros::FilterFailureReason)>;

  /// `queue_size`: how many may wait; the oldest is lost first. `tolerance`: as of tf2_ros::MessageFilter.
  PlacedMessages(message_filters::Subscriber<Message>& messages, tf2_ros::Buffer& transforms, std::string target,
                 std::uint32_t queue_size, const ros::NodeHandle& node, Take take, Lose lose,
                 const ros::Duration& tolerance = ros::Duration(0.0))
      : transforms_(transforms),
        target_(std::move(target)),
        take_(std::move(take)),
        lose_(std::move(lose)),
        // Connected before the filter, so that a message waits when it is ready.
        arrivals_(messages.registerCallback(&PlacedMessages::wait, this)),
        filter_(messages, transforms, target_, queue_size, node) {
    filter_.setTolerance(tolerance);
    filter_.registerCallback(&PlacedMessages::release, this);
    filter_.registerFailureCallback([this](const Ptr& message, auto reason) { this->forget(message, reason); });
  }
  PlacedMessages(const PlacedMessages&) = delete;
  PlacedMessages& operator=(const PlacedMessages&) = delete;
  ~PlacedMessages() { arrivals_.disconnect(); }

  void clear() {
    filter_.clear();
    waiting_.clear();
  }

 private:
  void wait(const Ptr& message) { waiting_.emplace(message->header.stamp, message); }

  /// Takes `message`, and before it what has become ready with it.
  void release(const Ptr& message) {
    const auto ready = [&](const auto& entry) { return entry.second == message || can_place(*entry.second); };
    for (auto next = std::find_if(waiting_.begin(), waiting_.end(), ready); next != waiting_.end();
         next = std::find_if(waiting_.begin(), waiting_.end(), ready)) {
      const Ptr taken = next->second;
      waiting_.erase(next);  // before take(), which may clear all
      take_(taken);
    }
  }

  bool can_place(const Message& message) const {
    return transforms_.canTransform(target_, message.header.frame_id, message.header.stamp);
  }

  void forget(const Ptr& message, tf2_ros::FilterFailureReason reason) {
    const auto lost =
        std::find_if(waiting_.begin(), waiting_.end(), [&](const auto& e) { return e.second == message; });
    if (lost == waiting_.end()) return;  // released with an earlier one
    waiting_.erase(lost);
    lose_(message, reason);
  }

  const tf2_ros::Buffer& transforms_;
  std::string target_;
  Take take_;
  Lose lose_;
  std::multimap<ros::Time, Ptr> waiting_;
  message_filters::Connection arrivals_;
  tf2_ros::MessageFilter<Message> filter_;
};

}  // namespace bubblesim
