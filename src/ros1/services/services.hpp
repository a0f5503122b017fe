// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "arrivals.hpp"
#include "bubblesim/messages/bridge.hpp"
#include "callbacks/request_callbacks.hpp"
#include "endpoint_table.hpp"
#include "master/deadline.hpp"
#include "request_queue.hpp"
#include "services/service_server.hpp"

namespace bubblesim {

class MasterThread;
class MasterWatch;

/// The servers and clients of a node; see messages::Bridge. Everything belongs to the simulation thread except the jobs
/// posted to `master`.
class Services {
 public:
  /// `interrupted` may be empty; when it returns true, waiting calls are cancelled.
  Services(MasterThread& master, MasterWatch& watch, CallbackGuard& guard, std::shared_ptr<Arrivals> arrivals,
           std::function<bool()> interrupted);
  ~Services();

  /// Throws for a name that is already advertised. The new server is not registered yet.
  std::shared_ptr<ServiceServer> add_server(messages::EndpointId id, const std::string& name,
                                            const messages::ServiceType& type, messages::ServiceCallback callback);
  /// Adds a server whose requests are answered by another thread, which serves `queue`. Scripts cannot call it.
  std::shared_ptr<ServiceServer> add_server_of(ros::CallbackQueueInterface& queue, messages::EndpointId id,
                                               const std::string& name, const messages::ServiceType& type,
                                               messages::ServiceCallback callback);
  /// On the master thread.
  void register_server(ServiceServer& server);
  void add_client(messages::EndpointId id, const std::string& name, const messages::ServiceType& type);
  void remove_server(messages::EndpointId id);
  void remove_client(messages::EndpointId id);
  /// Removes the servers and clients with this id and later ones.
  void remove_from(messages::EndpointId first);
  WaitingCount waiting(messages::EndpointId server) const;
  const messages::ServiceType& type(messages::EndpointId id) const;

  messages::WireBuffer call(messages::EndpointId client, messages::WireBuffer request, double timeout);
  bool wait_for(const std::string& name, double timeout);
  void serve();

  /// Silences all servers, for the end of the bridge.
  void silence();
  /// Waits until all call threads have ended; returns false at `timeout`.
  bool finish_calls(std::chrono::milliseconds timeout);

 private:
  struct Client {
    std::string name;
    const messages::ServiceType& type;
  };

  std::shared_ptr<ServiceServer> find_own(const std::string& name) const;
  void take_off(std::shared_ptr<ServiceServer> server);
  void take_off_leaving();
  bool run_beside(std::function<void()> work, Deadline deadline);

  MasterThread& master_;
  MasterWatch& watch_;
  CallbackGuard& guard_;
  const std::function<bool()> interrupted_;
  const std::shared_ptr<RequestQueue> queue_;
  RequestCallbacks requests_{queue_};
  const std::shared_ptr<std::atomic<int>> calls_ = std::make_shared<std::atomic<int>>(0);  // running threads
  int nested_ = 0;  // waiting calls, nested in each other
  EndpointTable<ServiceServer> servers_;
  std::set<std::string> answered_elsewhere_;  // names of servers of other threads
  EndpointTable<Client> clients_;
  std::vector<std::shared_ptr<ServiceServer>> leaving_;  // removed in their own callbacks, which have not returned yet
  std::deque<ros::ServicePublicationPtr> retired_;  // of the master thread; see ServiceServer::unregister_from_master()
};

}  // namespace bubblesim
