// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/messages/wire.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace bubblesim::messages {

WireBuffer::WireBuffer(WireBuffer&& other) noexcept
    : storage_(std::move(other.storage_)),
      size_(std::exchange(other.size_, kPrefix)),
      capacity_(std::exchange(other.capacity_, 0)),
      cdr_(other.cdr_) {}

WireBuffer& WireBuffer::operator=(WireBuffer&& other) noexcept {
  storage_ = std::move(other.storage_);
  size_ = std::exchange(other.size_, kPrefix);
  capacity_ = std::exchange(other.capacity_, 0);
  cdr_ = other.cdr_;
  return *this;
}

void WireBuffer::put_string(std::string_view text) {
  if (text.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("a string of " + std::to_string(text.size()) + " bytes does not fit into a message");
  }
  put(static_cast<std::uint32_t>(text.size() + (cdr_ ? 1 : 0)));
  put_bytes(text.data(), text.size());
  if (cdr_) put(std::uint8_t{0});
}

std::unique_ptr<std::uint8_t[]> WireBuffer::release() {
  if (!storage_) grow(0);  // an empty message also has a prefix
  size_ = kPrefix;
  capacity_ = 0;
  return std::move(storage_);
}

void WireBuffer::grow(std::size_t extra) {
  // Some bytes usually follow a large array (PointCloud2: is_dense); they must not cause another reallocation.
  const std::size_t needed = size_ + extra;
  const std::size_t capacity = std::max(2 * capacity_, needed + needed / 8 + 120);
  // Not make_unique: it would zero the memory first.
  std::unique_ptr<std::uint8_t[]> storage(new std::uint8_t[capacity]);
  if (storage_) std::memcpy(storage.get(), storage_.get(), size_);
  storage_ = std::move(storage);
  capacity_ = capacity;
}

void WireView::throw_truncated(std::size_t wanted) const {
  throw WireError("the message is truncated: expected " + std::to_string(wanted) + " more bytes, found " +
                  std::to_string(left()));
}

}  // namespace bubblesim::messages
