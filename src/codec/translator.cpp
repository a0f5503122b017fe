// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/messages/translator.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "bubblesim/messages/numbers.hpp"

namespace bubblesim::messages {
namespace {

/// Elements without content cost the sender four bytes for any number of them.
constexpr std::uint32_t kMostEmptyElements = 1U << 16U;

bool is_same_name(const std::string& one, const std::string& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

/// Whether the bytes of a value are those of the other kind: `byte` is signed in ROS 1, unsigned in ROS 2.
bool has_same_bytes(FieldKind one, FieldKind other) {
  if (one == other) return true;
  const auto is_byte = [](FieldKind kind) { return kind == FieldKind::kInt8 || kind == FieldKind::kUint8; };
  const auto is_time = [](FieldKind kind) { return kind == FieldKind::kTime || kind == FieldKind::kDuration; };
  return (is_byte(one) && is_byte(other)) || (is_time(one) && is_time(other));
}

void check(const MessageType& from, const MessageType& to, const std::string& path);

void check(const Field& from, const Field& to, const std::string& path) {
  const bool fits =
      has_same_bytes(from.kind, to.kind) && (from.array == ArrayKind::kNone) == (to.array == ArrayKind::kNone);
  if (!fits) {
    throw std::invalid_argument(path + " is a " + type_text(from) + " on one side, a " + type_text(to) +
                                " on the other");
  }
  if (from.kind == FieldKind::kMessage) check(*from.message, *to.message, path + ".");
}

/// Fields in both types must have the same order, in which they are written.
void check(const MessageType& from, const MessageType& to, const std::string& path) {
  std::size_t next = 0;
  for (const Field& field : from.fields) {
    const auto same = [&field](const Field& other) { return is_same_name(field.name, other.name); };
    const auto found = std::find_if(to.fields.begin(), to.fields.end(), same);
    if (found == to.fields.end()) continue;
    const auto place = static_cast<std::size_t>(found - to.fields.begin());
    if (place < next) throw std::invalid_argument(path + field.name + " has another place on the other side");
    next = place + 1;
    check(field, *found, path + field.name);
  }
}

/// Copies one message.
class Copy {
 public:
  Copy(WireView& in, WireBuffer& out) : in_(in), out_(out) {}

  void message(const MessageType& from, const MessageType& to) {
    if (from.fields.empty()) in_.skip_empty();
    if (to.fields.empty()) out_.put_empty();
    auto next = to.fields.begin();
    for (const Field& field : from.fields) {
      const auto same = [&field](const Field& other) { return is_same_name(field.name, other.name); };
      const auto found = std::find_if(next, to.fields.end(), same);
      if (found == to.fields.end()) {
        skip(field);
        continue;
      }
      for (; next != found; ++next) put_default(*next, out_);
      this->field(field, *next++);
    }
    for (; next != to.fields.end(); ++next) put_default(*next, out_);
  }

 private:
  void field(const Field& from, const Field& to) {
    if (from.array == ArrayKind::kNone) {
      elements(from, to, 1);
      return;
    }
    const std::uint32_t count = from.array == ArrayKind::kFixed ? from.fixed_length : in_.get<std::uint32_t>();
    check_count(from, to, count);
    if (to.array == ArrayKind::kVariable) out_.put(count);
    if (count != 0) elements(from, to, count);
  }

  void check_count(const Field& from, const Field& to, std::uint32_t count) const {
    const std::size_t least = minimum_element_size(from);
    if (count * least > in_.left() || (least == 0 && count > kMostEmptyElements)) {
      throw WireError("the message is truncated: " + from.name + " has " + std::to_string(count) + " elements");
    }
    if (to.array == ArrayKind::kFixed && count != to.fixed_length) {
      throw WireError(from.name + " has " + std::to_string(count) + " elements, not " +
                      std::to_string(to.fixed_length));
    }
  }

  void elements(const Field& from, const Field& to, std::uint32_t count) {
    if (from.kind == FieldKind::kMessage) {
      for (std::uint32_t i = 0; i < count; ++i) message(*from.message, *to.message);
    } else if (from.kind == FieldKind::kString) {
      for (std::uint32_t i = 0; i < count; ++i) string();
    } else {
      in_.align(alignment(from.kind));
      out_.align(alignment(to.kind));
      const std::size_t size = count * std::size_t{wire_size(from.kind)};
      out_.put_bytes(in_.take(size), size);
    }
  }

  void string() {
    std::size_t size = in_.get<std::uint32_t>();
    const auto* letters = reinterpret_cast<const char*>(in_.take(size));
    if (in_.layout() == Layout::kCdr && size > 0 && letters[size - 1] == '\0') --size;
    out_.put_string({letters, size});
  }

  void skip(const Field& field) {
    WireBuffer unused;
    Copy(in_, unused).field(field, field);
  }

  WireView& in_;
  WireBuffer& out_;
};

}  // namespace

Translator::Translator(const MessageType& from, const MessageType& to) : from_(from), to_(to) {
  check(from, to, from.name + ": ");
}

WireBuffer Translator::translate(WireView message) const {
  message.begin(layout_of(from_.version));
  WireBuffer translated;
  translated.begin(layout_of(to_.version));
  Copy(message, translated).message(from_, to_);
  if (message.surplus() != 0) throw WireError(std::to_string(message.left()) + " surplus bytes after the last field");
  return translated;
}

}  // namespace bubblesim::messages
