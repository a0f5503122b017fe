// SPDX-License-Identifier: BSD-3-Clause
// Reads CBOR (RFC 8949) from an unknown client: numbers, strings, bytes, lists, maps, null, booleans. Does not depend
// on Python.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace bubblesim::bindings {

/// The data are not one value, or one that would cost too much.
class CborError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A number, a string, bytes, or the beginning of a list or a map.
struct CborItem {
  enum class Kind { kUnsigned, kNegative, kReal, kBytes, kText, kList, kMap, kFalse, kTrue, kNull, kBreak };
  static constexpr std::uint64_t kUntilBreak = ~std::uint64_t{0};

  Kind kind = Kind::kNull;
  /// An unsigned integer; -1 minus a negative one; the number of items of a list or of pairs of a map, or kUntilBreak.
  std::uint64_t argument = 0;
  double real = 0;
  /// Of a string or bytes, part of the data that are read.
  std::string_view bytes;
};

/// Reads one item after the other.
class CborReader {
 public:
  explicit CborReader(std::string_view data) : data_(data) {}

  /// Throws CborError for tagged values, strings in pieces, and data that end early.
  CborItem next();

  bool at_end() const { return place_ == data_.size(); }

 private:
  std::string_view take(std::uint64_t size);
  std::uint64_t argument(unsigned detail);
  CborItem counted(CborItem::Kind kind, unsigned detail);
  CborItem simple(unsigned detail);

  const std::string_view data_;
  std::size_t place_ = 0;
};

/// Throws CborError unless the data are one value with at most 32 levels, 200,000 items, 4,096 pairs in a map, 1,000
/// keys that are no strings, and 4 MiB of strings. So the time to decode them is limited, too: strings are hashed with
/// a secret, but a client can choose integers that all collide in a dict of Python.
void check_cbor(std::string_view data);

}  // namespace bubblesim::bindings
