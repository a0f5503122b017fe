// SPDX-License-Identifier: BSD-3-Clause
// The classes are made with Python's C API: pybind11's classes need a C++ type each, which a table does not have.
#include "sensors/record_class.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

py::handle module_of_classes;  // modules are never unloaded

struct RecordObject {
  PyObject_HEAD;
  std::shared_ptr<const Reading> reading;
  const void* record;  // the reading's, or a part of it
};

RecordObject& of(PyObject* self) { return *reinterpret_cast<RecordObject*>(self); }

py::object make_object(const MemberTable& table, std::shared_ptr<const Reading> reading, const void* record) {
  const py::object type = class_of(table);
  auto* python_type = reinterpret_cast<PyTypeObject*>(type.ptr());
  PyObject* self = python_type->tp_alloc(python_type, 0);
  if (self == nullptr) throw py::error_already_set();
  new (&of(self).reading) std::shared_ptr<const Reading>(std::move(reading));
  of(self).record = record;
  return py::reinterpret_steal<py::object>(self);
}

void deallocate(PyObject* self) {
  PyTypeObject* type = Py_TYPE(self);
  of(self).reading.~shared_ptr();
  type->tp_free(self);
  Py_DECREF(type);
}

struct FromComputed {
  template <class Value>
  py::object operator()(const Value& value) const {
    return py::cast(value);
  }
  py::object operator()(const Vector3& value) const { return to_numpy(value); }
  py::object operator()(const std::vector<double>& values) const {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  }
  py::object operator()(const std::vector<std::array<float, 3>>& points) const {
    const auto count = static_cast<py::ssize_t>(points.size());
    return py::array_t<float>({count, py::ssize_t{3}}, reinterpret_cast<const float*>(points.data()));
  }
};

