// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>

#include <cstdint>
#include <functional>
#include <utility>

namespace bubblesim {

/// The topic scan. The spinning thread switches its source on while it has subscribers.
class LazyScans {
 public:
  /// `queue_size`: as many as can be converted at once, because roscpp drops what its queue does not hold.
  LazyScans(ros::NodeHandle& node, std::uint32_t queue_size, std::function<void()> start, std::function<void()> stop)
      : start_(std::move(start)), stop_(std::move(stop)) {
    const ros::SubscriberStatusCallback changed = [this](const auto&) { follow_listeners(); };
    publisher_ = node.advertise<sensor_msgs::LaserScan>("scan", queue_size, changed, changed);
  }

  void publish(const sensor_msgs::LaserScan& scan) { publisher_.publish(scan); }

 private:
  void follow_listeners() {
    const bool subscribed = publisher_.getNumSubscribers() > 0;
    if (subscribed == running_) return;
    running_ = subscribed;
    subscribed ? start_() : stop_();
  }

  std::function<void()> start_;
  std::function<void()> stop_;
  ros::Publisher publisher_;
  bool running_ = false;
};

}  // namespace bubblesim
