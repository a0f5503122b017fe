// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.Bridge: topics and services for child scripts, with messages as dicts.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include "bindings.hpp"
#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/messages/later_services.hpp"
#include "bubblesim/messages/number_fields.hpp"
#include "devices/number_target.hpp"
#include "message_codec.hpp"
#include "messages/message_lookup.hpp"
#include "messages/reading_message.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
using messages::Bridge;
using messages::EndpointId;
using messages::Qos;

py::object publish(Bridge& bridge, EndpointId publisher, const py::object& message) {
  if (!bridge.wants_messages(publisher)) return py::none();
  const messages::MessageType& type = bridge.message_type(publisher);
  const messages::FieldReader* reading = reading_message(message);
  messages::WireBuffer bytes;
  std::vector<Truncation> truncations;
  if (reading == nullptr) truncations = encode(type, message.ptr(), bytes);
  {
    const py::gil_scoped_release release;
    if (reading != nullptr) messages::encode(type, *reading, bytes);
    bridge.publish(publisher, std::move(bytes));
  }
  return to_python(truncations);
}

/// Throws what publish() would throw with a subscriber.
py::object check(const Bridge& bridge, EndpointId publisher, const py::object& message) {
  messages::WireBuffer bytes;
  return to_python(encode_any(bridge.message_type(publisher), message, bytes));
}

EndpointId advertise(Bridge& bridge, const std::string& topic, const std::string& type, const Qos& qos) {
  const messages::MessageType& listed = listed_message(type, bridge.version());
  const py::gil_scoped_release release;
  return bridge.advertise(topic, listed, qos);
}

/// A Python function that a thread without the GIL may release.
using SharedFunction = std::shared_ptr<py::function>;

SharedFunction share(py::function function) {
  return {new py::function(std::move(function)), [](py::function* dropped) {
            if (Py_IsInitialized() == 0) return;  // Python has been finalized, and the function with it
            const py::gil_scoped_acquire gil;
            delete dropped;
          }};
}

/// An error of the sender must not end the script or the simulation.
void warn_of_dropped(const std::string& topic, const char* why) {
  std::fputs(("warning: dropped a message on '" + topic + "': " + why + "\n").c_str(), stderr);
}

EndpointId subscribe(Bridge& bridge, const std::string& topic, const std::string& type, py::function callback,
                     const Qos& qos, TimeForm time) {
  const messages::MessageType& listed = listed_message(type, bridge.version());
  auto deliver = [&listed, topic, time, function = share(std::move(callback))](messages::WireView bytes) {
    const py::gil_scoped_acquire gil;
    py::object message;
    try {
      message = decode(listed, bytes, {time});
    } catch (const py::error_already_set& error) {
      warn_of_dropped(topic, error.what());
      return;
    }
    (*function)(message);
  };
  const py::gil_scoped_release release;
  return bridge.subscribe(topic, listed, qos, std::move(deliver));
}

EndpointId subscribe_numbers(Bridge& bridge, const std::string& topic, const std::string& type,
                             const std::vector<std::string>& fields, const NumberTarget& target, py::function refused,
                             const Qos& qos) {
  const messages::MessageType& listed = listed_message(type, bridge.version());
  auto deliver = [topic, numbers = messages::NumberFields(listed, fields), take = target.take,
                  function = share(std::move(refused))](messages::WireView bytes) {
    std::vector<double> values;
    try {
      values = numbers.read(bytes);
    } catch (const messages::WireError& error) {
      warn_of_dropped(topic, error.what());
      return;
    }
    if (take(values)) return;
    const py::gil_scoped_acquire gil;
    (*function)(values);
  };
  const py::gil_scoped_release release;
  return bridge.subscribe(topic, listed, qos, std::move(deliver));
}

messages::WireBuffer default_bytes(const messages::MessageType& type) {
  messages::WireBuffer bytes;
  bytes.begin(layout_of(type.version));
  put_default(type, bytes);
  return bytes;
}

py::object decode_request(const messages::ServiceType& type, messages::WireView bytes, TimeForm time) {
  try {
    return decode(*type.request, bytes, {time});
  } catch (const py::error_already_set& error) {
    throw messages::ServiceError(error.what());  // the caller's error
  }
}

EndpointId advertise_service(Bridge& bridge, const std::string& name, const std::string& type, py::function callback,
                             TimeForm time) {
  const messages::ServiceType& listed = listed_service(type, bridge.version());
  auto answer = [&listed, time, function = share(std::move(callback))](messages::WireView bytes) {
    const py::gil_scoped_acquire gil;
    const py::object request = decode_request(listed, bytes, time);
    py::object response;
    try {
      response = (*function)(request);
    } catch (const py::error_already_set& error) {
      if (!error.matches(py::module_::import("bubblesim._core").attr("ServiceError"))) throw;
      throw messages::ServiceError(py::str(error.value()));
    }
    if (response.is_none()) return default_bytes(*listed.response);
    messages::WireBuffer out;
    encode(*listed.response, response.ptr(), out);
    return out;
  };
  const py::gil_scoped_release release;
  return bridge.advertise_service(name, listed, std::move(answer));
}

