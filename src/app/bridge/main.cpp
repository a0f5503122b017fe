// SPDX-License-Identifier: BSD-3-Clause
// The program `ros_bridge`: passes topics and services between ROS 1 and ROS 2, without a scene.
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "bridge/passer.hpp"
#include "bubblesim/ros2_bridge.hpp"
#include "bubblesim/ros_bridge.hpp"
#include "output.hpp"
#include "stop_signal.hpp"

namespace bubblesim::app {
namespace {

constexpr const char* kNodeName = "ros_bridge";
constexpr std::chrono::milliseconds kUpdateInterval{100};
constexpr std::chrono::seconds kLookInterval{1};
constexpr int kFine = 0;
constexpr int kBadInput = 2;

/// Wakes the loop when a side has received something.
class Alarm {
 public:
  void ring() {
    {
      const std::lock_guard lock(mutex_);
      rung_ = true;
    }
    changed_.notify_one();
  }
  void wait_for(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [this] { return rung_; });
    rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool rung_ = false;
};

/// The names on the command line: without arguments for a ROS node, which have a `:=`.
std::set<std::string> names_of(int argc, char** argv) {
  std::set<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.find(":=") != std::string::npos) continue;
    if (argument.front() != '/') {
      throw std::invalid_argument("expected names of topics and services such as /scan, found '" + argument + "'");
    }
    names.insert(argument);
  }
  return names;
}

void run(int argc, char** argv) {
  const std::set<std::string> names = names_of(argc, argv);
  watch_stop_signals();
  std::vector<char*> arguments(argv, argv + argc);  // a copy: both sides take the same ones off
  int count = argc;
  arguments.push_back(nullptr);
  Alarm alarm;
  RosBridgeOptions options;
  options.node_name = kNodeName;
  options.on_arrival = [&alarm] { alarm.ring(); };
  options.is_ending = stop_requested;
  options.on_shutdown = [](const std::string& why) {
    std::fprintf(stderr, "info: shutdown requested: %s\n", why.c_str());
    request_stop();
  };
  Ros2Bridge ros2(count, arguments.data(), options);
  RosBridge ros1(argc, argv, options);
  Passer passer(ros1, ros2, names);
  auto next_look = std::chrono::steady_clock::now();
  auto next_update = next_look;
  while (!stop_requested()) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_look) {
      passer.look();
      next_look = std::chrono::steady_clock::now() + kLookInterval;
    }
    if (now >= next_update) {
      passer.update();
      next_update = now + kUpdateInterval;
    }
    alarm.wait_for(kUpdateInterval);
    ros1.process_input();
    ros2.process_input();
  }
}

}  // namespace
}  // namespace bubblesim::app

int main(int argc, char** argv) {
  using namespace bubblesim::app;
  occupy_closed_descriptors();
  std::signal(SIGPIPE, SIG_IGN);
  int exit_code = kFine;
  try {
    run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    exit_code = kBadInput;
  }
  std::fflush(nullptr);
  std::quick_exit(exit_code);  // not std::exit(): see the node
}
