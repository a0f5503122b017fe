// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sensor_view.hpp"

#include <string>

#include "bubblesim/sensor_definition.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

struct AsScalar {
  py::object operator()(bool value) const { return py::bool_(value); }
  py::object operator()(int value) const { return py::int_(value); }
  py::object operator()(double value) const { return py::float_(value); }
  py::object operator()(const std::string& value) const { return py::str(value); }
  template <class Array>
  py::object operator()(const Array&) const {
    return py::none();
  }
};

/// Numbers, choices and computed strings; None for other members.
py::object scalar(const Member& member, const void* record) {
  if (!member.is_stored()) return std::visit(AsScalar{}, member.compute(record));
  switch (member.type) {
    case MemberType::kInteger:
      return py::int_(*static_cast<const std::int32_t*>(member.get(record)));
    case MemberType::kNumber:
      return py::float_(*static_cast<const double*>(member.get(record)));
    case MemberType::kChoice:
      return py::str(choice_of(member, record));
    default:
      return py::none();
  }
}

}  // namespace

py::dict sensor_parameters(const SensorKind& kind) {
  py::dict dict;
  dict["kind"] = definition_of(kind).id;
  for (const Member& member : kind.table()->members) {
    const py::object value = scalar(member, kind.data());
    if (!value.is_none()) dict[member.name.c_str()] = value;
  }
  return dict;
}

}  // namespace bubblesim::bindings
