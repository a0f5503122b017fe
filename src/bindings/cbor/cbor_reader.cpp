// SPDX-License-Identifier: BSD-3-Clause
#include "cbor/cbor_reader.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace bubblesim::bindings {
namespace {

using Kind = CborItem::Kind;

constexpr unsigned kIndefinite = 31;
constexpr int kMostLevels = 32;
constexpr std::uint64_t kMostItems = 200'000;  // of points 66,000; about 10 ms
constexpr std::uint64_t kMostPairs = 4096;
constexpr std::uint64_t kMostOtherKeys = 1000;
constexpr std::uint64_t kMostTextBytes = 4 * 1024 * 1024;

enum Major : unsigned { kUnsigned, kNegative, kBytes, kText, kArray, kMap, kTag, kSimple };

/// IEEE 754 binary16, as in RFC 8949, appendix D.
double half(std::uint64_t bits) {
  const auto exponent = static_cast<int>(bits >> 10U & 31U);
  const auto mantissa = static_cast<double>(bits & 1023U);
  double value = 0;
  if (exponent == 0) {
    value = std::ldexp(mantissa, -24);
  } else if (exponent != 31) {
    value = std::ldexp(mantissa + 1024, exponent - 25);
  } else {
    value = mantissa == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  return (bits & 0x8000U) != 0 ? -value : value;
}

template <class Float, class Bits>
double number_of(std::uint64_t bits) {
  const auto narrow = static_cast<Bits>(bits);
  Float value = 0;
  std::memcpy(&value, &narrow, sizeof value);
  return static_cast<double>(value);
}

class Checker {
 public:
  explicit Checker(std::string_view data) : reader_(data) {}

  void check() {
    value(reader_.next(), 0);
    if (!reader_.at_end()) throw CborError("data follows the value");
  }

 private:
  void value(const CborItem& item, int level) {
    if (++items_ > kMostItems) throw CborError("more than 200,000 values; send long lists of numbers as bytes");
    switch (item.kind) {
      case Kind::kText:
        text_bytes_ += item.bytes.size();
        if (text_bytes_ > kMostTextBytes) throw CborError("more than 4 MiB of strings; send data as bytes");
        return;
      case Kind::kList:
        return list(item.argument, level + 1);
      case Kind::kMap:
        return map(item.argument, level + 1);
      case Kind::kBreak:
        throw CborError("a list or a map ends without having begun");
      default:
        return;
    }
  }

  static void check_level(int level) {
    if (level > kMostLevels) throw CborError("more than 32 nested lists and maps");
  }

  void list(std::uint64_t count, int level) {
    check_level(level);
    for (std::uint64_t i = 0; i < count; ++i) {
      const CborItem item = reader_.next();
      if (count == CborItem::kUntilBreak && item.kind == Kind::kBreak) return;
      value(item, level);
    }
  }

  void map(std::uint64_t count, int level) {
    check_level(level);
    for (std::uint64_t i = 0; i < count; ++i) {
      const CborItem key = reader_.next();
      if (count == CborItem::kUntilBreak && key.kind == Kind::kBreak) return;
      if (i == kMostPairs) throw CborError("more than 4,096 entries in a map");
      if (key.kind == Kind::kList || key.kind == Kind::kMap) throw CborError("a list or a map is the key of a map");
      if (key.kind != Kind::kText && ++other_keys_ > kMostOtherKeys) {
        throw CborError("more than 1,000 keys of maps that are no strings");
      }
      value(key, level);
      value(reader_.next(), level);
    }
  }

  CborReader reader_;
  std::uint64_t items_ = 0;
  std::uint64_t other_keys_ = 0;
  std::uint64_t text_bytes_ = 0;
};

}  // namespace

std::string_view CborReader::take(std::uint64_t size) {
  if (size > data_.size() - place_) throw CborError("the data ends early");
  const std::string_view taken = data_.substr(place_, size);
  place_ += size;
  return taken;
}

std::uint64_t CborReader::argument(unsigned detail) {
  if (detail < 24) return detail;
  if (detail == kIndefinite) throw CborError("strings and bytes of unknown length are not supported");
  if (detail > 27) throw CborError("a length is malformed");
  std::uint64_t value = 0;
  for (const char each : take(std::uint64_t{1} << (detail - 24))) {
    value = value << 8U | static_cast<unsigned char>(each);
  }
  return value;
}

CborItem CborReader::counted(Kind kind, unsigned detail) {
  if (detail == kIndefinite) return {kind, CborItem::kUntilBreak, 0, {}};
  const std::uint64_t count = argument(detail);
  if (count > data_.size() - place_) throw CborError("the data ends early");  // each item has at least one byte
  return {kind, count, 0, {}};
}

CborItem CborReader::simple(unsigned detail) {
  switch (detail) {
    case 20:
      return {Kind::kFalse, 0, 0, {}};
    case 21:
      return {Kind::kTrue, 0, 0, {}};
    case 22:  // null
    case 23:  // undefined
      return {};
    case 25:
      return {Kind::kReal, 0, half(argument(detail)), {}};
    case 26:
      return {Kind::kReal, 0, number_of<float, std::uint32_t>(argument(detail)), {}};
    case 27:
      return {Kind::kReal, 0, number_of<double, std::uint64_t>(argument(detail)), {}};
    case kIndefinite:
      return {Kind::kBreak, 0, 0, {}};
    default:
      throw CborError("a simple value is none of false, true and null");
  }
}

CborItem CborReader::next() {
  const auto head = static_cast<unsigned char>(take(1).front());
  const unsigned detail = head & 31U;
  switch (static_cast<Major>(head >> 5U)) {
    case kUnsigned:
      return {Kind::kUnsigned, argument(detail), 0, {}};
    case kNegative:
      return {Kind::kNegative, argument(detail), 0, {}};
    case kBytes:
      return {Kind::kBytes, 0, 0, take(argument(detail))};
    case kText:
      return {Kind::kText, 0, 0, take(argument(detail))};
    case kArray:
      return counted(Kind::kList, detail);
    case kMap:
      return counted(Kind::kMap, detail);
    case kTag:
      throw CborError("tagged values are not supported");
    case kSimple:
      break;
  }
  return simple(detail);
}

void check_cbor(std::string_view data) { Checker(data).check(); }

}  // namespace bubblesim::bindings
