// SPDX-License-Identifier: BSD-3-Clause
// Structs whose members are listed once, with name, unit and a line of documentation. Hashes, snapshots, checks, the
// quantities of batches, the Python classes and the reference pages read that list (docs/adr/0037).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim {

struct MemberTable;

/// What a member is. The set of types is closed, that of structs is open.
enum class MemberType {
  kFlag,      ///< bool
  kInteger,   ///< std::int32_t, also the handle of an object
  kNumber,    ///< double
  kChoice,    ///< an enum of 32 bits, whose names are Member::choices
  kText,      ///< std::string
  kTexts,     ///< std::vector<std::string>
  kVector,    ///< Vector3
  kRotation,  ///< Quaternion
  kBytes,     ///< std::vector<std::uint8_t>
  kIntegers,  ///< std::vector<std::int32_t>
  kFloats,    ///< std::vector<float>
  kNumbers,   ///< std::vector<double>
  kRecord,    ///< a struct with a table of its own
  kRecords,   ///< a std::array or std::vector of such structs
};

using Sizes = std::vector<std::size_t>;

/// A value that follows from the members of a struct.
using ComputedValue =
    std::variant<bool, int, double, std::string, Vector3, std::vector<double>, std::vector<std::array<float, 3>>>;

/// The structs in a member of type kRecord (one) or kRecords.
struct RecordList {
  const MemberTable& (*table)() = nullptr;
  std::size_t (*size)(const void* list) = nullptr;
  void (*resize)(void* list, std::size_t size) = nullptr;  ///< null: the size is fixed
  const void* (*at)(const void* list, std::size_t i) = nullptr;
};

struct Member {
  std::string name;  ///< in Python and in the reference page
  std::string unit;  ///< empty: none
  std::string doc;   ///< one line, without a full stop
  MemberType type = MemberType::kNumber;
  /// The address of the member in a struct; null for a computed one, which is neither hashed nor saved.
  const void* (*get)(const void* record) = nullptr;
  std::function<ComputedValue(const void* record)> compute;

  RecordList records;                              ///< of kRecord and kRecords
  std::vector<std::string> choices;                ///< of kChoice, in the order of its values
  std::function<Sizes(const void* record)> shape;  ///< of an array that has more than one dimension
  bool none_when_empty = false;                    ///< Python has None for an empty array
  bool listed = true;                              ///< in the reference page
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  std::string limits;    ///< `least` and `most` in words; empty: any number
  std::string title;     ///< in the message about a wrong value: "the noise's mean"
  std::string quantity;  ///< its name in batches; empty: none

  bool is_stored() const { return get != nullptr; }
  void* set(void* record) const { return const_cast<void*>(get(record)); }

  Member with_choices(std::vector<std::string> names) &&;
  Member with_limits(double lowest, double highest, std::string in_words) &&;
  Member with_title(std::string words) &&;
  /// A batch can observe it; only for members of a fixed size. The quantities that SensorDefinition::observe() adds can
  /// have another size for each sensor.
  Member with_quantity(std::string quantity_name) &&;
  template <class Struct>
  Member with_shape(Sizes (*of)(const Struct&)) && {
    shape = [of](const void* record) { return of(*static_cast<const Struct*>(record)); };
    return std::move(*this);
  }
  Member or_none() &&;
  Member unlisted() &&;
};

/// The name of the value of a stored member of type kChoice.
const std::string& choice_of(const Member& member, const void* record);

/// How to hold a struct without knowing its type.
struct RecordOperations {
  std::size_t size = 0;
  std::size_t alignment = 0;
  void (*copy)(void* to, const void* from) = nullptr;    ///< constructs
  void (*move)(void* to, void* from) = nullptr;          ///< constructs
  void (*assign)(void* to, const void* from) = nullptr;  ///< keeps the memory of arrays
  void (*destroy)(void* record) = nullptr;
};

/// The list of a struct. A struct returns its own from `static const MemberTable& members()`, always the same object:
/// its address identifies the type.
struct MemberTable {
  std::string name;  ///< the name of the struct, which is that of its Python class
  std::string doc;   ///< of the Python class
  std::vector<Member> members;
  RecordOperations operations;

  /// Null when there is no such member.
  const Member* find(const std::string& member_name) const;
};

template <class Struct, class = void>
struct HasMembers : std::false_type {};
template <class Struct>
struct HasMembers<Struct, std::void_t<decltype(Struct::members())>>
    : std::is_same<decltype(Struct::members()), const MemberTable&> {};

