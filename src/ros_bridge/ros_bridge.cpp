// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/ros_bridge.hpp"

#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/message_traits.h>
#include <ros/names.h>
#include <ros/service_manager.h>
#include <ros/this_node.h>
#include <ros/time.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Empty.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "endpoints.hpp"
#include "master_thread.hpp"
#include "node_setup.hpp"

namespace bubblesim {
namespace {

using messages::BridgeTime;
using messages::EndpointId;
using messages::MessageType;
using messages::WireBuffer;

constexpr std::uint32_t kClockQueueSize = 10;
constexpr std::chrono::milliseconds kAnswerTimeout{800};
constexpr std::chrono::milliseconds kStartTimeout{5000};  // some ten calls to a master on a busy machine
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

const MessageType& clock_type() {
  static const MessageType type = [] {
    namespace traits = ros::message_traits;
    using rosgraph_msgs::Clock;
    MessageType clock;
    clock.name = traits::datatype<Clock>();
    clock.md5 = traits::md5sum<Clock>();
    clock.definition = traits::definition<Clock>();
    return clock;
  }();
  return type;
}

BridgeTime to_bridge_time(std::int64_t nanoseconds) {
  return {static_cast<std::uint32_t>(nanoseconds / kNanosecondsPerSecond),
          static_cast<std::uint32_t>(nanoseconds % kNanosecondsPerSecond)};
}

/// The full name of a script's topic, remappings applied.
std::string resolve_topic(const std::string& topic) {
  std::string error;
  if (topic.empty()) {
    error = "it is empty";
  } else if (ros::names::validate(topic, error)) {
    const bool below_node = topic[0] != '/' && topic[0] != '~';
    std::string resolved = ros::names::resolve(below_node ? "~" + topic : topic);
    if (resolved.size() > 1) return resolved;
    error = "it names nothing";
  }
  throw std::invalid_argument("unusable topic name '" + topic + "': " + error);
}

/// A node has one type for what it publishes on a topic, and one for what it subscribes to there.
void check_same_type(const std::string& topic, const MessageType& type, const char* done, const MessageType& other) {
  if (type.md5 == other.md5) return;
  throw std::invalid_argument("topic '" + topic + "' is already " + done + " here as " + other.name +
                              ", so it cannot be " + type.name);
}

template <class Endpoint>
using Table = std::unordered_map<EndpointId, std::shared_ptr<Endpoint>>;

template <class Table>
auto find_endpoint(Table& table, EndpointId id, const char* kind) {
  const auto found = table.find(id);
  if (found != table.end()) return found;
  throw std::invalid_argument("invalid object handle " + std::to_string(id) + ": no such " + kind +
                              ", or it was shut down");
}

void say(const std::string& text) { std::fputs(("plugin 'ROSInterface': " + text + "\n").c_str(), stderr); }

}  // namespace

struct RosBridge::Impl {
  explicit Impl(RosBridgeOptions bridge_options) : options(std::move(bridge_options)) {}

  void offer_pause_service(const std::string& name, bool paused);
  void on_connected();

  const RosBridgeOptions options;
  ros::CallbackQueue queue;
  CallbackGuard guard;
  bool draining = false;

  Table<PublisherEndpoint> publishers;
  Table<SubscriberEndpoint> subscribers;
  EndpointId next_id = 1;

  const std::shared_ptr<PublisherEndpoint> clock =
      std::make_shared<PublisherEndpoint>(ros::names::resolve("/clock"), clock_type(), kClockQueueSize, false);
  int script_clocks = 0;  // publishers of scripts on the same topic
  bool said_script_clock = false;
  std::int64_t sim_time = 0;  // [ns]

