// SPDX-License-Identifier: BSD-3-Clause
// Numbers and strings from a range of bytes, little-endian, never beyond its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bubblesim::ttt {

/// A file cannot be read. The message states what is wrong and at which byte.
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws a FormatError: `offset` counts bytes of the unpacked content, or of the file for its header.
[[noreturn]] void fail_at(std::size_t offset, const std::string& message);

/// What is wrong in a file that is read nevertheless: messages of FormatErrors.
using Damage = std::vector<std::string>;

/// Calls `read`. Its FormatError becomes an entry of `damage`, or is passed on if that is null.
template <class Read>
void note_damage(Damage* damage, const Read& read) {
  try {
    read();
  } catch (const FormatError& error) {
    if (damage == nullptr) throw;
    damage->emplace_back(error.what());
  }
}

/// Reads a range of bytes from front to back; the bytes must outlive it. Each function throws FormatError when the
/// range ends before the value does.
class Bytes {
 public:
  Bytes() = default;
  /// `offset`: of the first byte, for errors. `damage`: where lists made of these bytes note what is wrong in them.
  explicit Bytes(std::string_view bytes, std::size_t offset = 0, Damage* damage = nullptr)
      : bytes_(bytes), offset_(offset), damage_(damage) {}

  std::size_t left() const { return bytes_.size(); }
  std::size_t offset() const { return offset_; }
  Damage* damage() const { return damage_; }
  /// The same bytes, of which lists note damage instead of throwing.
  Bytes noting(Damage& damage) const { return Bytes(bytes_, offset_, &damage); }

  std::string_view take(std::size_t count);
  std::uint8_t u8();
  std::uint16_t u16();
  std::int32_t i32();
  std::uint64_t u64();
  /// Finite numbers; others are refused.
  double f32();
  double f64();
  /// An int32 length and as many bytes.
  std::string text();
  /// An int32 that counts items of at least `size` bytes each, which must be in what is left.
  std::size_t count(std::size_t size);
  /// `count` numbers of four or eight bytes.
  std::vector<double> numbers(std::size_t count, bool are_doubles);
  /// Like numbers(), with 0 for those that are not finite: some items leave what they do not use unset.
  std::vector<double> unset_numbers(std::size_t count, bool are_doubles);

 private:
  template <class Value>
  Value value();

  std::string_view bytes_;
  std::size_t offset_ = 0;
  Damage* damage_ = nullptr;
};

}  // namespace bubblesim::ttt