namespace member_detail {

template <class Struct, class Value>
Struct struct_of(Value Struct::*);
template <class Struct, class Value>
Value value_of(Value Struct::*);

template <class Value, class = void>
struct Elements {
  using Type = void;
};
template <class Value>
struct Elements<std::vector<Value>, std::enable_if_t<HasMembers<Value>::value>> {
  using Type = Value;
  static constexpr bool kFixed = false;
};
template <class Value, std::size_t kCount>
struct Elements<std::array<Value, kCount>, std::enable_if_t<HasMembers<Value>::value>> {
  using Type = Value;
  static constexpr bool kFixed = true;
};

template <class Value>
constexpr MemberType type_of() {
  if constexpr (std::is_same_v<Value, bool>) {
    return MemberType::kFlag;
  } else if constexpr (std::is_same_v<Value, std::int32_t>) {
    return MemberType::kInteger;
  } else if constexpr (std::is_same_v<Value, double>) {
    return MemberType::kNumber;
  } else if constexpr (std::is_enum_v<Value> && sizeof(Value) == sizeof(std::int32_t)) {
    return MemberType::kChoice;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return MemberType::kText;
  } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    return MemberType::kTexts;
  } else if constexpr (std::is_same_v<Value, Vector3>) {
    return MemberType::kVector;
  } else if constexpr (std::is_same_v<Value, Quaternion>) {
    return MemberType::kRotation;
  } else if constexpr (std::is_same_v<Value, std::vector<std::uint8_t>>) {
    return MemberType::kBytes;
  } else if constexpr (std::is_same_v<Value, std::vector<std::int32_t>>) {
    return MemberType::kIntegers;
  } else if constexpr (std::is_same_v<Value, std::vector<float>>) {
    return MemberType::kFloats;
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    return MemberType::kNumbers;
  } else if constexpr (HasMembers<Value>::value) {
    return MemberType::kRecord;
  } else {
    static_assert(!std::is_void_v<typename Elements<Value>::Type>, "a member must have one of the types of MemberType");
    return MemberType::kRecords;
  }
}

template <class Value>
RecordList records_of() {
  RecordList list;
  if constexpr (HasMembers<Value>::value) {
    list.table = &Value::members;
    list.size = [](const void*) { return std::size_t{1}; };
    list.at = [](const void* value, std::size_t) { return value; };
  } else if constexpr (!std::is_void_v<typename Elements<Value>::Type>) {
    list.table = &Elements<Value>::Type::members;
    list.size = [](const void* values) { return static_cast<const Value*>(values)->size(); };
    list.at = [](const void* values, std::size_t i) -> const void* { return &(*static_cast<const Value*>(values))[i]; };
    if constexpr (!Elements<Value>::kFixed) {
      list.resize = [](void* values, std::size_t size) { static_cast<Value*>(values)->resize(size); };
    }
  }
  return list;
}

template <class Value>
MemberType type_of_computed() {
  if constexpr (std::is_same_v<Value, std::vector<std::array<float, 3>>>) {
    return MemberType::kFloats;
  } else {
    return type_of<Value>();
  }
}

}  // namespace member_detail

/// A member of a struct: member<&Reading::height>("height", "m", "above the sensor's initial position").
template <auto kMember>
Member member(std::string name, std::string unit, std::string doc) {
  using Struct = decltype(member_detail::struct_of(kMember));
  using Value = decltype(member_detail::value_of(kMember));
  Member made;
  made.name = std::move(name);
  made.unit = std::move(unit);
  made.doc = std::move(doc);
  made.type = member_detail::type_of<Value>();
  made.get = [](const void* record) -> const void* { return &(static_cast<const Struct*>(record)->*kMember); };
  made.records = member_detail::records_of<Value>();
  return made;
}

/// What follows from the members: `compute` takes the struct and returns one of the types of ComputedValue.
template <class Struct, class Compute>
Member computed(std::string name, std::string unit, std::string doc, Compute compute) {
  Member made;
  made.name = std::move(name);
  made.unit = std::move(unit);
  made.doc = std::move(doc);
  made.type = member_detail::type_of_computed<decltype(compute(std::declval<const Struct&>()))>();
  made.compute = [compute](const void* record) { return ComputedValue(compute(*static_cast<const Struct*>(record))); };
  return made;
}

template <class Struct>
MemberTable member_table(std::string name, std::string doc, std::vector<Member> members) {
  MemberTable table;
  table.name = std::move(name);
  table.doc = std::move(doc);
  table.members = std::move(members);
  table.operations.size = sizeof(Struct);
  table.operations.alignment = alignof(Struct);
  table.operations.copy = [](void* to, const void* from) { new (to) Struct(*static_cast<const Struct*>(from)); };
  table.operations.move = [](void* to, void* from) { new (to) Struct(std::move(*static_cast<Struct*>(from))); };
  table.operations.assign = [](void* to, const void* from) {
    *static_cast<Struct*>(to) = *static_cast<const Struct*>(from);
  };
  table.operations.destroy = [](void* record) { static_cast<Struct*>(record)->~Struct(); };
  return table;
}

}  // namespace bubblesim
