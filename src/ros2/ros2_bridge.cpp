// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/ros2_bridge.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bubblesim/messages/registry.hpp"
#include "dds/environment.hpp"
#include "dds/participant.hpp"
#include "graph/diagnostics.hpp"
#include "graph/graph_reader.hpp"
#include "graph/names.hpp"
#include "graph/node_announcement.hpp"
#include "graph/rosout.hpp"
#include "parameters/node_parameters.hpp"
#include "parameters/parameter_services.hpp"
#include "services/services.hpp"
#include "step_service.hpp"
#include "topics/topics.hpp"

namespace bubblesim {
namespace {

using messages::BridgeTime;
using messages::EndpointId;
using messages::MessageType;
using messages::ServiceType;
using messages::WireBuffer;

constexpr const char* kUsualName = "sim_ros2_interface";  // that of CoppeliaSim's plugin
constexpr const char* kClock = "/clock";
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

BridgeTime to_bridge_time(std::int64_t nanoseconds) {
  return {static_cast<std::uint32_t>(nanoseconds / kNanosecondsPerSecond),
          static_cast<std::uint32_t>(nanoseconds % kNanosecondsPerSecond)};
}

const MessageType& own_message(const char* name) {
  return ros2::listed(messages::find_message(name, messages::RosVersion::kRos2), name);
}

const ServiceType& own_service(const char* name) {
  return ros2::listed(messages::find_service(name, messages::RosVersion::kRos2), name);
}

messages::Qos parameter_qos() {
  messages::Qos qos;
  qos.depth = 1000;  // as rcl's
  return qos;
}

}  // namespace

struct Ros2Bridge::Impl {
  Impl(int& argc, char** argv, NodeBridgeOptions bridge_options);

  void offer_pause_service(const char* name, bool paused);
  void offer_step_services();
  void offer_parameters();
  BridgeTime now() const;

  const NodeBridgeOptions options;
  const ros2::Environment environment = ros2::read_environment();
  const ros2::Names names;
  Arrivals arrivals{options.on_arrival};
  CallbackGuard guard;
  bool processing_input = false;

  EndpointId next_id = 1;
  EndpointId first_of_scenes = 1;  // those before are the bridge's own
  std::int64_t sim_time = 0;       // ns

  ros2::Participant participant{environment};
  ros2::NodeAnnouncement announcement{participant, names.node_namespace(), names.node(), environment.gid_size};
  ros2::Rosout rosout{participant, names.node()};
  ros2::NodeParameters parameters{names.full_node(), names.parameters()};
  ros2::Traffic traffic;
  ros2::Inbox inbox{arrivals, traffic};
  ros2::Outbox outbox;
  ros2::Topics topics{participant, inbox, outbox, traffic};
  std::unique_ptr<StepService> step_service;  // before the services, which use its queue
  ros2::Services services{participant, guard, arrivals, rosout, options.is_ending};
  EndpointId clock = 0;
  EndpointId parameter_events = 0;

  mutable std::mutex urgent_mutex;  // guards urgent
  std::vector<std::function<bool()>> urgent;