/// A read-only array on the memory of a member, which `self` keeps alive.
template <class Value>
py::object view(PyObject* self, const Member& member) {
  const RecordObject& object = of(self);
  const auto& values = *static_cast<const std::vector<Value>*>(member.get(object.record));
  if (values.empty() && member.none_when_empty) return py::none();
  std::vector<py::ssize_t> shape;
  if (member.shape != nullptr) {
    for (const std::size_t size : member.shape(object.record)) shape.push_back(static_cast<py::ssize_t>(size));
  } else {
    shape.push_back(static_cast<py::ssize_t>(values.size()));
  }
  py::array array(py::dtype::of<Value>(), std::move(shape), values.data(), py::handle(self));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class Value>
const Value& stored(PyObject* self, const Member& member) {
  return *static_cast<const Value*>(member.get(of(self).record));
}

py::object records(PyObject* self, const Member& member) {
  const void* list = member.get(of(self).record);
  const auto part = [&](std::size_t i) {
    return make_object(member.records.table(), of(self).reading, member.records.at(list, i));
  };
  if (member.type == MemberType::kRecord) return part(0);
  py::list all;
  for (std::size_t i = 0; i < member.records.size(list); ++i) all.append(part(i));
  return all;
}

py::object value_of(PyObject* self, const Member& member) {
  if (!member.is_stored()) return std::visit(FromComputed{}, member.compute(of(self).record));
  switch (member.type) {
    case MemberType::kFlag:
      return py::bool_(stored<bool>(self, member));
    case MemberType::kInteger:
      return py::int_(stored<std::int32_t>(self, member));
    case MemberType::kNumber:
      return py::float_(stored<double>(self, member));
    case MemberType::kChoice:
      return py::str(choice_of(member, of(self).record));
    case MemberType::kText:
      return py::str(stored<std::string>(self, member));
    case MemberType::kTexts:
      return py::cast(stored<std::vector<std::string>>(self, member));
    case MemberType::kVector:
      return to_numpy(stored<Vector3>(self, member));
    case MemberType::kRotation:
      return to_numpy(stored<Quaternion>(self, member));
    case MemberType::kBytes:
      return view<std::uint8_t>(self, member);
    case MemberType::kIntegers:
      return view<std::int32_t>(self, member);
    case MemberType::kFloats:
      return view<float>(self, member);
    case MemberType::kNumbers:
      return view<double>(self, member);
    case MemberType::kRecord:
    case MemberType::kRecords:
      return records(self, member);
  }
  return py::none();
}

PyObject* get_member(PyObject* self, void* member) {
  try {
    return value_of(self, *static_cast<const Member*>(member)).release().ptr();
  } catch (py::error_already_set& error) {
    error.restore();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
  return nullptr;
}

PyObject* get_time(PyObject* self, void*) { return PyFloat_FromDouble(of(self).reading->time); }

bool is_reading(const MemberTable& table) {
  const std::vector<const SensorDefinition*> kinds = sensor_definitions();
  return std::any_of(kinds.begin(), kinds.end(), [&](const auto* kind) { return kind->reading == &table; });
}

/// A class, and the strings that it refers to.
struct RecordClass {
  explicit RecordClass(const MemberTable& table) : name("bubblesim._core." + table.name) {
    docs.reserve(table.members.size());
    if (is_reading(table)) {
      properties.push_back({"time", get_time, nullptr, "Simulated seconds of the state that it shows.", nullptr});
    }
    for (const Member& member : table.members) {
      if (!member.listed) continue;
      docs.push_back(sentence(member));
      properties.push_back(
          {member.name.c_str(), get_member, nullptr, docs.back().c_str(), const_cast<Member*>(&member)});
    }
    properties.push_back({nullptr, nullptr, nullptr, nullptr, nullptr});
    PyType_Slot slots[] = {
        {Py_tp_dealloc, reinterpret_cast<void*>(deallocate)},
        {Py_tp_getset, properties.data()},
        {Py_tp_doc, const_cast<char*>(table.doc.c_str())},
        {0, nullptr},
    };
    PyType_Spec spec = {name.c_str(), sizeof(RecordObject), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
                        slots};
    type = py::reinterpret_steal<py::object>(PyType_FromSpec(&spec));
    if (!type) throw py::error_already_set();
    py::list fields;
    for (const Member& member : table.members) {
      if (member.listed && member.is_stored()) fields.append(member.name);
    }
    type.attr("_fields") = py::tuple(fields);
  }

  /// "Height above the sensor's initial position, m."
  static std::string sentence(const Member& member) {
    std::string text = member.doc + (member.unit.empty() ? "" : ", " + member.unit) + ".";
    if (text.front() >= 'a' && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text;
  }

  std::string name;
  std::vector<std::string> docs;
  std::vector<PyGetSetDef> properties;
  py::object type;
};

}  // namespace

void bind_record_classes(py::module_& core) {
  module_of_classes = core;
  for (const SensorDefinition* kind : sensor_definitions()) class_of(*kind->reading);
}

py::object class_of(const MemberTable& table) {
  // Never freed: objects may outlive the module. The GIL guards it.
  static auto& classes = *new std::map<const MemberTable*, RecordClass>;
  const auto found = classes.find(&table);
  if (found != classes.end()) return found->second.type;
  const py::object type = classes.try_emplace(&table, table).first->second.type;
  module_of_classes.attr(table.name.c_str()) = type;
  for (const Member& member : table.members) {
    if (member.listed && member.records.table != nullptr) class_of(member.records.table());
  }
  return type;
}

py::object to_python(std::shared_ptr<const Reading> reading) {
  const Measurement& measurement = reading->measurement;
  return make_object(*measurement.table(), std::move(reading), measurement.data());
}

bool is_record_of(const py::handle& object, const MemberTable& table) {
  const py::object type = class_of(table);
  return PyObject_TypeCheck(object.ptr(), reinterpret_cast<PyTypeObject*>(type.ptr())) != 0;
}

std::shared_ptr<const Reading> reading_of(const py::handle& object) { return of(object.ptr()).reading; }

const void* record_of(const py::handle& object, const MemberTable& table) {
  if (!is_record_of(object, table)) {
    throw py::type_error("this is " + with_article(Py_TYPE(object.ptr())->tp_name) + ", not " +
                         with_article(table.name));
  }
  return of(object.ptr()).record;
}

}  // namespace bubblesim::bindings
