// SPDX-License-Identifier: BSD-3-Clause
// Checks CBOR (RFC 8949) from strangers before a decoder allocates what it promises.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bindings.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

constexpr int kDepth = 32;
constexpr std::uint64_t kItems = 4'000'000;  // a table of points; decoding holds up the simulation

enum Major : unsigned { kUnsigned, kNegative, kBytes, kText, kArray, kMap, kTag, kSimple };

/// Walks over one item and all in it. Each function returns false, with the reason, for what is not accepted.
class CborWalk {
 public:
  explicit CborWalk(std::string_view data) : data_(data) {}

  bool item(int depth) {
    if (depth > kDepth) return refuse("more than 32 nested lists and tables");
    if (++items_ > kItems) return refuse("more than four million values");
    if (place_ >= data_.size()) return refuse("the data ends early");
    const auto head = static_cast<unsigned char>(data_[place_++]);
    const auto major = static_cast<Major>(head >> 5U);
    const unsigned detail = head & 31U;
    if (detail == kIndefinite) return indefinite(major, depth);
    const std::optional<std::uint64_t> argument = number(detail);
    if (!argument) return refuse("the data ends early, or a length is malformed");
    switch (major) {
      case kUnsigned:
      case kNegative:
      case kSimple:
        return true;
      case kBytes:
      case kText:
        if (*argument > data_.size() - place_) return refuse("the data ends early");
        place_ += *argument;
        return true;
      case kArray:
        return items(*argument, depth);
      case kMap:
        return *argument <= data_.size() && items(2 * *argument, depth);
      case kTag:
        break;
    }
    return refuse("tagged values are not supported");
  }

  bool at_end() const { return place_ == data_.size(); }
  const std::string& reason() const { return reason_; }

 private:
  static constexpr unsigned kIndefinite = 31;
  static constexpr char kBreak = '\xff';

  bool refuse(const char* why) {
    reason_ = why;
    return false;
  }

  std::optional<std::uint64_t> number(unsigned detail) {
    if (detail < 24) return detail;
    if (detail > 27) return std::nullopt;
    const std::size_t bytes = std::size_t{1} << (detail - 24);
    if (bytes > data_.size() - place_) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value = value << 8U | static_cast<unsigned char>(data_[place_++]);
    return value;
  }

  bool items(std::uint64_t count, int depth) {
    if (count > data_.size() - place_) return refuse("the data ends early");  // each item has at least one byte
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!item(depth + 1)) return false;
    }
    return true;
  }

  bool indefinite(Major major, int depth) {
    if (major != kArray && major != kMap) return refuse("texts and bytes of unknown length are not supported");
    for (std::uint64_t count = 0;; ++count) {
      if (place_ < data_.size() && data_[place_] == kBreak) {
        ++place_;
        return major == kArray || count % 2 == 0 || refuse("a key has no value");
      }
      if (!item(depth + 1)) return false;
    }
  }

  const std::string_view data_;
  std::size_t place_ = 0;
  std::uint64_t items_ = 0;
  std::string reason_ = "the data ends early";
};

std::string cbor_problem(const py::bytes& data) {
  CborWalk walk{std::string_view(data)};
  if (!walk.item(0)) return walk.reason();
  return walk.at_end() ? "" : "data follows the value";
}

}  // namespace

void bind_cbor(py::module_& module) {
  module.def("cbor_problem", &cbor_problem, py::arg("data"),
             "Return why the bytes are not one CBOR value that is safe to decode, or an empty text: numbers, texts,\n"
             "bytes, lists and maps, at most 32 levels, 4 million values, no tags.");
}

}  // namespace bubblesim::bindings
