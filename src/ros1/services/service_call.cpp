// SPDX-License-Identifier: BSD-3-Clause
#include "services/service_call.hpp"

#include <ros/header.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "master/master_call.hpp"
#include "master/timed_socket.hpp"

namespace bubblesim {
namespace {

using messages::ServiceError;
using messages::ServiceType;
using messages::WireBuffer;

constexpr std::uint32_t kLongestHeader = 10'000'000;
constexpr std::uint32_t kLongestResponse = 1'000'000'000;  // roscpp's own limit

struct Address {
  std::string host;
  std::uint32_t port = 0;
};

/// Empty if the master has no such service.
std::optional<Address> look_up(const std::string& service) {
  RpcAnswer answer = ask_master("lookupService", {service});
  if (!answer.answered) throw ServiceError("no ROS master at " + ros::master::getURI());
  if (!answer.succeeded) return std::nullopt;
  Address address;
  const std::string uri = answer.value;
  if (!ros::network::splitURI(uri, address.host, address.port)) {
    throw ServiceError("the ROS master has an invalid address of service '" + service + "': '" + uri + "'");
  }
  return address;
}

std::vector<std::string> known_services() {
  std::vector<std::string> names;
  RpcAnswer answer = ask_master("getSystemState");
  if (!answer.succeeded) return names;
  XmlRpc::XmlRpcValue& services = answer.value[2];
  for (int i = 0; i < services.size(); ++i) names.push_back(services[i][0]);
  return names;
}

/// `probe`: the server is asked for its header alone.
void write_header(TimedSocket& socket, const std::string& service, bool probe = false) {
  // Request any md5: a server that rejects an md5 only reports it as free text.
  ros::M_string fields{{"service", service}, {"md5sum", "*"}, {"callerid", ros::this_node::getName()}};
  if (probe) fields["probe"] = "1";
  boost::shared_array<std::uint8_t> bytes;
  std::uint32_t size = 0;
  ros::Header::write(fields, bytes, size);
  socket.write(&size, sizeof(size));
  socket.write(bytes.get(), size);
}

std::uint32_t read_length(TimedSocket& socket, std::uint32_t longest) {
  std::uint32_t length = 0;
  socket.read(&length, sizeof(length));
  if (length > longest) throw std::runtime_error("the server does not use TCPROS");
  return length;
}

ros::Header read_header(TimedSocket& socket) {
  const std::uint32_t size = read_length(socket, kLongestHeader);
  const boost::shared_array<std::uint8_t> bytes(new std::uint8_t[size]);
  socket.read(bytes.get(), size);
  ros::Header header;
  std::string error;
  if (!header.parse(bytes, size, error)) throw std::runtime_error("the server does not use TCPROS");
  return header;
}

void check_header(const std::string& service, ros::Header& header, const ServiceType& type) {
  std::string text;
  if (header.getValue("error", text)) throw ServiceError("service '" + service + "' refused the call: " + text);
  std::string name = "?";
  header.getValue("type", name);
  if (header.getValue("md5sum", text) && text != type.type_hash && text != "*")
    throw other_type(service, name, text, type);
}

WireBuffer read_response(TimedSocket& socket, const std::string& service) {
  std::uint8_t succeeded = 0;
  socket.read(&succeeded, sizeof(succeeded));
  const std::uint32_t length = read_length(socket, kLongestResponse);
  WireBuffer response;
  if (length != 0) socket.read(response.extend(length), length);
  if (succeeded != 0) return response;
  const std::string text(reinterpret_cast<const char*>(response.data()), response.size());
  throw ServiceError("service '" + service + "' failed" + (text.empty() ? "" : ": " + text));
}

}  // namespace

ServiceError other_type(const std::string& service, const std::string& name, const std::string& md5,
                        const ServiceType& wanted) {
  std::string text = "service '" + service + "' is of type " + name + ", not " + wanted.name;
  if (name == wanted.name) {
    text = "service '" + service + "' uses another version of " + name + " than this node: md5 " + md5 + ", not " +
           wanted.type_hash;
  }
  return ServiceError(text);
}

WireBuffer call_service(const std::string& name, const ServiceType& type, WireBuffer request, const Deadline& deadline,
                        std::atomic<bool>& found) {
  if (request.size() > std::numeric_limits<std::uint32_t>::max()) throw ServiceError("the request has 4 GiB or more");
  const std::optional<Address> address = look_up(name);
  if (!address) throw ServiceError("no service '" + name + "'" + did_you_mean(name, known_services()));
  found = true;
  try {
    TimedSocket socket(address->host, address->port, deadline);
    write_header(socket, name);
    ros::Header header = read_header(socket);
    check_header(name, header, type);
    const auto length = static_cast<std::uint32_t>(request.size());
    socket.write(&length, sizeof(length));
    socket.write(request.data(), length);
    return read_response(socket, name);
  } catch (const ServiceError&) {
    throw;
  } catch (const TimedSocket::TimedOut&) {
    throw;
  } catch (const std::exception& error) {
    throw ServiceError("connection to service '" + name + "' at " + address->host + ":" +
                       std::to_string(address->port) + " failed: " + error.what());
  }
}

bool find_service(const std::string& name, const Deadline& deadline) {
  try {
    const std::optional<Address> address = look_up(name);
    if (!address) return false;
    const TimedSocket reachable(address->host, address->port, deadline);
    return true;
  } catch (const std::runtime_error&) {  // no master, or a server that died without unregistering
    return false;
  }
}

std::string type_of_service(const std::string& name, const Deadline& deadline) {
  try {
    const std::optional<Address> address = look_up(name);
    if (!address) return {};
    TimedSocket socket(address->host, address->port, deadline);
    write_header(socket, name, true);
    std::string type;
    read_header(socket).getValue("type", type);
    return type;
  } catch (const std::runtime_error&) {  // no master, or a server that does not answer
    return {};
  }
}

}  // namespace bubblesim