std::pair<bool, messages::ParameterValue> get_parameter(Bridge& bridge, const std::string& name) {
  const std::optional<messages::ParameterValue> value = bridge.get_parameter(name);
  return {value.has_value(), value.value_or(std::monostate())};
}

EndpointId service_client(Bridge& bridge, const std::string& name, const std::string& type) {
  const messages::ServiceType& listed = listed_service(type, bridge.version());
  const py::gil_scoped_release release;
  return bridge.service_client(name, listed);
}

py::object call(Bridge& bridge, EndpointId client, const py::object& request, double timeout, TimeForm time) {
  const messages::ServiceType& type = bridge.service_type(client);
  messages::WireBuffer bytes;
  encode(*type.request, request.ptr(), bytes);
  messages::WireBuffer response;
  {
    const py::gil_scoped_release release;
    response = bridge.call(client, std::move(bytes), timeout);
  }
  return decode(*type.response, messages::WireView(response.data(), response.size()), {time});
}

messages::LaterServices& later_services(Bridge& bridge) {
  if (messages::LaterServices* services = bridge.later_services()) return *services;
  throw std::invalid_argument("ROS 1 has no services that answer later");
}

EndpointId advertise_service_later(Bridge& bridge, const std::string& name, const std::string& type,
                                   py::function callback, TimeForm time) {
  const messages::ServiceType& listed = listed_service(type, bridge.version());
  auto on_request = [&listed, name, time, function = share(std::move(callback))](messages::RequestNumber number,
                                                                                 messages::WireView bytes) {
    const py::gil_scoped_acquire gil;
    py::object request;
    try {
      request = decode(*listed.request, bytes, {time});
    } catch (const py::error_already_set& error) {
      warn_of_dropped(name, error.what());
      return;
    }
    (*function)(number, request);
  };
  const py::gil_scoped_release release;
  return later_services(bridge).advertise_service_later(name, listed, std::move(on_request));
}

void reply(Bridge& bridge, EndpointId server, messages::RequestNumber number, const py::object& response) {
  messages::WireBuffer bytes;
  encode(*bridge.service_type(server).response, response.ptr(), bytes);
  const py::gil_scoped_release release;
  later_services(bridge).reply(server, number, std::move(bytes));
}

void call_later(Bridge& bridge, EndpointId client, const py::object& request, py::function callback, TimeForm time) {
  const messages::ServiceType& type = bridge.service_type(client);
  messages::WireBuffer bytes;
  encode(*type.request, request.ptr(), bytes);
  auto on_response = [&type, time, function = share(std::move(callback))](messages::WireView response) {
    const py::gil_scoped_acquire gil;
    (*function)(decode(*type.response, response, {time}));
  };
  const py::gil_scoped_release release;
  later_services(bridge).call_later(client, std::move(bytes), std::move(on_response));
}

void bind_qos(py::module_& core) {
  py::class_<Qos>(core, "Qos", "Quality of service of a topic.")
      .def(py::init([](std::uint32_t depth, bool transient_local, bool reliable, bool tcp_no_delay,
                       std::optional<double> lifespan, std::optional<double> deadline) {
             return Qos{depth, transient_local, reliable, tcp_no_delay, lifespan, deadline};
           }),
           py::arg("depth") = 1, py::kw_only(), py::arg("transient_local") = false, py::arg("reliable") = true,
           py::arg("tcp_no_delay") = true, py::arg("lifespan") = py::none(), py::arg("deadline") = py::none(),
           "See include/bubblesim/messages/qos.hpp; a depth of 0 has no limit, times are seconds.")
      .def_readonly("depth", &Qos::depth)
      .def_readonly("transient_local", &Qos::transient_local)
      .def_readonly("reliable", &Qos::reliable)
      .def_readonly("tcp_no_delay", &Qos::tcp_no_delay)
      .def_readonly("lifespan", &Qos::lifespan)
      .def_readonly("deadline", &Qos::deadline)
      .def(
          "__eq__",
          [](const Qos& left, const Qos& right) {
            const auto values = [](const Qos& qos) {
              return std::tie(qos.depth, qos.transient_local, qos.reliable, qos.tcp_no_delay, qos.lifespan,
                              qos.deadline);
            };
            return values(left) == values(right);
          },
          py::is_operator());
  py::implicitly_convertible<std::uint32_t, Qos>();
}

}  // namespace

