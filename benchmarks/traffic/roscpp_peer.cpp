// SPDX-License-Identifier: BSD-3-Clause
// The roscpp nodes of traffic.py. `listen`: a typical subscriber and echo in roscpp, corresponding to script_peer.py
// and rospy_peer.py. `drive`: the node that publishes to all of them, controlled by lines on its standard input:
//   send TYPE NODE COUNT RATE   publishes COUNT messages at RATE Hz to NODE, prints a line when they are sent
//   ping NODE COUNT             prints the median time of a Twist to NODE and back in microseconds
#include <geometry_msgs/Twist.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::uint32_t kQueue = 1000;
constexpr std::uint32_t kPoints = 100'000;

template <class Message>
using Callback = boost::function<void(const boost::shared_ptr<const Message>&)>;

const ros::TransportHints kNoDelay = ros::TransportHints().tcpNoDelay();

geometry_msgs::Twist twist() {
  geometry_msgs::Twist message;
  message.linear.x = 1;
  return message;
}

sensor_msgs::LaserScan scan() {
  sensor_msgs::LaserScan message;
  message.header.frame_id = "laser";
  message.ranges.resize(720, 1.5F);
  message.intensities.resize(720, 1.0F);
  return message;
}

sensor_msgs::Image image() {
  sensor_msgs::Image message;
  message.header.frame_id = "camera";
  message.width = 640;
  message.height = 480;
  message.encoding = "rgb8";
  message.step = message.width * 3;
  message.data.resize(message.step * message.height, 127);
  return message;
}

sensor_msgs::PointCloud2 cloud() {
  sensor_msgs::PointCloud2 message;
  message.header.frame_id = "lidar";
  message.height = 1;
  message.width = kPoints;
  message.point_step = 16;
  message.row_step = message.point_step * message.width;
  message.data.resize(message.row_step, 1);
  return message;
}

class Listener {
 public:
  Listener() {
    listen<geometry_msgs::Twist>("twist");
    listen<sensor_msgs::LaserScan>("scan");
    listen<sensor_msgs::Image>("image");
    listen<sensor_msgs::PointCloud2>("cloud");
    pong_ = node_.advertise<geometry_msgs::Twist>("pong", kQueue);
    const Callback<geometry_msgs::Twist> echo = [this](const auto& ping) { pong_.publish(ping); };
    subscribers_.push_back(node_.subscribe<geometry_msgs::Twist>("ping", kQueue, echo, {}, kNoDelay));
  }
  ~Listener() {
    for (const auto& [name, count] : counts_) std::cout << name << " " << count << "\n";
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

 private:
  template <class Message>
  void listen(const std::string& name) {
    const Callback<Message> count = [&seen = counts_[name]](const auto&) { ++seen; };
    subscribers_.push_back(node_.subscribe<Message>(name, kQueue, count, {}, kNoDelay));
  }

  ros::NodeHandle node_{"~"};
  std::map<std::string, int> counts_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher pong_;
};

class Driver {
 public:
  void send(const std::string& type, const std::string& node, int count, double rate) {
    if (type == "twist") send(twist(), node + "/twist", count, rate);
    if (type == "scan") send(scan(), node + "/scan", count, rate);
    if (type == "image") send(image(), node + "/image", count, rate);
    if (type == "cloud") send(cloud(), node + "/cloud", count, rate);
  }

  double ping(const std::string& node, int count) {
    bool answered = false;
    const Callback<geometry_msgs::Twist> notice = [&answered](const auto&) { answered = true; };
    const ros::Subscriber pong = node_.subscribe<geometry_msgs::Twist>(node + "/pong", kQueue, notice, {}, kNoDelay);
    const ros::Publisher ping = connected<geometry_msgs::Twist>(node + "/ping");
    while (pong.getNumPublishers() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const geometry_msgs::Twist message = twist();
    std::vector<double> microseconds;
    for (int i = 0; i < count; ++i) {
      answered = false;
      const Clock::time_point sent = Clock::now();
      ping.publish(message);
      while (!answered) ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(1.0));
      microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - sent).count());
    }
    std::nth_element(microseconds.begin(), microseconds.begin() + count / 2, microseconds.end());
    return microseconds[static_cast<std::size_t>(count) / 2];
  }

 private:
  template <class Message>
  void send(const Message& message, const std::string& topic, int count, double rate) {
    const ros::Publisher publisher = connected<Message>(topic);
    Clock::time_point next = Clock::now();
    for (int i = 0; i < count; ++i) {
      publisher.publish(message);
      next += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate));
      std::this_thread::sleep_until(next);
    }
  }

  template <class Message>
  ros::Publisher connected(const std::string& topic) {
    ros::Publisher& publisher = publishers_[topic];
    if (!publisher) publisher = node_.advertise<Message>(topic, kQueue);
    while (publisher.getNumSubscribers() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return publisher;
  }

  ros::NodeHandle node_;
  std::map<std::string, ros::Publisher> publishers_;
};

void drive() {
  Driver driver;
  std::string what;
  std::string node;
  int count = 0;
  while (std::cin >> what) {
    if (what == "send") {
      std::string type;
      double rate = 0;
      std::cin >> type >> node >> count >> rate;
      driver.send(type, node, count, rate);
      std::cout << "sent" << std::endl;
    } else {
      std::cin >> node >> count;
      std::cout << driver.ping(node, count) << std::endl;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string role = argc > 1 ? argv[1] : "";
  ros::init(argc, argv, role == "drive" ? "driver" : "roscpp");
  if (role == "drive") {
    drive();
  } else {
    const Listener listener;
    ros::spin();
  }
  return 0;
}
