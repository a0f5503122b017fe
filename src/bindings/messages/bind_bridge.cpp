// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.Bridge: topics and services for child scripts, with messages as dicts.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "bindings.hpp"
#include "bubblesim/messages/bridge.hpp"
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

EndpointId advertise(Bridge& bridge, const std::string& topic, const std::string& type, std::uint32_t queue_size,
                     bool latch) {
  const messages::MessageType& listed = listed_message(type);
  const py::gil_scoped_release release;
  return bridge.advertise(topic, listed, queue_size, latch);
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
                     std::uint32_t queue_size, TimeForm time, bool tcp_no_delay) {
  const messages::MessageType& listed = listed_message(type);
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
  return bridge.subscribe(topic, listed, queue_size, std::move(deliver), tcp_no_delay);
}

EndpointId subscribe_numbers(Bridge& bridge, const std::string& topic, const std::string& type,
                             const std::vector<std::string>& fields, const NumberTarget& target, py::function refused,
                             std::uint32_t queue_size) {
  const messages::MessageType& listed = listed_message(type);
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
  return bridge.subscribe(topic, listed, queue_size, std::move(deliver), true);
}

messages::WireBuffer default_bytes(const messages::MessageType& type) {
  messages::WireBuffer bytes;
  const std::size_t size = default_size(type);
  if (size != 0) std::memset(bytes.extend(size), 0, size);
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
  const messages::ServiceType& listed = listed_service(type);
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
  const messages::ServiceType& listed = listed_service(type);
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

}  // namespace

void bind_bridge(py::module_& core) {
  const auto without_gil = py::call_guard<py::gil_scoped_release>();
  py::register_exception<messages::ServiceError>(core, "ServiceError", PyExc_RuntimeError);
  py::register_exception<messages::NoMaster>(core, "NoMaster", PyExc_RuntimeError);
  py::class_<Bridge>(core, "Bridge",
                     "Topics and services of a message bridge. Handles are integers; stale ones raise ValueError.")
      .def("advertise", &advertise, py::arg("topic"), py::arg("message_type"), py::arg("queue_size"), py::arg("latch"))
      .def("subscribe", &subscribe, py::arg("topic"), py::arg("message_type"), py::arg("callback"),
           py::arg("queue_size"), py::arg("time"), py::arg("tcp_no_delay") = true,
           "Subscribe; `callback` gets each message as a dict.")
      .def("subscribe_numbers", &subscribe_numbers, py::arg("topic"), py::arg("message_type"), py::arg("fields"),
           py::arg("target"), py::arg("refused"), py::arg("queue_size"),
           "Subscribe; a NumberTarget gets the numbers of these fields, such as 'linear.x', of each message, without "
           "Python; `refused` gets those that it cannot use.")
      .def("publish", &publish, py::arg("publisher"), py::arg("message"),
           "Convert and send a dict or a ReadingMessage; do nothing without subscribers. Return None, or [(field, "
           "value)] of the floats of a dict that lost more than a thousandth in integer fields.")
      .def("check", &check, py::arg("publisher"), py::arg("message"),
           "Convert a message without sending it; return what publish() returns.")
      .def("wants_messages", &Bridge::wants_messages, py::arg("publisher"),
           "Return whether publish() would send anything: the topic has subscribers or is latched.")
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
      .def("shutdown_service_server", &Bridge::shutdown_service_server, without_gil)
      .def("shutdown_service_client", &Bridge::shutdown_service_client, without_gil)
      .def("get_parameter", &get_parameter, py::arg("name"), without_gil,
           "Return (exists, value) of a parameter of the master; None for lists and dictionaries. Raise NoMaster "
           "without master.")
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
