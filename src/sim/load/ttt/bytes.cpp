// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/bytes.hpp"

#include <cmath>
#include <cstring>

namespace bubblesim::ttt {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files are little-endian");

void fail_at(std::size_t offset, const std::string& message) {
  throw FormatError("at byte " + std::to_string(offset) + ": " + message);
}

std::string_view Bytes::take(std::size_t count) {
  if (count > bytes_.size()) {
    fail_at(offset_, "needs " + std::to_string(count) + " bytes, but " + std::to_string(bytes_.size()) +
                         " are left: the file is damaged");
  }
  const std::string_view taken = bytes_.substr(0, count);
  bytes_.remove_prefix(count);
  offset_ += count;
  return taken;
}

template <class Value>
Value Bytes::value() {
  Value result;
  std::memcpy(&result, take(sizeof result).data(), sizeof result);
  return result;
}

std::uint8_t Bytes::u8() { return value<std::uint8_t>(); }
std::uint16_t Bytes::u16() { return value<std::uint16_t>(); }
std::int32_t Bytes::i32() { return value<std::int32_t>(); }
std::uint64_t Bytes::u64() { return value<std::uint64_t>(); }

double Bytes::f32() {
  const std::size_t start = offset_;
  const auto number = value<float>();
  if (!std::isfinite(number)) fail_at(start, "the number is not finite");
  return number;
}

double Bytes::f64() {
  const std::size_t start = offset_;
  const auto number = value<double>();
  if (!std::isfinite(number)) fail_at(start, "the number is not finite");
  return number;
}

std::string Bytes::text() { return std::string(take(count(1))); }

std::size_t Bytes::count(std::size_t size) {
  const std::size_t start = offset_;
  const std::int32_t number = i32();
  if (number < 0 || static_cast<std::size_t>(number) > left() / size) {
    fail_at(start, "counts " + std::to_string(number) + " items, which do not fit into the " + std::to_string(left()) +
                       " bytes left: the file is damaged");
  }
  return static_cast<std::size_t>(number);
}

std::vector<double> Bytes::numbers(std::size_t count, bool are_doubles) {
  std::vector<double> result;
  if (count > left()) fail_at(offset_, "needs " + std::to_string(count) + " numbers, which do not fit");
  result.reserve(count);
  for (std::size_t i = 0; i < count; ++i) result.push_back(are_doubles ? f64() : f32());
  return result;
}

std::vector<double> Bytes::unset_numbers(std::size_t count, bool are_doubles) {
  std::vector<double> result;
  if (count > left()) fail_at(offset_, "needs " + std::to_string(count) + " numbers, which do not fit");
  for (std::size_t i = 0; i < count; ++i) {
    const double number = are_doubles ? value<double>() : value<float>();
    result.push_back(std::isfinite(number) ? number : 0);
  }
  return result;
}

}  // namespace bubblesim::ttt
