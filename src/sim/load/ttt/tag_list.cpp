// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/tag_list.hpp"

namespace bubblesim::ttt {
namespace {

constexpr std::size_t kTag = 3;

bool is_tag(std::string_view tag) {
  for (const char sign : tag) {
    if (sign < '!' || sign > '~') return false;
  }
  return true;
}

}  // namespace

TagList::TagList(Bytes& bytes) {
  while (bytes.left() > 0) {
    const std::size_t start = bytes.offset();
    Item item;
    item.tag = bytes.take(kTag);
    if (!is_tag(item.tag)) fail_at(start, "expected a tag of three characters: the file is damaged");
    if (item.tag == "EOO" || item.tag == "NXT" || item.tag == "EOF") return;
    const std::size_t length = bytes.count(1);
    const std::size_t content = bytes.offset();
    item.content = Bytes(bytes.take(length), content);
    items_.push_back(item);
  }
}

const Item* TagList::find(std::string_view tag) const {
  for (const Item& item : items_) {
    if (item.tag == tag) return &item;
  }
  return nullptr;
}

std::optional<Bytes> TagList::item(std::string_view tag) const {
  const Item* found = find(tag);
  return found == nullptr ? std::nullopt : std::make_optional(found->content);
}

std::size_t TagList::offset_of(std::string_view floats, std::string_view doubles) const {
  return item(has(doubles) ? doubles : floats)->offset();
}

TagList TagList::list(std::string_view tag) const {
  auto bytes = item(tag);
  return bytes ? TagList(*bytes) : TagList();
}

std::optional<int> TagList::integer(std::string_view tag) const {
  auto bytes = item(tag);
  return bytes ? std::make_optional(bytes->i32()) : std::nullopt;
}

std::optional<unsigned> TagList::u8(std::string_view tag) const {
  auto bytes = item(tag);
  return bytes ? std::make_optional<unsigned>(bytes->u8()) : std::nullopt;
}

std::optional<unsigned> TagList::u16(std::string_view tag) const {
  auto bytes = item(tag);
  return bytes ? std::make_optional<unsigned>(bytes->u16()) : std::nullopt;
}

std::optional<std::string> TagList::text(std::string_view tag) const {
  auto bytes = item(tag);
  return bytes ? std::make_optional(bytes->text()) : std::nullopt;
}

std::vector<double> TagList::numbers(std::string_view floats, std::string_view doubles, std::size_t count) const {
  if (auto bytes = item(doubles)) return bytes->numbers(count, true);
  if (auto bytes = item(floats)) return bytes->numbers(count, false);
  return {};
}

std::optional<double> TagList::number(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> found = numbers(floats, doubles, 1);
  return found.empty() ? std::nullopt : std::make_optional(found.front());
}

std::optional<Pose> TagList::rotation_first(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> n = numbers(floats, doubles, 7);
  if (n.empty()) return std::nullopt;
  return Pose(Vector3(n[4], n[5], n[6]), unit_rotation(n[0], n[1], n[2], n[3], offset_of(floats, doubles)));
}

std::optional<Pose> TagList::position_first(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> n = numbers(floats, doubles, 7);
  if (n.empty()) return std::nullopt;
  return pose_of(n, offset_of(floats, doubles));
}

std::vector<double> TagList::block(std::string_view floats, std::string_view doubles) const {
  const bool are_doubles = has(doubles);
  auto bytes = item(are_doubles ? doubles : floats);
  if (!bytes) return {};
  const std::size_t count = bytes->count(are_doubles ? sizeof(double) : sizeof(float));
  bytes->i32();
  return bytes->numbers(count, are_doubles);
}

Quaternion unit_rotation(double w, double x, double y, double z, std::size_t offset) {
  const Quaternion rotation(w, x, y, z);
  const double norm = rotation.norm();
  if (!(norm > 1e-9) || !std::isfinite(norm)) fail_at(offset, "the quaternion is zero: the file is damaged");
  return Quaternion(w / norm, x / norm, y / norm, z / norm);
}

Pose pose_of(const std::vector<double>& numbers, std::size_t offset) {
  return Pose(Vector3(numbers[0], numbers[1], numbers[2]),
              unit_rotation(numbers[3], numbers[4], numbers[5], numbers[6], offset));
}

}  // namespace bubblesim::ttt
