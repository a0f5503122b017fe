// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/ros_bridge.hpp"

#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "arrivals.hpp"
#include "bubblesim/messages/registry.hpp"
#include "callbacks/counting_queue.hpp"
#include "callbacks/notifying_queue.hpp"
#include "callbacks/request_callbacks.hpp"
#include "console/log_line.hpp"
#include "endpoint_table.hpp"
#include "master/master_thread.hpp"
#include "master/master_watch.hpp"
#include "master/names.hpp"
#include "master/node_name.hpp"
#include "master/other_clock.hpp"
#include "master/parameters.hpp"
#include "master/remote_shutdown.hpp"
#include "master/use_sim_time.hpp"
#include "node_setup.hpp"
#include "peers/own_types.hpp"
#include "peers/publisher_check.hpp"
#include "peers/refused_peers.hpp"
#include "ros_clock.hpp"
#include "services/services.hpp"
#include "status/diagnostics.hpp"
#include "status/graph_reader.hpp"
#include "step_service.hpp"
#include "topics/endpoints.hpp"
#include "topics/topics.hpp"

namespace bubblesim {
namespace {

using messages::BridgeTime;
using messages::EndpointId;
using messages::MessageType;
using messages::ServiceType;
using messages::WireBuffer;

constexpr const char* kUsualName = "sim_ros_interface";  // that of CoppeliaSim's plugin
constexpr std::chrono::milliseconds kAnswerTimeout{800};
constexpr std::chrono::milliseconds kStartTimeout{5000};  // some ten calls to a master on a busy machine
constexpr std::chrono::milliseconds kLastCalls{100};      // for calls that timed out, or that wait for a lost master
constexpr std::chrono::milliseconds kLastWords{200};
constexpr std::chrono::milliseconds kGraphTimeout{2000};

}  // namespace

struct RosBridge::Impl {
  explicit Impl(RosBridgeOptions bridge_options);

  void offer_pause_service(const std::string& name, bool paused);
  void offer_step_services();
  std::string refusal();
  void on_connected();

  const RosBridgeOptions options;
  const std::shared_ptr<Arrivals> arrivals = std::make_shared<Arrivals>(options.on_arrival);
  NotifyingQueue queue{arrivals};
  CallbackGuard guard;
  bool processing_input = false;

  EndpointId next_id = 1;
  EndpointId first_of_scenes = 1;  // those before are the bridge's own

  RosClock clock{queue};
  UseSimTime use_sim_time;

  MasterWatch watch{[this] {
    clock.read_use_sim_time();
    log_line("registered again at ROS master " + ros::master::getURI());
  }};
  PublisherCheck publisher_check;
  RefusedPeers refused_peers;
  Diagnostics diagnostics{options.take_report};
  MasterThread master;
  Topics topics{master, publisher_check, queue, guard};
  std::unique_ptr<StepService> step_service;  // before the services, which use its queue
  std::unique_ptr<RequestCallbacks> step_requests;
  Services services{master, watch, guard, arrivals, options.is_ending};
  std::vector<std::shared_ptr<ServiceServer>> own_servers;
  Parameters parameters{master};
  const std::shared_ptr<GraphReader> graph_reader = std::make_shared<GraphReader>();  // of the master thread

