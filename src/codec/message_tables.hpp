// SPDX-License-Identifier: BSD-3-Clause
// The form in which meta/generate.py writes message types: constant tables without initialization. The registry turns
// them into MessageType objects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::messages::tables {

/// A constant array and its length.
template <class T>
struct Rows {
  const T* first = nullptr;
  std::size_t count = 0;

  constexpr Rows() = default;
  template <std::size_t N>  // NOLINTNEXTLINE(google-explicit-constructor): implicit from a list of rows
  constexpr Rows(const T (&rows)[N]) : first(rows), count(N) {}

  constexpr const T* begin() const { return first; }
  constexpr const T* end() const { return first + count; }
};

struct FieldRow {
  const char* name;
  FieldKind kind;
  ArrayKind array;
  std::uint32_t fixed_length;
  std::uint32_t bound;             ///< see Field
  std::uint32_t string_bound;      ///< see Field
  const char* message;             ///< name of the nested type, or nullptr
  std::string_view default_value;  ///< see Field
};

struct ConstantRow {
  const char* name;
  FieldKind kind;
  const char* value;  ///< decimal number (bool: 0 or 1), or the text of a string constant
};

struct MessageRow {
  const char* name;
  const char* type_hash;
  bool has_header;
  Rows<FieldRow> fields;
  Rows<ConstantRow> constants;
  const char* definition;
};

struct ServiceRow {
  const char* name;
  const char* type_hash;
  const MessageRow* request;
  const MessageRow* response;
};

struct PackageTable {
  Rows<const MessageRow*> messages;
  Rows<ServiceRow> services;
};

/// Generated: the tables of all packages, nested types' packages included; none of ROS 2 in a build without it.
std::vector<PackageTable> all_packages(RosVersion version);

/// Generated: the types of which ROS 2 had other fields before Iron.
std::vector<PackageTable> packages_before_iron();

}  // namespace bubblesim::messages::tables