void bind_bridge(py::module_& core) {
  bind_qos(core);
  const auto without_gil = py::call_guard<py::gil_scoped_release>();
  py::register_exception<messages::ServiceError>(core, "ServiceError", PyExc_RuntimeError);
  py::register_exception<messages::NoParameterServer>(core, "NoParameterServer", PyExc_RuntimeError);
  py::class_<Bridge>(core, "Bridge",
                     "Topics and services of a message bridge. Handles are integers; stale ones raise ValueError.")
      .def_property_readonly("version", &Bridge::version, "The messages.RosVersion of its types.")
      .def("advertise", &advertise, py::arg("topic"), py::arg("message_type"), py::arg("qos"),
           "Advertise a topic with a Qos, or with a depth alone.")
      .def("subscribe", &subscribe, py::arg("topic"), py::arg("message_type"), py::arg("callback"), py::arg("qos"),
           py::arg("time"), "Subscribe; `callback` gets each message as a dict.")
      .def("subscribe_numbers", &subscribe_numbers, py::arg("topic"), py::arg("message_type"), py::arg("fields"),
           py::arg("target"), py::arg("refused"), py::arg("qos"),
           "Subscribe; a NumberTarget gets the numbers of these fields, such as 'linear.x', of each message, without "
           "Python; `refused` gets those that it cannot use.")
      .def("publish", &publish, py::arg("publisher"), py::arg("message"),
           "Convert and send a dict or a ReadingMessage; do nothing without subscribers. Return None, or [(field, "
           "value)] of the floats of a dict that lost more than a thousandth in integer fields.")
      .def("check", &check, py::arg("publisher"), py::arg("message"),
           "Convert a message without sending it; return what publish() returns.")
      .def("wants_messages", &Bridge::wants_messages, py::arg("publisher"),
           "Return whether publish() would send anything: the topic has subscribers, or keeps messages for late ones.")
      .def("yield_topic", &Bridge::yield_topic, py::arg("endpoint"), without_gil,
           "Make an endpoint inactive while other endpoints of this bridge use its topic.")
      .def("set_priority", &Bridge::set_priority, py::arg("endpoint"),
           "Include a subscriber or service in urgent_waits().")
      .def("urgent_waits", &Bridge::urgent_waits, "Return whether a priority endpoint has pending input. Thread-safe.")
      .def("has_publisher", &Bridge::has_publisher, py::arg("subscriber"),
           "Return whether a subscriber was connected to a publisher a quarter of a second ago.")
      .def("shutdown_publisher", &Bridge::shutdown_publisher, without_gil)
      .def("shutdown_subscriber", &Bridge::shutdown_subscriber, without_gil)
      .def("advertise_service", &advertise_service, py::arg("name"), py::arg("service_type"), py::arg("callback"),
           py::arg("time"),
           "Advertise a service. `callback` gets each request as a dict and returns the response as one; None means a "
           "default response. If it raises, the caller gets the text, and process_input() raises the exception unless "
           "it is a ServiceError.")
      .def("service_client", &service_client, py::arg("name"), py::arg("service_type"))
      .def("call", &call, py::arg("client"), py::arg("request"), py::arg("timeout"), py::arg("time"),
           "Call a service with a dict and return the response as a dict, within `timeout` seconds; meanwhile answer "
           "calls of the services advertised here. Raise ServiceError if the service does not exist, has another type, "
           "fails or times out.")
      .def("wait_for_service", &Bridge::wait_for_service, py::arg("name"), py::arg("timeout"), without_gil,
           "Wait at most `timeout` seconds for a service and return whether it exists; check once if `timeout` is 0.")
      .def("advertise_service_later", &advertise_service_later, py::arg("name"), py::arg("service_type"),
           py::arg("callback"), py::arg("time"),
           "Advertise a service of ROS 2; `callback` gets each request as (number, dict), and reply() answers it.")
      .def("reply", &reply, py::arg("server"), py::arg("number"), py::arg("response"), "Answer a request with a dict.")
      .def(
          "service_is_ready",
          [](Bridge& bridge, EndpointId client) { return later_services(bridge).service_is_ready(client); },
          py::arg("client"), "Return whether a server of ROS 2 gets the requests of a client.")
      .def("call_later", &call_later, py::arg("client"), py::arg("request"), py::arg("callback"), py::arg("time"),
           "Send a request to a service of ROS 2; `callback` gets the response as a dict when it has arrived.")
      .def("shutdown_service_server", &Bridge::shutdown_service_server, without_gil)
      .def("shutdown_service_client", &Bridge::shutdown_service_client, without_gil)
      .def("get_parameter", &get_parameter, py::arg("name"), without_gil,
           "Return (exists, value) of a parameter; None for lists and dictionaries. Raise NoParameterServer if ROS 1 "
           "has no "
           "master.")
      .def("set_parameter", &Bridge::set_parameter, py::arg("name"), py::arg("value"), without_gil)
      .def("delete_parameter", &Bridge::delete_parameter, py::arg("name"), without_gil)
      .def("search_parameter", &Bridge::search_parameter, py::arg("name"), without_gil,
           "Return the parameter's full name in the nearest namespace that has it, or None.")
      .def("process_input", &Bridge::process_input, without_gil,
           "Deliver pending input; only within a service's callback.")
      .def("clock_reaches_others", &Bridge::clock_reaches_others,
           "Return whether another node is connected to /clock; True if nodes use wall time.")
      .def(
          "now",
          [](const Bridge& bridge) {
            const messages::BridgeTime now = bridge.now();
            return std::make_pair(now.sec, now.nanosec);
          },
          "Return the current time for message stamps as (sec, nanosec).");
}

}  // namespace bubblesim::bindings
