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
using messages::ServiceType;

py::bytes encode_to_bytes(const std::string& name, const py::object& message) {
  messages::WireBuffer out;
  encode_any(listed_message(name), message, out);
  return {reinterpret_cast<const char*>(out.data()), out.size()};
}

py::object truncations(const std::string& name, const py::object& message) {
  messages::WireBuffer out;
  return to_python(encode_any(listed_message(name), message, out));
}

py::object decode_buffer(const std::string& name, const py::buffer& data, TimeForm time) {
  const MessageType& type = listed_message(name);
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

py::dict constants(const std::string& name) {
  py::dict values;
  for (const auto& constant : listed_message(name).constants) {
    values[py::str(constant.name)] = std::visit(ConstantValue(), constant.value);
  }
  return values;
}

py::dict fields(const std::string& name) {
  py::dict types;
  for (const auto& field : listed_message(name).fields) types[py::str(field.name)] = type_text(field);
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

  m.def("encode", &encode_to_bytes, py::arg("type_name"), py::arg("message"),
        "Encode a dict or a ReadingMessage to wire bytes. Missing fields get their default; a value that does not fit "
        "raises MessageError.");
  m.def("truncations", &truncations, py::arg("type_name"), py::arg("message"),
        "Like encode(), but return None, or [(field, value)] of the floats that lost more than a thousandth in integer "
        "fields.");
  m.def("decode", &decode_buffer, py::arg("type_name"), py::arg("data"), py::arg("time_form") = TimeForm::kSecsNsecs,
        "Decode wire bytes to a dict. Arrays of numbers become numpy arrays, uint8[] becomes bytes.");
  m.def(
      "default", [](const std::string& name, TimeForm time) { return default_message(listed_message(name), {time}); },
      py::arg("type_name"), py::arg("time_form") = TimeForm::kSecsNsecs,
      "Return a dict with all fields at their defaults.");

  m.def("message_names", &messages::message_names,
        "Return all listed types, sorted, including those that only occur in others.");
  m.def("service_names", &messages::service_names, "Return all listed service types, sorted.");
  m.def(
      "md5", [](const std::string& name) { return listed_message(name).md5; }, py::arg("type_name"));
  m.def(
      "service_md5", [](const std::string& name) { return listed_service(name).md5; }, py::arg("type_name"));
  m.def(
      "service_halves",
      [](const std::string& name) {
        const ServiceType& type = listed_service(name);
        return py::make_tuple(type.request->name, type.response->name);
      },
      py::arg("type_name"), "Return the names of the request and response types, for encode() and decode().");
  m.def(
      "definition", [](const std::string& name) { return text_of(listed_message(name).definition); },
      py::arg("type_name"), "Return the .msg text, followed by those of nested types.");
  m.def("fields", &fields, py::arg("type_name"), "Return a dict of field name -> type, in the order of the message.");
  m.def("constants", &constants, py::arg("type_name"), "Return a dict of constant name -> value.");
  bind_added_types(m);
}

}  // namespace bubblesim::bindings
