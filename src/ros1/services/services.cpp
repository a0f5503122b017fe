// SPDX-License-Identifier: BSD-3-Clause
#include "services/services.hpp"

#include <ros/master.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

#include "master/master_thread.hpp"
#include "master/master_watch.hpp"
#include "master/names.hpp"
#include "master/timed_socket.hpp"
#include "quiet_thread.hpp"
#include "seconds_text.hpp"
#include "services/service_call.hpp"

namespace bubblesim {
namespace {

using messages::EndpointId;
using messages::ServiceError;
using messages::ServiceType;
using messages::WireBuffer;
using messages::WireView;
using Clock = Deadline::Clock;

constexpr std::size_t kRetiredKept = 64;
constexpr int kMostNested = 16;
constexpr int kMostLeftBehind = 16;     // threads of calls that wait for a hanging master
constexpr double kLongestWait = 86400;  // [s]; more would overflow the clock
constexpr double kOneAttempt = 0.5;     // [s]
// Time after the timeout for a thread to report the timeout.
constexpr std::chrono::milliseconds kGrace{100};

Deadline deadline_after(double timeout) {
  const std::chrono::duration<double> seconds(std::min(timeout, kLongestWait));
  return Deadline(Clock::now() + std::chrono::duration_cast<Clock::duration>(seconds));
}

}  // namespace

Services::Services(MasterThread& master, MasterWatch& watch, CallbackGuard& guard, std::shared_ptr<Arrivals> arrivals,
                   std::function<bool()> interrupted)
    : master_(master),
      watch_(watch),
      guard_(guard),
      interrupted_(std::move(interrupted)),
      queue_(std::make_shared<RequestQueue>([arrivals = std::move(arrivals)] { arrivals->note(); })) {}

Services::~Services() { retired_.clear(); }

std::shared_ptr<ServiceServer> Services::add_server(EndpointId id, const std::string& name, const ServiceType& type,
                                                    messages::ServiceCallback callback) {
  return add_server_of(requests_, id, name, type, std::move(callback));
}

std::shared_ptr<ServiceServer> Services::add_server_of(ros::CallbackQueueInterface& queue, EndpointId id,
                                                       const std::string& name, const ServiceType& type,
                                                       messages::ServiceCallback callback) {
  const std::string resolved = resolve_name(name, "service");
  if (find_own(resolved)) {
    throw std::invalid_argument("service '" + resolved + "' is already advertised by this node");
  }
  take_off_leaving();  // before a service of the same name is registered
  auto server = std::make_shared<ServiceServer>(resolved, type, std::move(callback), queue, guard_);
  if (&queue != &requests_) answered_elsewhere_.insert(resolved);
  servers_.emplace(id, server);
  return server;
}

void Services::register_server(ServiceServer& server) {
  server.register_at_master();
  watch_.add_service(server.name());
}

void Services::add_client(EndpointId id, const std::string& name, const ServiceType& type) {
  clients_.emplace(id, std::make_shared<Client>(Client{resolve_name(name, "service"), type}));
}

void Services::remove_server(EndpointId id) {
  const auto found = find_endpoint(servers_, id, "service server");
  found->second->silence();
  if (found->second->is_answering()) {
    leaving_.push_back(std::move(found->second));
  } else {
    take_off(std::move(found->second));
  }
  servers_.erase(found);
}

/// Also closes the connections.
void Services::take_off(std::shared_ptr<ServiceServer> server) {
  master_.post([this, gone = std::move(server)] {
    watch_.remove_service(gone->name());
    retired_.push_back(gone->unregister_from_master());
    if (retired_.size() > kRetiredKept) retired_.pop_front();
  });
}

void Services::take_off_leaving() {
  for (std::shared_ptr<ServiceServer>& server : std::exchange(leaving_, {})) take_off(std::move(server));
}

void Services::serve() {
  queue_->serve();
  take_off_leaving();
}

void Services::remove_client(EndpointId id) { clients_.erase(find_endpoint(clients_, id, "service client")); }

void Services::remove_from(EndpointId first) {
  std::vector<EndpointId> ids;
  for (const auto& [id, server] : servers_) {
    if (id >= first) ids.push_back(id);
  }
  for (const EndpointId id : ids) remove_server(id);
  clients_.clear();
}

WaitingCount Services::waiting(EndpointId server) const {
  return find_endpoint(servers_, server, "service server")->second->waiting();
}

const ServiceType& Services::type(EndpointId id) const {
  const auto client = clients_.find(id);
  if (client != clients_.end()) return client->second->type;
  return find_endpoint(servers_, id, "service server or client")->second->type();
}

WireBuffer Services::call(EndpointId client, WireBuffer request, double timeout) {
  // Copies, because a callback may shut down the client meanwhile.
  const auto [name, type] = *find_endpoint(clients_, client, "service client")->second;
  if (!(timeout > 0)) throw std::invalid_argument("the timeout of a service call must be positive");
  if (const std::shared_ptr<ServiceServer> own = find_own(name)) {
    if (answered_elsewhere_.count(name) > 0) {
      throw ServiceError("service '" + name +
                         "' is for other nodes: its answer would wait for the step of this script");
    }
    if (own->type().type_hash != type.type_hash) throw other_type(name, own->type().name, own->type().type_hash, type);
    try {
      return own->answer(WireView(request.data(), request.size()));
    } catch (const ServiceError& error) {
      throw ServiceError("service '" + name + "' failed: " + error.what());
    }
  }
  struct Call {
    WireBuffer request;
    WireBuffer response;
    std::exception_ptr error;
    std::atomic<bool> found{false};
  };
  const auto call = std::make_shared<Call>();
  call->request = std::move(request);
  const Deadline deadline = deadline_after(timeout);
  const bool finished = run_beside(
      [call, deadline, service = name, &wanted = type] {
        try {
          call->response = call_service(service, wanted, std::move(call->request), deadline, call->found);
        } catch (...) {
          call->error = std::current_exception();
        }
      },
      deadline);
  if (!finished && !call->found) {
    throw ServiceError("service '" + name + "' was not called: the ROS master does not answer");
  }
  // A thread that has not finished has only not come to report it.
  const std::exception_ptr error = finished ? call->error : std::make_exception_ptr(TimedSocket::TimedOut());
  if (!error) return std::move(call->response);
  try {
    std::rethrow_exception(error);
  } catch (const TimedSocket::TimedOut&) {
    throw ServiceError("service '" + name + "' did not answer within " + seconds_text(timeout));
  }
}

bool Services::wait_for(const std::string& name, double timeout) {
  const std::string resolved = resolve_name(name, "service");
  if (!(timeout >= 0)) throw std::invalid_argument("the timeout for a service must not be negative");
  if (find_own(resolved)) return true;
  const auto found = std::make_shared<bool>(false);
  const Deadline deadline = deadline_after(timeout > 0 ? timeout : kOneAttempt);
  const auto look = [found, deadline, resolved, once = timeout == 0] {
    while (!(*found = find_service(resolved, deadline)) && !once && !deadline.over()) {
      std::this_thread::sleep_for(deadline.slice());
    }
  };
  return run_beside(look, deadline) && *found;
}

void Services::silence() {
  for (const auto& [id, server] : servers_) server->silence();
}

bool Services::finish_calls(std::chrono::milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  while (*calls_ > 0 && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return *calls_ == 0;
}

std::shared_ptr<ServiceServer> Services::find_own(const std::string& name) const {
  for (const auto& [id, server] : servers_) {
    if (server->name() == name) return server;
  }
  return nullptr;
}

/// Runs `work` on its own thread and answers requests until it has ended. Returns false if it has not ended by
/// `deadline`: only the master and a busy machine can delay it longer.
bool Services::run_beside(std::function<void()> work, Deadline deadline) {
  if (nested_ >= kMostNested) {
    throw ServiceError(std::to_string(kMostNested) + " nested service calls: check for services that call each other");
  }
  if (*calls_ - nested_ >= kMostLeftBehind) return false;
  const auto done = std::make_shared<std::atomic<bool>>(false);
  ++*calls_;
  // The thread ends at the deadline or when the master answers; it owns everything that it needs.
  start_without_signals([work = std::move(work), done, queue = queue_, calls = calls_] {
    work();
    *done = true;
    queue->wake();
    --*calls;
  }).detach();
  bool interrupted = false;
  const auto is_over = [&] {
    interrupted = interrupted_ && interrupted_();
    return *done || interrupted;
  };
  ++nested_;
  const bool finished = queue_->serve_until(is_over, deadline.end() + kGrace);
  --nested_;
  if (interrupted && !*done) {
    deadline.give_up();
    throw ServiceError("the call was cancelled: the simulator is ending");
  }
  return finished;
}

}  // namespace bubblesim
