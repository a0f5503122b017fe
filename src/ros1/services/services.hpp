// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "bubblesim/messages/bridge.hpp"
#include "master/deadline.hpp"
#include "services/request_queue.hpp"
#include "services/service_server.hpp"
#include "topics/endpoint_table.hpp"

namespace bubblesim {

class MasterThread;
class MasterWatch;

/// The services that a node offers and calls; messages::Bridge tells what the functions do. All belongs to the
/// simulation's thread but what is posted to `master`.
class Services {
 public:
  /// `interrupted` may be empty; when it says true, calls that wait are given up.
  Services(MasterThread& master, MasterWatch& watch, CallbackGuard& guard, std::shared_ptr<Arrivals> arrivals,
           std::function<bool()> interrupted);
  ~Services();

  /// Refuses a name that is offered already. The new server is not registered yet.
  std::shared_ptr<ServiceServer> add_server(messages::EndpointId id, const std::string& name,
                                            const messages::ServiceType& type, messages::ServiceCallback callback);
  /// On the master's thread.
  void register_server(ServiceServer& server);
  void add_client(messages::EndpointId id, const std::string& name, const messages::ServiceType& type);
  void remove_server(messages::EndpointId id);
  void remove_client(messages::EndpointId id);
  WaitingCount waiting(messages::EndpointId server) const;
  const messages::ServiceType& type(messages::EndpointId id) const;

  messages::WireBuffer call(messages::EndpointId client, messages::WireBuffer request, double timeout);
  bool wait_for(const std::string& name, double timeout);
  void serve();

  /// Silences all servers, for the end of the bridge.
  void silence();
  /// Waits until no thread of a call is left; false when `timeout` has passed before.
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
  const std::shared_ptr<std::atomic<int>> calls_ = std::make_shared<std::atomic<int>>(0);  // threads that run
  int nested_ = 0;  // calls that wait, each but the first made while the one before it did
  EndpointTable<ServiceServer> servers_;
  EndpointTable<Client> clients_;
  std::vector<std::shared_ptr<ServiceServer>> leaving_;  // removed in their own callbacks: they still owe an answer
  std::deque<ros::ServicePublicationPtr> retired_;  // the master thread's; see ServiceServer::unregister_from_master()
};

}  // namespace bubblesim
