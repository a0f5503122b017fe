// SPDX-License-Identifier: BSD-3-Clause
// Holds a RosBridge and executes commands on stdin: `command arguments...`. Each is answered by one line, `= result` or
// `! error`. Received messages are printed as `message ID VALUE`, service requests as `request ID VALUE`, exceptions of
// process_input() as `process_input threw TEXT`. Ends on SIGTERM, `quit` or end of input. bridge_probe.py controls it.
#include <poll.h>
#include <ros/console.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "bubblesim/ros_bridge.hpp"

namespace {

using bubblesim::RosBridge;
using bubblesim::messages::EndpointId;
using bubblesim::messages::MessageCallback;
using bubblesim::messages::MessageType;
using bubblesim::messages::ServiceError;
using bubblesim::messages::ServiceType;
using bubblesim::messages::WireBuffer;
using bubblesim::messages::WireView;

std::atomic<bool> ending{false};
static_assert(std::atomic<bool>::is_always_lock_free);

MessageType make_type(const char* name, const char* md5, const char* definition, bool has_header = false) {
  MessageType type;
  type.name = name;
  type.type_hash = md5;
  type.definition = definition;
  type.has_header = has_header;
  return type;
}

const std::map<std::string, MessageType>& types() {
  static const std::map<std::string, MessageType> all{
      {"float", make_type("std_msgs/Float32", "73fcbf46b49191e672908e50842a83d4", "float32 data\n")},
      {"other_float",
       make_type("std_msgs/Float32", "00000000000000000000000000000000", "float32 data\nfloat32 more\n")},
      {"string", make_type("std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1", "string data\n")},
      {"empty", make_type("std_msgs/Empty", "d41d8cd98f00b204e9800998ecf8427e", "\n")},
      {"clock", make_type("rosgraph_msgs/Clock", "a9c97c1d230cfc112e270351a944ee47", "time clock\n")},
      {"log", make_type("rosgraph_msgs/Log", "acffd30cd6b6de30f120938c17c593fb", "")},
      {"temperature", make_type("sensor_msgs/Temperature", "ff71b307acdbe7c871a5a6d7ed359100",
                                "Header header\nfloat64 temperature\nfloat64 variance\n"
                                "================================================================================\n"
                                "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n",
                                true)},
  };
  return all;
}

WireBuffer encode(const MessageType& type, const std::string& text) {
  WireBuffer message;
  if (type.name == "std_msgs/Float32") {
    message.put(std::stof(text));
  } else if (type.name == "std_msgs/String") {
    message.put(static_cast<std::uint32_t>(text.size()));
    message.put_bytes(text.data(), text.size());
  } else if (type.name == "rosgraph_msgs/Clock") {
    message.put(static_cast<std::uint32_t>(std::stoul(text)));
    message.put(std::uint32_t{0});
  } else if (type.has_header && text != "truncated") {
    for (int i = 0; i < 4; ++i) message.put(std::uint32_t{0});  // seq, stamp, length of frame_id
    message.put(std::stod(text));
    message.put(0.0);
  }
  return message;
}

std::string decode_string(WireView& message) {
  const auto length = message.get<std::uint32_t>();
  return std::string(reinterpret_cast<const char*>(message.take(length)), length);
}

std::string decode(const MessageType& type, WireView message) {
  if (type.name == "std_msgs/Float32") return std::to_string(message.get<float>());
  if (type.name == "std_msgs/Empty") return std::to_string(message.left());
  if (type.name == "rosgraph_msgs/Clock") {
    const auto sec = message.get<std::uint32_t>();
    return std::to_string(sec) + " " + std::to_string(message.get<std::uint32_t>());
  }
  if (type.name == "rosgraph_msgs/Log") {
    message.take(12);  // seq, stamp
    decode_string(message);
    message.take(1);  // level
    decode_string(message);
  }
  return decode_string(message);
}

const std::map<std::string, ServiceType>& services() {
  static const MessageType request =
      make_type("std_srvs/SetBoolRequest", "8b94c1b53db61fb6aed406028ad6332a", "bool data\n");
  static const MessageType empty = make_type("std_srvs/TriggerRequest", "d41d8cd98f00b204e9800998ecf8427e", "\n");
  static const MessageType response =
      make_type("std_srvs/SetBoolResponse", "937c9679a518e3a18d831e57125ea522", "bool success\nstring message\n");
  static const std::map<std::string, ServiceType> all{
      {"setbool", {"std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16", &request, &response}},
      {"trigger", {"std_srvs/Trigger", "937c9679a518e3a18d831e57125ea522", &empty, &response}},
  };
  return all;
}

WireBuffer encode_response(bool success, const std::string& text) {
  WireBuffer response;
  response.put(static_cast<std::uint8_t>(success));
  response.put(static_cast<std::uint32_t>(text.size()));
  response.put_bytes(text.data(), text.size());
  return response;
}

std::string decode_response(const WireBuffer& response) {
  WireView view(response.data(), response.size());
  const bool success = view.get<std::uint8_t>() != 0;
  return (success ? "yes " : "no ") + decode_string(view);
}

/// How long this thread has been ready, but other processes had the processor [ms].
double waited_for_processor() {
  std::ifstream statistics("/proc/thread-self/schedstat");
  double running = 0;
  double waiting = 0;
  statistics >> running >> waiting;
  return waiting * 1e-6;
}

/// Longest duration [ms] of any of the functions, in as many rounds, without the time in which other processes had the
/// processor.
template <class... Functions>
double longest_call(int rounds, Functions&&... functions) {
  using Clock = std::chrono::steady_clock;
  double longest = 0;
  const auto measure = [&longest](auto& function) {
    const double waited = waited_for_processor();
    const auto begin = Clock::now();
    function();
    const double duration = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    longest = std::max(longest, duration - (waited_for_processor() - waited));
  };
  for (int i = 0; i < rounds; ++i) {
    (measure(functions), ...);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return longest;
}

class Probe {
 public:
  explicit Probe(RosBridge& bridge) : bridge_(bridge) {}

  std::string obey(const std::string& line) {
    std::istringstream words(line);
    std::string command;
    words >> command;
    const auto found = commands_.find(command);
    if (found == commands_.end()) return "! unknown command " + command;
    try {
      return "= " + found->second(words);
    } catch (const std::exception& error) {
      return std::string("! ") + error.what();
    }
  }

 private:
  using Words = std::istringstream;

  template <class T>
  static T read(Words& words) {
    T value{};
    words >> value;
    return value;
  }

  /// advertise TOPIC TYPE [latch|- [QUEUE_SIZE]]
  std::string advertise(Words& words) {
    const auto topic = read<std::string>(words);
    const auto& type = types().at(read<std::string>(words));
    const bool latch = read<std::string>(words) == "latch";
    const auto queue_size = read<std::uint32_t>(words);
    return std::to_string(bridge_.advertise(topic, type, {queue_size == 0 ? 100 : queue_size, latch}));
  }

  /// `how`: "" prints, "throw" prints and throws, "once" prints and shuts itself down, "size" prints the number of
  /// bytes.
  std::string subscribe(Words& words) {
    const auto topic = read<std::string>(words);
    const auto& type = types().at(read<std::string>(words));
    const auto how = read<std::string>(words);
    const auto id = std::make_shared<EndpointId>(0);
    const auto print = [this, id, how, &type](WireView message) {
      const std::string text = how == "size" ? std::to_string(message.left()) : decode(type, message);
      std::cout << "message " << *id << " " << text << std::endl;
      if (how == "throw") throw std::runtime_error("subscriber " + std::to_string(*id));
      if (how == "once") bridge_.shutdown_subscriber(*id);
    };
    *id = bridge_.subscribe(topic, type, {100}, print);
    return std::to_string(*id);
  }

  /// publish ID VALUE [SUBSCRIBER]: returns when the message waits for SUBSCRIBER, an own one.
  std::string publish(Words& words) {
    const auto id = read<EndpointId>(words);
    bridge_.publish(id, encode(bridge_.message_type(id), read<std::string>(words)));
    const auto subscriber = read<EndpointId>(words);
    if (subscriber == 0) return "";
    bridge_.set_priority(subscriber);
    while (!bridge_.urgent_waits()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return "";
  }

  /// `how`: "" echoes the request's bool, "throw" throws, "fail" reports a failure, "close" shuts itself down,
  /// "call ID" calls that client first, for at most 5 s, "sleep" takes half a second.
  std::string serve(Words& words) {
    const auto name = read<std::string>(words);
    const auto& type = services().at(read<std::string>(words));
    const auto how = read<std::string>(words);
    const auto inner = read<EndpointId>(words);
    const auto id = std::make_shared<EndpointId>(0);
    *id = bridge_.advertise_service(name, type, [this, id, how, inner](WireView request) {
      const bool value = request.left() > 0 && request.get<std::uint8_t>() != 0;
      std::cout << "request " << *id << " " << value << std::endl;
      if (how == "throw") throw std::runtime_error("server " + std::to_string(*id));
      if (how == "fail") throw ServiceError("out of paint");
      if (how == "sleep") std::this_thread::sleep_for(std::chrono::milliseconds(500));
      if (how == "close") bridge_.shutdown_service_server(*id);
      if (how == "call") return bridge_.call(inner, WireBuffer(), 5.0);
      return encode_response(value, "of " + std::to_string(*id));
    });
    return std::to_string(*id);
  }

  std::string client(Words& words) {
    const auto name = read<std::string>(words);
    return std::to_string(bridge_.service_client(name, services().at(read<std::string>(words))));
  }

  /// call ID TIMEOUT [BOOL]: a Trigger request has no bytes.
  std::string call(Words& words) {
    const auto id = read<EndpointId>(words);
    const auto timeout = read<double>(words);
    WireBuffer request;
    if (bridge_.service_type(id).name == "std_srvs/SetBool") request.put(static_cast<std::uint8_t>(read<int>(words)));
    return decode_response(bridge_.call(id, std::move(request), timeout));
  }

  std::string wait_for_service(Words& words) {
    const auto name = read<std::string>(words);
    return bridge_.wait_for_service(name, read<double>(words)) ? "yes" : "no";
  }

  /// longest TOPIC: longest duration [ms] of any call that a simulation makes in its steps.
  std::string longest(Words& words) {
    const auto topic = read<std::string>(words);
    const auto& type = types().at("float");
    EndpointId publisher = 0;
    EndpointId subscriber = 0;
    EndpointId server = 0;
    return std::to_string(longest_call(
        100, [&] { publisher = bridge_.advertise(topic, type, {1}); },
        [&] { subscriber = bridge_.subscribe(topic, type, {1}, [](WireView) {}); },
        [&] { server = bridge_.advertise_service(topic, services().at("setbool"), nullptr); },
        [&] { bridge_.publish(publisher, encode(type, "1")); }, [&] { bridge_.publish_clock(1.0); },
        [&] { bridge_.process_input(); }, [&] { bridge_.now(); }, [&] { bridge_.shutdown_publisher(publisher); },
        [&] { bridge_.shutdown_subscriber(subscriber); }, [&] { bridge_.shutdown_service_server(server); }));
  }

  /// flood ID BYTES COUNT: publishes COUNT strings of BYTES bytes, 50 per second.
  std::string flood(Words& words) {
    const auto id = read<EndpointId>(words);
    const std::string text(read<std::size_t>(words), 'x');
    const auto count = read<int>(words);
    auto next = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
      std::this_thread::sleep_until(next += std::chrono::milliseconds(20));
      bridge_.publish(id, encode(bridge_.message_type(id), text));
      bridge_.process_input();
    }
    return "";
  }

  /// log TEXT: sends TEXT to /rosout.
  std::string log(Words& words) {
    ROS_WARN_STREAM(read<std::string>(words));
    return "";
  }

  std::string now(Words&) {
    const auto time = bridge_.now();
    return std::to_string(time.sec) + " " + std::to_string(time.nanosec);
  }

  std::string clock(Words& words) {
    bridge_.publish_clock(read<double>(words));
    return "";
  }

  RosBridge& bridge_;
  const std::map<std::string, std::function<std::string(Words&)>> commands_{
      {"advertise", [this](Words& words) { return advertise(words); }},
      {"subscribe", [this](Words& words) { return subscribe(words); }},
      {"publish", [this](Words& words) { return publish(words); }},
      {"serve", [this](Words& words) { return serve(words); }},
      {"client", [this](Words& words) { return client(words); }},
      {"call", [this](Words& words) { return call(words); }},
      {"wait_for_service", [this](Words& words) { return wait_for_service(words); }},
      {"log", [this](Words& words) { return log(words); }},
      {"flood", [this](Words& words) { return flood(words); }},
      {"longest", [this](Words& words) { return longest(words); }},
      {"shutdown_server",
       [this](Words& words) { return bridge_.shutdown_service_server(read<EndpointId>(words)), std::string(); }},
      {"shutdown_client",
       [this](Words& words) { return bridge_.shutdown_service_client(read<EndpointId>(words)), std::string(); }},
      {"now", [this](Words& words) { return now(words); }},
      {"clock", [this](Words& words) { return clock(words); }},
      {"wants", [this](Words& words) { return bridge_.wants_messages(read<EndpointId>(words)) ? "yes" : "no"; }},
      {"connected", [this](Words&) { return bridge_.connected() ? "yes" : "no"; }},
      {"name", [this](Words&) { return bridge_.node_name(); }},
      {"shutdown_publisher",
       [this](Words& words) { return bridge_.shutdown_publisher(read<EndpointId>(words)), std::string(); }},
      {"shutdown_subscriber",
       [this](Words& words) { return bridge_.shutdown_subscriber(read<EndpointId>(words)), std::string(); }},
  };
};

bool has_input() {
  constexpr int kPassMilliseconds = 5;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return std::cin.rdbuf()->in_avail() > 0 || poll(&input, 1, kPassMilliseconds) > 0;
}

void run(RosBridge& bridge) {
  Probe probe(bridge);
  std::cout << "ready" << std::endl;
  std::string line;
  while (!ending) {
    if (has_input()) {
      if (!std::getline(std::cin, line) || line == "quit") return;
      std::cout << probe.obey(line) << std::endl;
    }
    try {
      bridge.process_input();
    } catch (const std::exception& error) {
      std::cout << "process_input threw " << error.what() << std::endl;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);  // so that in_avail() counts buffered lines
  struct sigaction action {};
  action.sa_handler = [](int) { ending = true; };
  sigaction(SIGTERM, &action, nullptr);
  try {
    bubblesim::RosBridgeOptions options;
    options.on_pause = [](bool paused) { std::cout << (paused ? "paused" : "unpaused") << std::endl; };
    options.is_ending = [] { return ending.load(); };
    RosBridge bridge(argc, argv, options);
    if (argc > 1) throw std::invalid_argument(std::string("unexpected argument ") + argv[1]);
    run(bridge);
  } catch (const std::exception& error) {
    std::cout << "! " << error.what() << std::endl;
    return 2;
  }
  std::cout << "ended" << std::endl;
  return 0;
}
