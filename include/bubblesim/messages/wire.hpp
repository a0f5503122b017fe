// SPDX-License-Identifier: BSD-3-Clause
// Buffers for writing (WireBuffer) and reading (WireView) wire bytes, in the layout of ROS 1 (http://wiki.ros.org/msg)
// or of ROS 2 (CDR: OMG's DDS-XTypes, "PLAIN_CDR"). Little-endian; the code requires a little-endian machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace bubblesim::messages {

enum class Layout : std::uint8_t {
  kPacked,  ///< ROS 1: values follow each other
  kCdr,     ///< ROS 2: each number begins at a multiple of its size; strings end with 0; an empty message is one byte
};

/// A growing byte buffer. It keeps `kPrefix` bytes free in front for the length field of TCPROS, so the bridge can pass
/// the storage to roscpp without copying.
class WireBuffer {
 public:
  static constexpr std::size_t kPrefix = 4;

  WireBuffer() = default;
  WireBuffer(WireBuffer&& other) noexcept;
  WireBuffer& operator=(WireBuffer&& other) noexcept;
  WireBuffer(const WireBuffer&) = delete;
  WireBuffer& operator=(const WireBuffer&) = delete;
  ~WireBuffer() = default;

  /// Begins a message in an empty buffer; without it, the layout is kPacked.
  void begin(Layout layout) { cdr_ = layout == Layout::kCdr; }
  Layout layout() const { return cdr_ ? Layout::kCdr : Layout::kPacked; }

  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    if (cdr_) pad(sizeof(T));
    std::memcpy(extend(sizeof(T)), &value, sizeof(T));
  }
  /// Length and bytes; throws std::length_error for 4 GiB or more.
  void put_string(std::string_view text);
  /// What stands for a message without fields.
  void put_empty() {
    if (cdr_) put(std::uint8_t{0});
  }
  /// For values that extend() writes: puts them at a multiple of `boundary`, a power of two, where the layout wants it.
  void align(std::size_t boundary) {
    if (cdr_) pad(boundary);
  }
  void put_bytes(const void* data, std::size_t size) {
    if (size != 0) std::memcpy(extend(size), data, size);
  }
  /// Appends `size` bytes and returns their address; valid until the next call.
  std::uint8_t* extend(std::size_t size) {
    if (size_ + size > capacity_) grow(size);
    std::uint8_t* place = storage_.get() + size_;
    size_ += size;
    return place;
  }

  /// The message without the prefix; nullptr before the first value.
  const std::uint8_t* data() const { return storage_ ? storage_.get() + kPrefix : nullptr; }
  std::size_t size() const { return storage_ ? size_ - kPrefix : 0; }
  /// Clears the content, keeps the storage.
  void clear() { size_ = kPrefix; }
  /// Returns the storage (prefix first, then size() bytes) and leaves the buffer empty.
  std::unique_ptr<std::uint8_t[]> release();

 private:
  void grow(std::size_t extra);
  void pad(std::size_t boundary) {
    const std::size_t bytes = (kPrefix - size_) & (boundary - 1);
    if (bytes == 0) return;
    for (std::uint8_t* place = extend(bytes); place != storage_.get() + size_; ++place) *place = 0;
  }

  std::unique_ptr<std::uint8_t[]> storage_;
  std::size_t size_ = kPrefix;  // used bytes, including the prefix
  std::size_t capacity_ = 0;
  bool cdr_ = false;
};

/// A message is shorter or longer than its fields.
struct WireError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads bytes that it does not own; throws WireError at their end.
class WireView {
 public:
  WireView(const std::uint8_t* data, std::size_t size) : begin_(data), at_(data), end_(data + size) {}

  /// Begins a message; without it, the layout is kPacked.
  void begin(Layout layout) { cdr_ = layout == Layout::kCdr; }
  Layout layout() const { return cdr_ ? Layout::kCdr : Layout::kPacked; }

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    align(sizeof(T));
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  /// The next `size` bytes; valid as long as the message is.
  const std::uint8_t* take(std::size_t size) {
    if (size > left()) throw_truncated(size);
    const std::uint8_t* place = at_;
    at_ += size;
    return place;
  }
  /// Goes on to a multiple of `boundary`, a power of two, where the layout wants it, but not past the end.
  void align(std::size_t boundary) {
    if (!cdr_) return;
    const std::size_t bytes = static_cast<std::size_t>(begin_ - at_) & (boundary - 1);
    at_ += bytes < left() ? bytes : left();
  }
  /// Goes past what stands for a message without fields; tolerates that it is not there.
  void skip_empty() {
    if (cdr_ && left() > 0) ++at_;
  }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  /// Bytes after the last value that are an error. In CDR there is none: peers pad messages, and those of a newer
  /// version of ROS 2 may have more fields at the end.
  std::size_t surplus() const { return cdr_ ? 0 : left(); }

 private:
  [[noreturn]] void throw_truncated(std::size_t wanted) const;

  const std::uint8_t* begin_;
  const std::uint8_t* at_;
  const std::uint8_t* end_;
  bool cdr_ = false;
};

}  // namespace bubblesim::messages
