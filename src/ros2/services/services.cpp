// SPDX-License-Identifier: BSD-3-Clause
#include "services/services.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include "graph/names.hpp"
#include "seconds_text.hpp"

namespace bubblesim::ros2 {
namespace {

using messages::EndpointId;
using messages::ServiceError;
using messages::ServiceType;
using messages::WireBuffer;
using messages::WireView;

constexpr int kMostNested = 32;
constexpr double kMostSeconds = 1e6;

RequestQueue::Clock::time_point deadline_in(double seconds) {
  const std::chrono::duration<double> wait(std::min(seconds, kMostSeconds));
  return RequestQueue::Clock::now() + std::chrono::duration_cast<RequestQueue::Clock::duration>(wait);
}

}  // namespace

Services::Services(Participant& participant, CallbackGuard& guard, Arrivals& arrivals, Rosout& log,
                   std::function<bool()> interrupted)
    : participant_(participant), guard_(guard), log_(log), interrupted_(std::move(interrupted)), queue_([&arrivals] {
        arrivals.note();
      }) {}

void Services::add_server(EndpointId id, const std::string& name, const ServiceType& type,
                          messages::ServiceCallback callback, RequestQueue* queue) {
  check_free(name);
  servers_.emplace(id, std::make_shared<ServiceServer>(participant_, name, type, std::move(callback),
                                                       queue != nullptr ? *queue : queue_, guard_, late_, log_));
}

void Services::add_server_later(EndpointId id, const std::string& name, const ServiceType& type,
                                messages::RequestCallback on_request) {
  check_free(name);
  servers_.emplace(id, std::make_shared<ServiceServer>(participant_, name, type, std::move(on_request), queue_, guard_,
                                                       late_, log_));
}

void Services::check_free(const std::string& name) const {
  if (find_own(name) != nullptr) throw std::invalid_argument("service '" + name + "' is already advertised here");
}

void Services::reply(EndpointId server, messages::RequestNumber request, WireBuffer response) {
  find_endpoint(servers_, server, "service server")->second->reply(request, std::move(response));
}

bool Services::is_ready(EndpointId client) const {
  return find_endpoint(clients_, client, "service client")->second->is_ready();
}

void Services::call_later(EndpointId client, WireBuffer request, messages::MessageCallback on_response) {
  find_endpoint(clients_, client, "service client")->second->call_later(std::move(request), std::move(on_response));
}

void Services::add_client(EndpointId id, const std::string& name, const ServiceType& type) {
  clients_.emplace(id, std::make_shared<ServiceClient>(participant_, name, type, queue_, guard_));
}

void Services::remove_server(EndpointId id) {
  const auto found = find_endpoint(servers_, id, "service server");
  found->second->silence();
  servers_.erase(found);
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

const std::shared_ptr<std::atomic<int>>& Services::waiting(EndpointId server) const {
  return find_endpoint(servers_, server, "service server")->second->waiting();
}

const ServiceType& Services::type(EndpointId id) const {
  const auto client = clients_.find(id);
  if (client != clients_.end()) return client->second->type();
  return find_endpoint(servers_, id, "service server or client")->second->type();
}

std::shared_ptr<ServiceServer> Services::find_own(const std::string& name) const {
  for (const auto& [id, server] : servers_) {
    if (server->name() == name) return server;
  }
  return nullptr;
}

/// Answers requests meanwhile. Returns false at the deadline.
bool Services::wait_until(const std::function<bool()>& done, RequestQueue::Clock::time_point deadline) {
  if (nested_ >= kMostNested) {
    throw ServiceError(std::to_string(kMostNested) + " nested service calls: check for services that call each other");
  }
  bool cancelled = false;
  ++nested_;
  const bool finished = queue_.serve_until(
      [&] {
        cancelled = interrupted_ && interrupted_();
        return cancelled || done();
      },
      deadline);
  --nested_;
  if (cancelled) throw ServiceError("the call was cancelled: the simulator is ending");
  return finished;
}

ServiceError Services::not_there(const ServiceClient& client, double timeout) const {
  for (const std::string& other : participant_.types_of_readers(request_topic(client.name(), client.type()).topic)) {
    const std::string type = service_of(other);
    if (type != client.type().name) {
      return ServiceError("service '" + client.name() + "' is of type " + type + ", not " + client.type().name);
    }
  }
  return ServiceError("service '" + client.name() + "' was not found within " + seconds_text(timeout));
}

WireBuffer Services::call(EndpointId id, WireBuffer request, double timeout) {
  // A callback may shut down the client meanwhile.
  const std::shared_ptr<ServiceClient> client = find_endpoint(clients_, id, "service client")->second;
  if (!(timeout > 0)) throw std::invalid_argument("the timeout of a service call must be positive");
  const std::string& name = client->name();
  if (const std::shared_ptr<ServiceServer> own = find_own(name)) {
    if (!own->is_answered_by(queue_)) {
      throw ServiceError("service '" + name +
                         "' is for other nodes: its answer would wait for the step of this script");
    }
    if (own->type().type_hash != client->type().type_hash) {
      throw ServiceError("service '" + name + "' is of type " + own->type().name + ", not " + client->type().name);
    }
    try {
      return own->answer(WireView(request.data(), request.size()));
    } catch (const ServiceError& error) {
      throw ServiceError("service '" + name + "' failed: " + error.what());
    }
  }
  const auto deadline = deadline_in(timeout);
  if (!wait_until([&] { return client->is_ready(); }, deadline)) throw not_there(*client, timeout);
  const std::optional<std::int64_t> number = client->send(std::move(request));
  if (!number) throw ServiceError("the request to service '" + name + "' could not be sent");
  std::optional<std::vector<std::uint8_t>> reply;
  const auto has_reply = [&] {
    reply = client->take_reply(*number);
    return reply.has_value();
  };
  try {
    if (!wait_until(has_reply, deadline)) {
      throw ServiceError("service '" + name + "' did not answer within " + seconds_text(timeout));
    }
  } catch (const ServiceError&) {
    client->forget(*number);
    throw;
  }
  WireBuffer response;
  response.put_bytes(reply->data(), reply->size());
  return response;
}

bool Services::wait_for(const std::string& name, double timeout) {
  if (!(timeout >= 0)) throw std::invalid_argument("the timeout for a service must not be negative");
  const std::string topic = "rq" + name + "Request";
  const auto is_there = [&] { return find_own(name) != nullptr || !participant_.types_of_readers(topic).empty(); };
  return is_there() || (timeout > 0 && wait_until(is_there, deadline_in(timeout)));
}

}  // namespace bubblesim::ros2
