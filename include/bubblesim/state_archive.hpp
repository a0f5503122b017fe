// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a state. One function of each holder of state, transfer(), both saves and restores it, so that the two
// cannot differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// Appends values to bytes, or sets them from bytes in the same order. `archive(a, b, c)` transfers numbers, enums,
/// vectors, quaternions, poses, strings, and containers of them; other types need a function
/// `void transfer(StateArchive&, Type&)` in their namespace, or a member `void transfer(StateArchive&)`.
class StateArchive {
 public:
  /// Saves to the end of `bytes`.
  explicit StateArchive(std::string& bytes) : saved_(&bytes) {}
  /// Restores from `bytes`, which must outlive the archive.
  explicit StateArchive(std::string_view bytes) : left_(bytes) {}
  explicit StateArchive(const char*) = delete;

  bool restores() const { return saved_ == nullptr; }
  /// What was not restored yet.
  std::string_view left() const { return left_; }

  template <class... Values>
  void operator()(Values&... values) {
    (transfer_one(values), ...);
  }
  /// Throws InvalidInput when fewer than `size` bytes are left.
  void bytes(void* data, std::size_t size);
  /// Transfers the number of elements of a container, each of which takes at least one byte.
  std::size_t count(std::size_t present);
  /// Saves a number that the restoring side must have too. Throws InvalidInput with `what` when it is another.
  void require(std::uint64_t present, const char* what);

 private:
  template <class Value, class = void>
  struct HasTransfer : std::false_type {};
  template <class Value>
  struct HasTransfer<Value, std::void_t<decltype(std::declval<Value&>().transfer(std::declval<StateArchive&>()))>>
      : std::true_type {};

  template <class Value>
  void transfer_one(Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      bytes(&value, sizeof value);
    } else if constexpr (HasTransfer<Value>::value) {
      value.transfer(*this);
    } else {
      transfer(*this, value);
    }
  }

  std::string* saved_ = nullptr;  // null when it restores
  std::string_view left_;
};

void transfer(StateArchive& archive, Vector3& value);
void transfer(StateArchive& archive, Quaternion& value);
void transfer(StateArchive& archive, Pose& value);
void transfer(StateArchive& archive, Twist& value);
void transfer(StateArchive& archive, std::string& value);

template <class Value>
void transfer(StateArchive& archive, std::vector<Value>& values) {
  values.resize(archive.count(values.size()));
  if constexpr (std::is_arithmetic_v<Value>) {
    archive.bytes(values.data(), values.size() * sizeof(Value));
  } else {
    for (Value& value : values) archive(value);
  }
}

template <class Value>
void transfer(StateArchive& archive, std::optional<Value>& value) {
  bool given = value.has_value();
  archive(given);
  if (archive.restores()) value = given ? std::make_optional(Value{}) : std::nullopt;
  if (given) archive(*value);
}

template <class Key, class Value>
void transfer(StateArchive& archive, std::map<Key, Value>& values) {
  const std::size_t count = archive.count(values.size());
  if (!archive.restores()) {
    for (auto& [key, value] : values) {
      Key same = key;
      archive(same, value);
    }
    return;
  }
  values.clear();
  for (std::size_t i = 0; i < count; ++i) {
    Key key{};
    archive(key);
    archive(values[key]);
  }
}

}  // namespace bubblesim