  mutable std::mutex urgent_mutex;  // guards urgent
  std::vector<WaitingCount> urgent;
};

RosBridge::Impl::Impl(RosBridgeOptions bridge_options)
    : options(std::move(bridge_options)),
      master({[this] { return watch.check(); }, [this] { return refusal(); },
              [this] {
                log_line("load failed (failed initialization): no ROS master at " + ros::master::getURI() +
                         "; start one with 'roscore'" + options.without_master +
                         " -- the simulation continues without ROS and connects as soon "
                         "as a master appears");
              },
              [](bool had_master) {
                log_line(had_master
                             ? "the ROS master at " + ros::master::getURI() +
                                   " does not answer -- the simulation continues; connected nodes stay connected, new "
                                   "ones find this node when the master is back"
                             : "still no ROS master at " + ros::master::getURI() + "; start one with 'roscore'");
              },
              [this] { on_connected(); },
              [this] {
                publisher_check.look();
                topics.look_for_publishers();
                if (options.take_report) diagnostics.publish_when_due();
              },
              [this] {
                wait_until_all_are_sent();
                use_sim_time.restore();
              }}) {
  if (options.on_shutdown) take_over_shutdown(options.on_shutdown);
  if (options.on_pause) {
    offer_pause_service("~pause", true);
    offer_pause_service("~unpause", false);
  }
  if (options.on_step) offer_step_services();
  first_of_scenes = next_id;
  master.start();
}

std::string RosBridge::Impl::refusal() {
  use_sim_time.take();  // also if the node of the launch file is refused
  if (options.replace) end_other_node_of_this_name();
  if (const std::string why = options.replace ? "" : other_node_of_this_name(); !why.empty()) return why;
  return options.on_step ? other_time_on(clock.topic()) : "";  // a node that cannot step is no simulator
}

void RosBridge::Impl::on_connected() {
  clock.register_at_master();
  for (const auto& server : own_servers) services.register_server(*server);
  log_line("load succeeded: node " + ros::this_node::getName() + " at ROS master " + ros::master::getURI());
}

void RosBridge::Impl::offer_pause_service(const std::string& name, bool paused) {
  own_servers.push_back(services.add_server(next_id++, name, empty_service(), [this, paused](messages::WireView) {
    options.on_pause(paused);
    return WireBuffer();
  }));
}

void RosBridge::Impl::offer_step_services() {
  step_service = std::make_unique<StepService>(options.on_step, messages::Layout::kPacked);
  step_requests = std::make_unique<RequestCallbacks>(step_service->queue());
  for (const SteppingService& service : kSteppingServices) {
    const ServiceType* type = messages::find_service(service.type);
    if (type == nullptr) continue;  // it was taken off meta/services.txt
    own_servers.push_back(services.add_server_of(*step_requests, next_id++, service.name, *type,
                                                 [&service, steps = step_service.get()](messages::WireView request) {
                                                   return steps->answer(service, request);
                                                 }));
  }
}

RosBridge::RosBridge(int& argc, char** argv, RosBridgeOptions options) {
  init_node(argc, argv, options.node_name.empty() ? kUsualName : options.node_name);
  impl_ = std::make_unique<Impl>(std::move(options));
  const auto is_ending = [this] { return impl_->options.is_ending && impl_->options.is_ending(); };
  impl_->master.wait_for_first_answer(kAnswerTimeout, kStartTimeout, is_ending);
  if (const std::string refusal = impl_->master.refusal(); !refusal.empty()) throw std::invalid_argument(refusal);
}

RosBridge::~RosBridge() {
  impl_->arrivals->silence();
  if (impl_->step_service) impl_->step_service->stop();
  // Here, not where roscpp releases them: callbacks of scripts must be destroyed on the simulation thread.
  impl_->topics.silence();
  impl_->services.silence();
  if (leave() && impl_->services.finish_calls(kLastCalls)) {
    impl_->master.drop_jobs();  // they hold servers, which use the queue of the services
    return;
  }
  log_line("the ROS master at " + master_uri() + " does not answer: ending without unregistering this node");
  [[maybe_unused]] const Impl* const left = impl_.release();  // the remaining thread still uses it
}

bool RosBridge::leave() { return impl_->master.stop(); }

EndpointId RosBridge::advertise(const std::string& topic, const MessageType& type, const messages::Qos& qos) {
  const std::string resolved = resolve_name(topic, "topic");
  impl_->clock.check_type(resolved, type);
  impl_->topics.advertise(impl_->next_id, resolved, type, qos.depth, qos.transient_local);
  if (resolved == impl_->clock.topic()) impl_->clock.say_left_to_script();
  return impl_->next_id++;
}

EndpointId RosBridge::subscribe(const std::string& topic, const MessageType& type, const messages::Qos& qos,
                                messages::MessageCallback callback) {
  const std::string resolved = resolve_name(topic, "topic");
  impl_->clock.check_type(resolved, type);
  impl_->topics.subscribe(impl_->next_id, resolved, type, qos, std::move(callback));
  return impl_->next_id++;
}

void RosBridge::set_priority(EndpointId endpoint) {
  WaitingCount waiting =
      impl_->topics.has_subscriber(endpoint) ? impl_->topics.waiting(endpoint) : impl_->services.waiting(endpoint);
  const std::lock_guard lock(impl_->urgent_mutex);
  impl_->urgent.push_back(std::move(waiting));
}

bool RosBridge::urgent_waits() const {
  const std::lock_guard lock(impl_->urgent_mutex);
  return std::any_of(impl_->urgent.begin(), impl_->urgent.end(), [](const auto& waiting) { return *waiting > 0; });
}

void RosBridge::yield_topic(EndpointId endpoint) { impl_->topics.yield_topic(endpoint); }

bool RosBridge::wants_messages(EndpointId publisher) const { return impl_->topics.wants_messages(publisher); }

bool RosBridge::has_publisher(EndpointId subscriber) const { return impl_->topics.has_publisher(subscriber); }

const MessageType& RosBridge::message_type(EndpointId endpoint) const { return impl_->topics.type(endpoint); }

void RosBridge::publish(EndpointId publisher, WireBuffer message) {
  impl_->topics.publish(publisher, std::move(message));
}

void RosBridge::shutdown_publisher(EndpointId publisher) { impl_->topics.shutdown_publisher(publisher); }

void RosBridge::shutdown_subscriber(EndpointId subscriber) { impl_->topics.shutdown_subscriber(subscriber); }

EndpointId RosBridge::advertise_service(const std::string& name, const ServiceType& type,
                                        messages::ServiceCallback callback) {
  const auto server = impl_->services.add_server(impl_->next_id, name, type, std::move(callback));
  impl_->master.post([impl = impl_.get(), server] { impl->services.register_server(*server); });
  return impl_->next_id++;
}

EndpointId RosBridge::service_client(const std::string& name, const ServiceType& type) {
  impl_->services.add_client(impl_->next_id, name, type);
  return impl_->next_id++;
}

const ServiceType& RosBridge::service_type(EndpointId server_or_client) const {
  return impl_->services.type(server_or_client);
}

WireBuffer RosBridge::call(EndpointId client, WireBuffer request, double timeout) {
  return impl_->services.call(client, std::move(request), timeout);
}

bool RosBridge::wait_for_service(const std::string& name, double timeout) {
  return impl_->services.wait_for(name, timeout);
}

void RosBridge::shutdown_service_server(EndpointId server) { impl_->services.remove_server(server); }

void RosBridge::shutdown_service_client(EndpointId client) { impl_->services.remove_client(client); }

std::optional<messages::ParameterValue> RosBridge::get_parameter(const std::string& name) {
  return impl_->parameters.get(name);
}

void RosBridge::set_parameter(const std::string& name, const messages::ParameterValue& value) {
  impl_->parameters.set(name, value);
}

void RosBridge::delete_parameter(const std::string& name) { impl_->parameters.remove(name); }

std::optional<std::string> RosBridge::search_parameter(const std::string& name) {
  return impl_->parameters.search(name);
}

void RosBridge::process_input() {
  if (impl_->processing_input) return;  // called by a message's callback: the outer call processes the rest
  impl_->processing_input = true;
  impl_->queue.callAvailable(ros::WallDuration(0));
  impl_->processing_input = false;
  impl_->services.serve();
  impl_->guard.rethrow();
}

BridgeTime RosBridge::now() const { return impl_->clock.now(); }

bool RosBridge::clock_reaches_others() const { return impl_->clock.reaches_others(); }

void RosBridge::publish_clock(double sim_time) {
  impl_->clock.set(sim_time);
  if (impl_->topics.publishers_on(impl_->clock.topic()) == 0) impl_->clock.publish();
}

void RosBridge::publish_diagnostics() {
  if (!impl_->options.take_report) return;
  if (impl_->master.run([impl = impl_.get()] { impl->diagnostics.publish(); }, kLastWords)) {
    std::this_thread::sleep_for(kLastWords);  // roscpp sends on its own thread and does not report when it is done
  }
}

void RosBridge::shutdown_endpoints() {
  {
    const std::lock_guard lock(impl_->urgent_mutex);
    impl_->urgent.clear();
  }
  impl_->topics.shutdown_all();
  impl_->services.remove_from(impl_->first_of_scenes);
}

bool RosBridge::connected() const {
  return impl_->master.state() == MasterThread::State::kConnected && !ros::isShuttingDown();
}

std::string RosBridge::master_uri() const { return ros::master::getURI(); }

NodeGraph RosBridge::graph() {
  const auto found = std::make_shared<NodeGraph>();  // the job may run later
  const bool answered =
      impl_->master.run([reader = impl_->graph_reader, found] { *found = reader->read(); }, kGraphTimeout);
  return answered ? *found : NodeGraph();
}

std::string RosBridge::node_name() const { return ros::this_node::getName(); }

}  // namespace bubblesim
