// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.Bridge: topics as child scripts use them, with messages as dicts.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "bubblesim/messages/bridge.hpp"
#include "message_codec.hpp"
#include "message_lookup.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
using messages::Bridge;
using messages::EndpointId;

void publish(Bridge& bridge, EndpointId publisher, const py::object& message) {
  if (!bridge.wants_messages(publisher)) return;
  messages::WireBuffer bytes;
  encode(bridge.message_type(publisher), message.ptr(), bytes);
  const py::gil_scoped_release release;
  bridge.publish(publisher, std::move(bytes));
}

/// Throws what publish() would throw while somebody listens.
void check(const Bridge& bridge, EndpointId publisher, const py::object& message) {
  messages::WireBuffer bytes;
  encode(bridge.message_type(publisher), message.ptr(), bytes);
}

EndpointId advertise(Bridge& bridge, const std::string& topic, const std::string& type, std::uint32_t queue_size,
                     bool latch) {
  const messages::MessageType& listed = listed_message(type);
  const py::gil_scoped_release release;
  return bridge.advertise(topic, listed, queue_size, latch);
}

/// A Python function that may be dropped by a thread that does not hold the GIL.
using SharedFunction = std::shared_ptr<py::function>;

SharedFunction share(py::function function) {
  return {new py::function(std::move(function)), [](py::function* dropped) {
            if (Py_IsInitialized() == 0) return;  // Python is gone, and the function with it
            const py::gil_scoped_acquire gil;
            delete dropped;
          }};
}

EndpointId subscribe(Bridge& bridge, const std::string& topic, const std::string& type, py::function callback,
                     std::uint32_t queue_size, TimeForm time) {
  const messages::MessageType& listed = listed_message(type);
  auto deliver = [&listed, topic, time, function = share(std::move(callback))](messages::WireView bytes) {
    const py::gil_scoped_acquire gil;
    py::object message;
    try {
      message = decode(listed, bytes, {time});
    } catch (const py::error_already_set& error) {
      // The fault of whoever sent it: no reason to end the script or the simulation.
      std::fputs(("warning: a message on '" + topic + "' is left out: " + error.what() + "\n").c_str(), stderr);
      return;
    }
    (*function)(message);
  };
  const py::gil_scoped_release release;
  return bridge.subscribe(topic, listed, queue_size, std::move(deliver));
}

}  // namespace

void bind_bridge(py::module_& core) {
  const auto without_gil = py::call_guard<py::gil_scoped_release>();
  py::class_<Bridge>(core, "Bridge", "Topics of a message bridge. Handles are integers; ValueError for stale ones.")
      .def("advertise", &advertise, py::arg("topic"), py::arg("message_type"), py::arg("queue_size"), py::arg("latch"))
      .def("subscribe", &subscribe, py::arg("topic"), py::arg("message_type"), py::arg("callback"),
           py::arg("queue_size"), py::arg("time"), "`callback` gets each message as a dict.")
      .def("publish", &publish, py::arg("publisher"), py::arg("message"),
           "Converts and sends a dict; does nothing when nobody listens.")
      .def("check", &check, py::arg("publisher"), py::arg("message"), "Converts a dict without sending it.")
      .def("shutdown_publisher", &Bridge::shutdown_publisher, without_gil)
      .def("shutdown_subscriber", &Bridge::shutdown_subscriber, without_gil)
      .def(
          "now",
          [](const Bridge& bridge) {
            const messages::BridgeTime now = bridge.now();
            return std::make_pair(now.sec, now.nanosec);
          },
          "(sec, nanosec) to stamp messages with.");
}

}  // namespace bubblesim::bindings
