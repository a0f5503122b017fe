// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "arrivals.hpp"
#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/messages/later_services.hpp"
#include "endpoint_table.hpp"
#include "request_queue.hpp"
#include "services/reply_writer.hpp"
#include "services/service_client.hpp"
#include "services/service_server.hpp"

namespace bubblesim::ros2 {

/// The servers and clients of a node; see messages::Bridge. Names are full ones. For the simulation's thread.
class Services {
 public:
  /// `interrupted` may be empty; when it returns true, waiting calls are cancelled.
  Services(Participant& participant, CallbackGuard& guard, Arrivals& arrivals, Rosout& log,
           std::function<bool()> interrupted);

  /// Throws std::invalid_argument for a name that is already advertised. `queue`: of another thread that answers the
  /// requests; scripts cannot call such a service. nullptr: they are answered by serve().
  void add_server(messages::EndpointId id, const std::string& name, const messages::ServiceType& type,
                  messages::ServiceCallback callback, RequestQueue* queue = nullptr);
  void add_server_later(messages::EndpointId id, const std::string& name, const messages::ServiceType& type,
                        messages::RequestCallback on_request);
  void reply(messages::EndpointId server, messages::RequestNumber request, messages::WireBuffer response);
  bool is_ready(messages::EndpointId client) const;
  void call_later(messages::EndpointId client, messages::WireBuffer request, messages::MessageCallback on_response);
  void add_client(messages::EndpointId id, const std::string& name, const messages::ServiceType& type);
  void remove_server(messages::EndpointId id);
  void remove_client(messages::EndpointId id);
  /// Removes the servers and clients with this id and later ones.
  void remove_from(messages::EndpointId first);
  const std::shared_ptr<std::atomic<int>>& waiting(messages::EndpointId server) const;
  const messages::ServiceType& type(messages::EndpointId id) const;

  messages::WireBuffer call(messages::EndpointId client, messages::WireBuffer request, double timeout);
  bool wait_for(const std::string& name, double timeout);
  void serve() { queue_.serve(); }

 private:
  std::shared_ptr<ServiceServer> find_own(const std::string& name) const;
  void check_free(const std::string& name) const;
  bool wait_until(const std::function<bool()>& done, RequestQueue::Clock::time_point deadline);
  messages::ServiceError not_there(const ServiceClient& client, double timeout) const;

  Participant& participant_;
  CallbackGuard& guard_;
  Rosout& log_;
  const std::function<bool()> interrupted_;
  RequestQueue queue_;
  LateReplies late_;
  int nested_ = 0;  // waiting calls, nested in each other
  EndpointTable<ServiceServer> servers_;
  EndpointTable<ServiceClient> clients_;
};

}  // namespace bubblesim::ros2
