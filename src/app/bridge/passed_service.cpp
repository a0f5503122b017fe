// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/passed_service.hpp"

namespace bubblesim::app {
namespace {

constexpr double kTimeout = 10;  // s

}  // namespace

PassedService::PassedService(const std::string& name, NodeBridge& from, NodeBridge& to,
                             const messages::ServiceType& from_type, const messages::ServiceType& to_type)
    : from_(from),
      to_(to),
      request_(*to_type.request, *from_type.request),
      response_(*from_type.response, *to_type.response),
      client_(from.service_client(name, from_type)),
      server_(to.advertise_service(name, to_type, [this](messages::WireView request) { return call(request); })) {}

PassedService::~PassedService() {
  to_.shutdown_service_server(server_);
  from_.shutdown_service_client(client_);
}

messages::WireBuffer PassedService::call(messages::WireView request) {
  try {
    const messages::WireBuffer response = from_.call(client_, request_.translate(request), kTimeout);
    return response_.translate(messages::WireView(response.data(), response.size()));
  } catch (const messages::WireError& error) {
    throw messages::ServiceError(error.what());
  }
}

}  // namespace bubblesim::app