  std::unique_ptr<ros2::Diagnostics> diagnostics;  // null without take_report
};

Ros2Bridge::Impl::Impl(int& argc, char** argv, NodeBridgeOptions bridge_options)
    : options(std::move(bridge_options)),
      names(argc, argv, options.node_name.empty() ? kUsualName : options.node_name) {
  clock = next_id++;
  topics.advertise(clock, kClock, own_message("rosgraph_msgs/Clock"), messages::Qos());
  topics.yield_topic(clock);
  if (options.on_pause) {
    offer_pause_service("~/pause", true);
    offer_pause_service("~/unpause", false);
  }
  if (options.on_step) offer_step_services();
  offer_parameters();
  const MessageType* const report =
      messages::find_message("diagnostic_msgs/DiagnosticArray", messages::RosVersion::kRos2);
  if (options.take_report && report != nullptr) {  // it may have been taken off meta/messages.txt
    diagnostics = std::make_unique<ros2::Diagnostics>(participant, *report, names.node(), options.take_report,
                                                      [this] { return traffic.take_report(); });
  }
  first_of_scenes = next_id;
  announcement.update();
  rosout.log(ros2::Rosout::Level::kInfo,
             "load succeeded: node " + names.full_node() + " in domain " + std::to_string(environment.domain));
}

void Ros2Bridge::Impl::offer_pause_service(const char* name, bool paused) {
  const ServiceType& type = own_service("std_srvs/Empty");
  const auto answer = [this, paused, &type](messages::WireView) {
    options.on_pause(paused);
    WireBuffer response;
    response.begin(messages::Layout::kCdr);
    put_default(*type.response, response);
    return response;
  };
  services.add_server(next_id++, names.resolve(name, "service"), type, answer);
}

void Ros2Bridge::Impl::offer_parameters() {
  parameter_events = next_id++;
  topics.advertise(parameter_events, "/parameter_events", own_message("rcl_interfaces/ParameterEvent"),
                   parameter_qos());
  parameters.on_change = [this](ros2::NodeParameters::Change change, const std::string& name,
                                const ros2::Value& value) {
    if (!topics.publisher(parameter_events).wants_messages()) return;
    topics.publish(parameter_events, ros2::parameter_event(now(), names.full_node(), change, name, value));
  };
  ros2::add_parameter_services(
      parameters, [this](const std::string& name, const std::string& type, messages::ServiceCallback answer) {
        services.add_server(next_id++, names.full_node() + "/" + name, own_service(type.c_str()), std::move(answer));
      });
}

BridgeTime Ros2Bridge::Impl::now() const {
  if (parameters.use_sim_time()) return to_bridge_time(sim_time);
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  return to_bridge_time(std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count());
}

void Ros2Bridge::Impl::offer_step_services() {
  step_service = std::make_unique<StepService>(options.on_step, messages::Layout::kCdr);
  for (const SteppingService& service : kSteppingServices) {
    const ServiceType* type = messages::find_service(service.type, messages::RosVersion::kRos2);
    if (type == nullptr) continue;  // it was taken off meta/services.txt
    services.add_server(
        next_id++, names.resolve(service.name, "service"), *type,
        [&service, steps = step_service.get()](messages::WireView request) { return steps->answer(service, request); },
        step_service->queue().get());
  }
}

Ros2Bridge::Ros2Bridge(int& argc, char** argv, NodeBridgeOptions options)
    : impl_(std::make_unique<Impl>(argc, argv, std::move(options))) {}

Ros2Bridge::~Ros2Bridge() {
  impl_->arrivals.silence();
  if (impl_->step_service) impl_->step_service->stop();
}

EndpointId Ros2Bridge::advertise(const std::string& topic, const MessageType& type, const messages::Qos& qos) {
  impl_->topics.advertise(impl_->next_id, impl_->names.resolve(topic, "topic"), type, qos);
  return impl_->next_id++;
}

EndpointId Ros2Bridge::subscribe(const std::string& topic, const MessageType& type, const messages::Qos& qos,
                                 messages::MessageCallback callback) {
  impl_->topics.subscribe(impl_->next_id, impl_->names.resolve(topic, "topic"), type, qos, std::move(callback));
  return impl_->next_id++;
}

void Ros2Bridge::set_priority(EndpointId endpoint) {
  std::function<bool()> waits;
  if (impl_->topics.has_subscriber(endpoint)) {
    waits = [inbox = &impl_->inbox, mailbox = impl_->topics.subscriber(endpoint).mailbox()] {
      return inbox->has(*mailbox);
    };
  } else {
    waits = [waiting = impl_->services.waiting(endpoint)] { return *waiting > 0; };
  }
  const std::lock_guard lock(impl_->urgent_mutex);
  impl_->urgent.push_back(std::move(waits));
}

bool Ros2Bridge::urgent_waits() const {
  const std::lock_guard lock(impl_->urgent_mutex);
  return std::any_of(impl_->urgent.begin(), impl_->urgent.end(), [](const auto& waits) { return waits(); });
}

void Ros2Bridge::yield_topic(EndpointId endpoint) { impl_->topics.yield_topic(endpoint); }

bool Ros2Bridge::wants_messages(EndpointId publisher) const {
  return impl_->topics.publisher(publisher).wants_messages();
}

bool Ros2Bridge::has_publisher(EndpointId subscriber) const {
  return impl_->topics.subscriber(subscriber).has_publisher();
}

const MessageType& Ros2Bridge::message_type(EndpointId endpoint) const { return impl_->topics.type(endpoint); }

void Ros2Bridge::publish(EndpointId publisher, WireBuffer message) {
  impl_->topics.publish(publisher, std::move(message));
}

void Ros2Bridge::shutdown_publisher(EndpointId publisher) { impl_->topics.shutdown_publisher(publisher); }

void Ros2Bridge::shutdown_subscriber(EndpointId subscriber) { impl_->topics.shutdown_subscriber(subscriber); }

EndpointId Ros2Bridge::advertise_service(const std::string& name, const ServiceType& type,
                                         messages::ServiceCallback callback) {
  impl_->services.add_server(impl_->next_id, impl_->names.resolve(name, "service"), type, std::move(callback));
  return impl_->next_id++;
}

EndpointId Ros2Bridge::service_client(const std::string& name, const ServiceType& type) {
  impl_->services.add_client(impl_->next_id, impl_->names.resolve(name, "service"), type);
  return impl_->next_id++;
}

const ServiceType& Ros2Bridge::service_type(EndpointId server_or_client) const {
  return impl_->services.type(server_or_client);
}

WireBuffer Ros2Bridge::call(EndpointId client, WireBuffer request, double timeout) {
  impl_->announcement.update();
  return impl_->services.call(client, std::move(request), timeout);
}

bool Ros2Bridge::wait_for_service(const std::string& name, double timeout) {
  return impl_->services.wait_for(impl_->names.resolve(name, "service"), timeout);
}

void Ros2Bridge::shutdown_service_server(EndpointId server) { impl_->services.remove_server(server); }

void Ros2Bridge::shutdown_service_client(EndpointId client) { impl_->services.remove_client(client); }

EndpointId Ros2Bridge::advertise_service_later(const std::string& name, const ServiceType& type,
                                               messages::RequestCallback on_request) {
  impl_->services.add_server_later(impl_->next_id, impl_->names.resolve(name, "service"), type, std::move(on_request));
  return impl_->next_id++;
}

void Ros2Bridge::reply(EndpointId server, messages::RequestNumber request, WireBuffer response) {
  impl_->outbox.settle();  // clients of an action drop the feedback that comes after the result
  impl_->services.reply(server, request, std::move(response));
}

bool Ros2Bridge::service_is_ready(EndpointId client) const { return impl_->services.is_ready(client); }

void Ros2Bridge::call_later(EndpointId client, WireBuffer request, messages::MessageCallback on_response) {
  impl_->services.call_later(client, std::move(request), std::move(on_response));
}

std::optional<messages::ParameterValue> Ros2Bridge::get_parameter(const std::string& name) {
  const std::optional<ros2::Value> value = impl_->parameters.get(name);
  if (!value) return std::nullopt;
  return ros2::for_script(*value);
}

void Ros2Bridge::set_parameter(const std::string& name, const messages::ParameterValue& value) {
  impl_->parameters.set(name, ros2::from_script(value));
}

void Ros2Bridge::delete_parameter(const std::string& name) { impl_->parameters.set(name, std::monostate()); }

std::optional<std::string> Ros2Bridge::search_parameter(const std::string& name) {
  return impl_->parameters.search(name);
}

void Ros2Bridge::process_input() {
  if (impl_->processing_input) return;  // called by a message's callback: the outer call processes the rest
  impl_->announcement.update();
  impl_->processing_input = true;
  impl_->inbox.deliver(impl_->guard);
  impl_->processing_input = false;
  impl_->services.serve();
  impl_->guard.rethrow();
}

BridgeTime Ros2Bridge::now() const { return impl_->now(); }

bool Ros2Bridge::clock_reaches_others() const {
  return !impl_->parameters.use_sim_time() || impl_->topics.publisher(impl_->clock).wants_messages();
}

void Ros2Bridge::publish_clock(double sim_time) {
  impl_->sim_time = std::max<std::int64_t>(0, std::llround(sim_time * kNanosecondsPerSecond));
  if (!wants_messages(impl_->clock)) return;
  const BridgeTime time = to_bridge_time(impl_->sim_time);
  WireBuffer message;
  message.begin(messages::Layout::kCdr);
  message.put(time.sec);
  message.put(time.nanosec);
  publish(impl_->clock, std::move(message));
}

void Ros2Bridge::shutdown_endpoints() {
  {
    const std::lock_guard lock(impl_->urgent_mutex);
    impl_->urgent.clear();
  }
  impl_->topics.shutdown_from(impl_->first_of_scenes);
  impl_->services.remove_from(impl_->first_of_scenes);
}

void Ros2Bridge::publish_diagnostics() {
  if (impl_->diagnostics) impl_->diagnostics->publish();
}

NodeGraph Ros2Bridge::graph() { return ros2::read_graph(impl_->participant); }

std::string Ros2Bridge::node_name() const { return impl_->names.full_node(); }

}  // namespace bubblesim
