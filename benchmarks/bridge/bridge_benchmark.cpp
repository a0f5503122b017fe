// SPDX-License-Identifier: BSD-3-Clause
// Compares publishing a 640x480 image with messages::Bridge (serialized message) and ros::Publisher
// (sensor_msgs/Image), alternately in one process, to a subscriber in another process (the same program with the
// argument `subscriber`). Prints medians and their ratio. Needs a roscore at ROS_MASTER_URI.
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "bubblesim/ros_bridge.hpp"

namespace {

using bubblesim::messages::EndpointId;
using bubblesim::messages::MessageType;
using bubblesim::messages::WireBuffer;
using Clock = std::chrono::steady_clock;

constexpr int kRounds = 400;
constexpr int kUnheardCalls = 200'000;
constexpr auto kPause = std::chrono::milliseconds(4);  // until each message is sent, so that none is queued

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

template <class Function>
double microseconds(Function&& function) {
  const auto begin = Clock::now();
  function();
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

sensor_msgs::Image make_image() {
  sensor_msgs::Image image;
  image.header.frame_id = "camera";
  image.width = 640;
  image.height = 480;
  image.encoding = "rgb8";
  image.step = image.width * 3;
  image.data.resize(image.step * image.height, 127);
  return image;
}

/// Copy the pixels into the buffer, as a codec does.
WireBuffer to_wire(const std::vector<std::uint8_t>& bytes) {
  WireBuffer message;
  message.put_bytes(bytes.data(), bytes.size());
  return message;
}

std::vector<std::uint8_t> serialize(const sensor_msgs::Image& image) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(image));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, image);
  return bytes;
}

MessageType image_type() {
  namespace traits = ros::message_traits;
  MessageType type;
  type.name = traits::datatype<sensor_msgs::Image>();
  type.type_hash = traits::md5sum<sensor_msgs::Image>();
  type.definition = traits::definition<sensor_msgs::Image>();
  type.has_header = true;
  return type;
}

int run_subscriber(int argc, char** argv) {
  ros::init(argc, argv, "bridge_benchmark_subscriber");
  ros::NodeHandle node;
  const boost::function<void(const sensor_msgs::Image::ConstPtr&)> ignore = [](const auto&) {};
  const auto raw = node.subscribe<sensor_msgs::Image>("/benchmark/roscpp", 1, ignore);
  const auto bridged = node.subscribe<sensor_msgs::Image>("/benchmark/bridge", 1, ignore);
  ros::spin();
  return 0;
}

void compare_images(bubblesim::RosBridge& bridge, const MessageType& type) {
  ros::NodeHandle node;
  const sensor_msgs::Image image = make_image();
  const std::vector<std::uint8_t> bytes = serialize(image);
  ros::Publisher raw = node.advertise<sensor_msgs::Image>("/benchmark/roscpp", 1);
  const EndpointId bridged = bridge.advertise("/benchmark/bridge", type, {1});
  while (raw.getNumSubscribers() == 0 || !bridge.wants_messages(bridged)) std::this_thread::sleep_for(kPause);

  std::vector<double> raw_times;
  std::vector<double> bridge_times;
  for (int round = 0; round < kRounds; ++round) {
    raw_times.push_back(microseconds([&] { raw.publish(image); }));
    std::this_thread::sleep_for(kPause);
    bridge_times.push_back(microseconds([&] { bridge.publish(bridged, to_wire(bytes)); }));
    std::this_thread::sleep_for(kPause);
  }
  const double raw_median = median(raw_times);
  const double bridge_median = median(bridge_times);
  std::printf("image of %zu bytes, one subscriber: roscpp %.1f us, bridge %.1f us, ratio %.2f\n", bytes.size(),
              raw_median, bridge_median, bridge_median / raw_median);
}

void compare_unheard(bubblesim::RosBridge& bridge, const MessageType& type) {
  ros::NodeHandle node;
  const sensor_msgs::Image image = make_image();
  ros::Publisher raw = node.advertise<sensor_msgs::Image>("/benchmark/unheard_roscpp", 1);
  const EndpointId bridged = bridge.advertise("/benchmark/unheard_bridge", type, {1});
  std::vector<double> raw_times;
  std::vector<double> bridge_times;
  for (int round = 0; round < 21; ++round) {
    raw_times.push_back(microseconds([&] {
      for (int i = 0; i < kUnheardCalls; ++i) raw.publish(image);
    }));
    bridge_times.push_back(microseconds([&] {
      for (int i = 0; i < kUnheardCalls; ++i) {
        if (bridge.wants_messages(bridged)) std::abort();
      }
    }));
  }
  const double raw_median = median(raw_times) / kUnheardCalls * 1e3;
  const double bridge_median = median(bridge_times) / kUnheardCalls * 1e3;
  std::printf("no subscriber: roscpp publish %.0f ns, bridge wants_messages %.0f ns, ratio %.2f\n", raw_median,
              bridge_median, bridge_median / raw_median);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "subscriber") == 0) return run_subscriber(argc, argv);
  bubblesim::RosBridge bridge(argc, argv);
  if (!bridge.connected()) return 1;
  std::string role = "subscriber";
  std::vector<char*> arguments{argv[0], role.data(), nullptr};
  pid_t subscriber = 0;
  if (posix_spawn(&subscriber, "/proc/self/exe", nullptr, nullptr, arguments.data(), environ) != 0) return 1;
  const MessageType type = image_type();
  compare_unheard(bridge, type);
  compare_images(bridge, type);
  kill(subscriber, SIGINT);
  waitpid(subscriber, nullptr, 0);
  return 0;
}
