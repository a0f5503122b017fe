// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.messages: the message types and their bytes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <variant>

#include "bindings.hpp"
#include "bubblesim/messages/registry.hpp"
#include "message_codec.hpp"
#include "messages/message_lookup.hpp"
#include "messages/reading_message.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
using messages::MessageType;
using messages::RosVersion;
using messages::ServiceType;

py::bytes encode_to_bytes(const std::string& name, const py::object& message, RosVersion version) {
  messages::WireBuffer out;
  encode_any(listed_message(name, version), message, out);
  return {reinterpret_cast<const char*>(out.data()), out.size()};
}

py::object truncations(const std::string& name, const py::object& message, RosVersion version) {
  messages::WireBuffer out;
  return to_python(encode_any(listed_message(name, version), message, out));
}

py::object decode_buffer(const std::string& name, const py::buffer& data, TimeForm time, RosVersion version) {
  const MessageType& type = listed_message(name, version);
  const py::buffer_info info = data.request();
  if (PyBuffer_IsContiguous(info.view(), 'C') == 0) {
    PyErr_SetString(message_error(), (name + ": the bytes of a message must be contiguous").c_str());
    throw py::error_already_set();
  }
  const auto size = static_cast<std::size_t>(info.size * info.itemsize);
  return decode(type, messages::WireView(static_cast<const std::uint8_t*>(info.ptr), size), {time});
}

/// Bytes that are not UTF-8, as in comments of old definitions, become surrogates.
py::str text_of(const std::string& bytes) {
  PyObject* text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

struct ConstantValue {
  py::object operator()(const std::string& text) const { return text_of(text); }
  template <class T>
  py::object operator()(T number) const {
    return py::cast(number);
  }
};

py::dict constants(const std::string& name, RosVersion version) {
  py::dict values;
  for (const auto& constant : listed_message(name, version).constants) {
    values[py::str(constant.name)] = std::visit(ConstantValue(), constant.value);
  }
  return values;
}

py::dict fields(const std::string& name, RosVersion version) {
  py::dict types;
  for (const auto& field : listed_message(name, version).fields) types[py::str(field.name)] = type_text(field);
  return types;
}

}  // namespace

void bind_messages(py::module_& core) {
  init_message_codec();
  core.attr("MessageError") = py::reinterpret_borrow<py::object>(message_error());

  py::module_ m = core.def_submodule("messages", "The message types of this build, and their bytes on the wire.");
  m.attr("MessageError") = core.attr("MessageError");
  py::enum_<TimeForm>(m, "TimeForm", "Form of times and durations from decode().")
      .value("SECS_NSECS", TimeForm::kSecsNsecs, "{'secs': int, 'nsecs': int}")
      .value("SEC_NANOSEC", TimeForm::kSecNanosec, "{'sec': int, 'nanosec': int}")
      .value("FLOAT", TimeForm::kFloat, "seconds; a double cannot hold today's date in nanoseconds");

  py::enum_<RosVersion>(m, "RosVersion", "The version of ROS whose types and bytes are meant.")
      .value("ROS1", RosVersion::kRos1)
      .value("ROS2", RosVersion::kRos2);
  const auto version = py::arg("version") = RosVersion::kRos1;

  m.def(
      "encode",
      [](const std::string& name, const py::object& message) {
        return encode_to_bytes(name, message, RosVersion::kRos1);
      },
      py::arg("type_name"), py::arg("message"),
      "Encode a dict or a ReadingMessage to wire bytes. Missing fields get their default; a value that does not fit "
      "raises MessageError.");
  m.def("truncations", &truncations, py::arg("type_name"), py::arg("message"), version,
        "Like encode(), but return None, or [(field, value)] of the floats that lost more than a thousandth in integer "
        "fields.");
  m.def(
      "decode",
      [](const std::string& name, const py::buffer& data, TimeForm time) {
        return decode_buffer(name, data, time, RosVersion::kRos1);
      },
      py::arg("type_name"), py::arg("data"), py::arg("time_form") = TimeForm::kSecsNsecs,
      "Decode wire bytes to a dict. Arrays of numbers become numpy arrays, uint8[] becomes bytes.");
  // Not by an argument, which would cost a tenth of the time of a small message.
  m.def(
      "encode_ros2",
      [](const std::string& name, const py::object& message) {
        return encode_to_bytes(name, message, RosVersion::kRos2);
      },
      py::arg("type_name"), py::arg("message"), "Like encode(), for a type of ROS 2: CDR without its header.");
  m.def(
      "decode_ros2",
      [](const std::string& name, const py::buffer& data, TimeForm time) {
        return decode_buffer(name, data, time, RosVersion::kRos2);
      },
      py::arg("type_name"), py::arg("data"), py::arg("time_form") = TimeForm::kSecsNsecs,
      "Like decode(), for a type of ROS 2: CDR without its header.");
  m.def(
      "default",
      [](const std::string& name, TimeForm time, RosVersion of) {
        return default_message(listed_message(name, of), {time});
      },
      py::arg("type_name"), py::arg("time_form") = TimeForm::kSecsNsecs, version,
      "Return a dict with all fields at their defaults.");

  m.def("message_names", &messages::message_names, version,
        "Return all listed types, sorted, including those that only occur in others.");
  m.def("service_names", &messages::service_names, version, "Return all listed service types, sorted.");
  m.def("ros2_is_before_iron", &messages::ros2_is_before_iron,
        "Return whether ROS_DISTRO names a distribution of ROS 2 before Iron: a few types had other fields then.");
  m.def(
      "type_hash", [](const std::string& name, RosVersion of) { return listed_message(name, of).type_hash; },
      py::arg("type_name"), version, "Return the MD5 of a type of ROS 1, or the RIHS01 hash of one of ROS 2.");
  m.def(
      "service_type_hash", [](const std::string& name, RosVersion of) { return listed_service(name, of).type_hash; },
      py::arg("type_name"), version);
  m.def(
      "service_halves",
      [](const std::string& name, RosVersion of) {
        const ServiceType& type = listed_service(name, of);
        return py::make_tuple(type.request->name, type.response->name);
      },
      py::arg("type_name"), version, "Return the names of the request and response types, for encode() and decode().");
  m.def(
      "definition", [](const std::string& name, RosVersion of) { return text_of(listed_message(name, of).definition); },
      py::arg("type_name"), version, "Return the .msg text, followed by those of nested types.");
  m.def("fields", &fields, py::arg("type_name"), version,
        "Return a dict of field name -> type, in the order of the message.");
  m.def("constants", &constants, py::arg("type_name"), version, "Return a dict of constant name -> value.");
  bind_added_types(m);
}

}  // namespace bubblesim::bindings