  MasterThread master{[] {
                        say("load failed (failed initialization): no ROS master at " + ros::master::getURI() +
                            "; start one with 'roscore' -- the simulation runs on without ROS and connects as soon "
                            "as a master appears");
                      },
                      [this] { on_connected(); }};
};

void RosBridge::Impl::on_connected() {
  clock->register_at_master();
  if (options.on_pause) {
    offer_pause_service("~pause", true);
    offer_pause_service("~unpause", false);
  }
  say("load succeeded: node " + ros::this_node::getName() + " at ROS master " + ros::master::getURI());
}

void RosBridge::Impl::offer_pause_service(const std::string& name, bool paused) {
  ros::AdvertiseServiceOptions service;
  service.init<std_srvs::Empty>(ros::names::resolve(name),
                                [this, paused](std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
                                  guard.run([&] { options.on_pause(paused); });
                                  return true;
                                });
  service.callback_queue = &queue;
  ros::ServiceManager::instance()->advertiseService(service);
}

RosBridge::RosBridge(int& argc, char** argv, RosBridgeOptions options) {
  init_node(argc, argv, options.node_name);
  impl_ = std::make_unique<Impl>(std::move(options));
  impl_->master.wait_for_first_answer(kAnswerTimeout, kStartTimeout);
}

RosBridge::~RosBridge() {
  // Here and not where roscpp lets go of them: scripts' callbacks must die on the simulation's thread.
  for (const auto& [id, subscriber] : impl_->subscribers) subscriber->silence();
  if (impl_->master.stop()) return;
  say("the ROS master at " + master_uri() + " does not answer: leaving without taking this node off it");
  static_cast<void>(impl_.release());  // the thread that is left behind still uses it
}

EndpointId RosBridge::advertise(const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                                bool latch) {
  const std::string resolved = resolve_topic(topic);
  for (const auto& [id, other] : impl_->publishers) {
    if (other->topic() == resolved) check_same_type(resolved, type, "advertised", other->type());
  }
  if (resolved == impl_->clock->topic()) {
    check_same_type(resolved, type, "advertised", clock_type());
    ++impl_->script_clocks;
    if (!std::exchange(impl_->said_script_clock, true)) {
      say("a script advertises " + resolved + ": the simulator leaves publishing it to the script");
    }
  }
  const auto publisher = std::make_shared<PublisherEndpoint>(resolved, type, queue_size, latch);
  const EndpointId id = impl_->next_id++;
  impl_->publishers.emplace(id, publisher);
  impl_->master.post([publisher] { publisher->register_at_master(); });
  return id;
}

EndpointId RosBridge::subscribe(const std::string& topic, const MessageType& type, std::uint32_t queue_size,
                                messages::MessageCallback callback) {
  const std::string resolved = resolve_topic(topic);
  for (const auto& [id, other] : impl_->subscribers) {
    if (other->topic() == resolved) check_same_type(resolved, type, "subscribed", other->type());
  }
  const auto subscriber =
      std::make_shared<SubscriberEndpoint>(resolved, type, queue_size, std::move(callback), impl_->queue, impl_->guard);
  const EndpointId id = impl_->next_id++;
  impl_->subscribers.emplace(id, subscriber);
  impl_->master.post([subscriber] { subscriber->register_at_master(); });
  return id;
}

bool RosBridge::wants_messages(EndpointId publisher) const {
  return find_endpoint(impl_->publishers, publisher, "publisher")->second->wants_messages();
}

const MessageType& RosBridge::message_type(EndpointId endpoint) const {
  const auto publisher = impl_->publishers.find(endpoint);
  if (publisher != impl_->publishers.end()) return publisher->second->type();
  return find_endpoint(impl_->subscribers, endpoint, "publisher or subscriber")->second->type();
}

void RosBridge::publish(EndpointId publisher, WireBuffer message) {
  find_endpoint(impl_->publishers, publisher, "publisher")->second->publish(std::move(message));
}

void RosBridge::shutdown_publisher(EndpointId publisher) {
  const auto found = find_endpoint(impl_->publishers, publisher, "publisher");
  if (found->second->topic() == impl_->clock->topic()) --impl_->script_clocks;
  impl_->master.post([gone = std::move(found->second)] { gone->unregister_from_master(); });
  impl_->publishers.erase(found);
}

void RosBridge::shutdown_subscriber(EndpointId subscriber) {
  const auto found = find_endpoint(impl_->subscribers, subscriber, "subscriber");
  found->second->silence();
  impl_->master.post([gone = std::move(found->second)] { gone->unregister_from_master(); });
  impl_->subscribers.erase(found);
}

void RosBridge::drain() {
  if (impl_->draining) return;  // called by a callback: the outer call goes on with the rest
  impl_->draining = true;
  impl_->queue.callAvailable(ros::WallDuration(0));
  impl_->draining = false;
  impl_->guard.rethrow();
}

BridgeTime RosBridge::now() const {
  // isSimTime() before roscpp is started says nothing; then the wall clock is what any other node would use too.
  if (connected() && ros::Time::isSimTime()) return to_bridge_time(impl_->sim_time);
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  return to_bridge_time(std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count());
}

void RosBridge::publish_clock(double sim_time) {
  impl_->sim_time = std::max<std::int64_t>(0, std::llround(sim_time * kNanosecondsPerSecond));
  if (impl_->script_clocks > 0 || !impl_->clock->wants_messages()) return;
  const BridgeTime time = to_bridge_time(impl_->sim_time);
  WireBuffer message;
  message.put(time.sec);
  message.put(time.nanosec);
  impl_->clock->publish(std::move(message));
}

bool RosBridge::connected() const {
  return impl_->master.state() == MasterThread::State::kConnected && !ros::isShuttingDown();
}

std::string RosBridge::master_uri() const { return ros::master::getURI(); }

std::string RosBridge::node_name() const { return ros::this_node::getName(); }

}  // namespace bubblesim
