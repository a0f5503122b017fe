// SPDX-License-Identifier: BSD-3-Clause
// A list of tagged items: a tag of three characters, an int32 length, and as many bytes. EOO and EOF end a list, NXT
// the first half of an object; they have no length.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/math.hpp"
#include "load/ttt/bytes.hpp"

namespace bubblesim::ttt {

struct Item {
  std::string_view tag;
  Bytes content;
};

/// The items of one list, up to its end marker. Many numbers may be in a file twice, as floats and as doubles under
/// another tag: the functions that take two tags prefer the doubles. An empty tag stands for none.
/// An item that is too short or has impossible numbers throws FormatError; if the bytes note damage, that is noted, and
/// the item counts as missing. Those that return Bytes leave it to their caller.
class TagList {
 public:
  /// Takes one list from the bytes; a list may also end with them. Throws FormatError; if the bytes note damage, that
  /// is noted, and the list ends before it.
  explicit TagList(Bytes& bytes);
  TagList() = default;

  const std::vector<Item>& items() const { return items_; }
  /// Where damage is noted; null: it is thrown.
  Damage* damage() const { return damage_; }
  bool has(std::string_view tag) const { return find(tag) != nullptr; }
  /// The content of the first item of that tag, at its start; nothing if there is none.
  std::optional<Bytes> item(std::string_view tag) const;
  /// Where the numbers begin that a function with two tags returns.
  std::size_t offset_of(std::string_view floats, std::string_view doubles) const;
  /// An item that is a list; empty if there is none.
  TagList list(std::string_view tag) const;

  std::optional<int> integer(std::string_view tag) const;
  int integer(std::string_view tag, int otherwise) const { return integer(tag).value_or(otherwise); }
  std::optional<unsigned> u8(std::string_view tag) const;
  std::optional<unsigned> u16(std::string_view tag) const;
  std::optional<std::string> text(std::string_view tag) const;
  /// Exactly `count` numbers; empty if there is none.
  std::vector<double> numbers(std::string_view floats, std::string_view doubles, std::size_t count) const;
  std::optional<double> number(std::string_view floats, std::string_view doubles) const;
  /// w x y z.
  std::optional<Quaternion> rotation(std::string_view floats, std::string_view doubles) const;
  /// w x y z and then x y z.
  std::optional<Pose> rotation_first(std::string_view floats, std::string_view doubles) const;
  /// x y z and then w x y z.
  std::optional<Pose> position_first(std::string_view floats, std::string_view doubles) const;
  /// A block of engine parameters: its numbers, without its integers.
  std::vector<double> block(std::string_view floats, std::string_view doubles) const;

 private:
  const Item* find(std::string_view tag) const;
  template <class Value, class Read>
  std::optional<Value> read(std::string_view tag, const Read& read_value) const;

  std::vector<Item> items_;
  Damage* damage_ = nullptr;
};

/// A rotation of unit length. Throws FormatError for zero.
Quaternion unit_rotation(double w, double x, double y, double z, std::size_t offset);
/// Seven numbers, x y z and then w x y z.
Pose pose_of(const std::vector<double>& numbers, std::size_t offset);

}  // namespace bubblesim::ttt
