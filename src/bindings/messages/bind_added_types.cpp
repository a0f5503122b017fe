// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.messages: functions by which python/bubblesim/messages adds types that are not listed.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/messages/registry.hpp"
#include "message_codec.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
using messages::ArrayKind;
using messages::Constant;
using messages::Field;
using messages::FieldKind;
using messages::MessageType;
using messages::RosVersion;

/// name; kind or name of a message; whether it is an array; its length if fixed; its bounds as an array and as a
/// string, and its default: see messages::Field
using FieldTuple = std::tuple<std::string, std::string, bool, std::optional<std::uint32_t>,
                              std::pair<std::uint32_t, std::uint32_t>, py::bytes>;
/// name, kind, value; strings are bytes
using ConstantTuple = std::tuple<std::string, std::string, py::object>;
/// name, type hash, definition, has_header, fields, constants
using MessageTuple =
    std::tuple<std::string, std::string, py::bytes, bool, std::vector<FieldTuple>, std::vector<ConstantTuple>>;

Field make_field(const FieldTuple& tuple, RosVersion version) {
  const auto& [name, type, is_array, length, bounds, default_value] = tuple;
  Field field;
  field.name = name;
  field.array = !is_array ? ArrayKind::kNone : length ? ArrayKind::kFixed : ArrayKind::kVariable;
  field.fixed_length = length.value_or(0);
  std::tie(field.bound, field.string_bound) = bounds;
  field.default_value = std::string(default_value);
  if (type.find('/') == type.npos) {
    field.kind = messages::kind_of(type);
    return field;
  }
  field.kind = FieldKind::kMessage;
  field.message = messages::find_message(type, version);
  if (field.message == nullptr) throw std::invalid_argument(type + " must be added before the types that contain it");
  return field;
}

Constant make_constant(const ConstantTuple& tuple) {
  const auto& [name, kind, value] = tuple;
  switch (messages::kind_of(kind)) {
    case FieldKind::kString:
      return {name, value.cast<std::string>()};
    case FieldKind::kBool:
      return {name, value.cast<bool>()};
    case FieldKind::kFloat32:
    case FieldKind::kFloat64:
      return {name, value.cast<double>()};
    case FieldKind::kUint64:
      return {name, value.cast<std::uint64_t>()};
    default:
      return {name, value.cast<std::int64_t>()};
  }
}

MessageType make_type(const MessageTuple& tuple, RosVersion version) {
  const auto& [name, type_hash, definition, has_header, fields, constants] = tuple;
  MessageType type{name, type_hash, definition, has_header, {}, {}, version};
  for (const FieldTuple& field : fields) type.fields.push_back(make_field(field, version));
  for (const ConstantTuple& constant : constants) type.constants.push_back(make_constant(constant));
  return type;
}

void add_message(const MessageTuple& message, RosVersion version) {
  messages::add_message(make_type(message, version));
}

void add_service(const std::string& name, const std::string& type_hash, const MessageTuple& request,
                 const MessageTuple& response, RosVersion version) {
  messages::add_service(name, type_hash, make_type(request, version), make_type(response, version));
}

}  // namespace

void bind_added_types(py::module_& m) {
  m.def("add_message", &add_message, py::arg("message"), py::arg("version") = RosVersion::kRos1,
        "Add a message type that is not listed, after the types that it contains. The message is a tuple (name, type "
        "hash, definition as bytes, has_header, fields, constants), with fields (name, kind or package/Type, is_array, "
        "length or None, bytes of the default or b'') and constants (name, kind, value). Raise ValueError if another "
        "type has that name.");
  m.def("add_service", &add_service, py::arg("name"), py::arg("type_hash"), py::arg("request"), py::arg("response"),
        py::arg("version") = RosVersion::kRos1,
        "Add a service type; its request and response are tuples as in add_message.");
}

}  // namespace bubblesim::bindings
