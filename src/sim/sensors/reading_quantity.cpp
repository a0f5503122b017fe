// SPDX-License-Identifier: BSD-3-Clause
// The members of readings as quantities of batches.
#include <stdexcept>

#include "bubblesim/sensor_definition.hpp"

namespace bubblesim {
namespace {

Sizes shape_of(const Member& member) {
  switch (member.type) {
    case MemberType::kFlag:
    case MemberType::kInteger:
    case MemberType::kNumber:
    case MemberType::kChoice:
      return {};
    case MemberType::kVector:
      return {3};
    case MemberType::kRotation:
      return {4};
    default:
      throw std::logic_error("the member " + member.name + " has no fixed size: add its quantity with observe()");
  }
}

template <class Value>
const Value& value_of(const Member& member, const Measurement& measurement) {
  return *static_cast<const Value*>(member.get(measurement.data()));
}

void put_member(const Member& member, const Measurement& measured, Row& row) {
  switch (member.type) {
    case MemberType::kFlag:
      return row.put(value_of<bool>(member, measured) ? 1 : 0);
    case MemberType::kInteger:
    case MemberType::kChoice:
      return row.put(value_of<std::int32_t>(member, measured));
    case MemberType::kVector:
      return row.put(value_of<Vector3>(member, measured));
    case MemberType::kRotation:
      return row.put(value_of<Quaternion>(member, measured));
    default:
      return row.put(value_of<double>(member, measured));
  }
}

}  // namespace

ReadingQuantity quantity_of(const Member& member) {
  ReadingQuantity quantity;
  quantity.name = member.quantity;
  quantity.unit = member.unit;
  quantity.doc = member.doc;
  quantity.shape = [shape = shape_of(member)](const SensorKind&) { return std::make_optional(shape); };
  const Member* of = &member;  // the table of a reading is never destroyed before the kind
  quantity.put = [of](const Measurement& measured, const World&, ObjectId, Row& row) {
    put_member(*of, measured, row);
  };
  return quantity;
}

}  // namespace bubblesim
