// SPDX-License-Identifier: BSD-3-Clause
// The kinds of sensors with their members, for the reference page.
#include <pybind11/stl.h>

#include <string>

#include "bindings.hpp"
#include "bubblesim/nearest_names.hpp"
#include "bubblesim/sensor_definition.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

std::string type_name(const Member& member) {
  switch (member.type) {
    case MemberType::kFlag:
      return "flag";
    case MemberType::kInteger:
      return "integer";
    case MemberType::kNumber:
      return "number";
    case MemberType::kChoice:
      return joined(member.choices, " or ");
    case MemberType::kText:
      return "text";
    case MemberType::kTexts:
      return "strings";
    case MemberType::kVector:
      return "vector";
    case MemberType::kRotation:
      return "quaternion x, y, z, w";
    case MemberType::kBytes:
      return "uint8 array";
    case MemberType::kIntegers:
      return "int32 array";
    case MemberType::kFloats:
      return "float32 array";
    case MemberType::kNumbers:
      return "float64 array";
    case MemberType::kRecord:
      return member.records.table().name;
    case MemberType::kRecords:
      return (member.records.resize == nullptr ? "three " : "list of ") + member.records.table().name;
  }
  return "";
}

py::dict entry(const std::string& name, const std::string& type, const std::string& unit, const std::string& doc) {
  py::dict dict;
  dict["name"] = name;
  dict["type"] = type;
  dict["unit"] = unit;
  dict["doc"] = doc;
  return dict;
}

py::dict table_dict(const MemberTable& table) {
  py::list members;
  py::list parts;
  for (const Member& member : table.members) {
    if (!member.listed) continue;
    py::dict dict = entry(member.name, type_name(member), member.unit, member.doc);
    dict["limits"] = member.limits;
    members.append(dict);
    if (member.records.table != nullptr) parts.append(table_dict(member.records.table()));
  }
  py::dict dict;
  dict["name"] = table.name;
  dict["doc"] = table.doc;
  dict["members"] = members;
  dict["parts"] = parts;
  return dict;
}

py::list kinds() {
  py::list all;
  for (const SensorDefinition* kind : sensor_definitions()) {
    py::list quantities;
    for (const ReadingQuantity& each : kind->quantities) {
      quantities.append(entry(each.name, "", each.unit, each.doc));
    }
    py::dict dict;
    dict["name"] = kind->name;
    dict["types"] = kind->types;
    dict["of_joint"] = kind->of_joint;
    dict["description"] = table_dict(*kind->description);
    dict["reading"] = table_dict(*kind->reading);
    dict["quantities"] = quantities;
    all.append(dict);
  }
  return all;
}

}  // namespace

void bind_sensor_kinds(py::module_& module) {
  module.def("sensor_kinds", &kinds,
             "Return all kinds of sensors as dicts: names, types in SDFormat, members of descriptions and readings.");
}

}  // namespace bubblesim::bindings
