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

TagList::TagList(Bytes& bytes) : damage_(bytes.damage()) {
  note_damage(damage_, [&] {
    while (bytes.left() > 0) {
      const std::size_t start = bytes.offset();
      Item item;
      item.tag = bytes.take(kTag);
      if (!is_tag(item.tag)) fail_at(start, "expected a tag of three characters: the file is damaged");
      if (item.tag == "EOO" || item.tag == "NXT" || item.tag == "EOF") return;
      const std::size_t length = bytes.count(1);
      const std::size_t content = bytes.offset();
      item.content = Bytes(bytes.take(length), content, damage_);
      items_.push_back(item);
    }
  });
}

template <class Value, class Read>
std::optional<Value> TagList::read(std::string_view tag, const Read& read_value) const {
  std::optional<Value> value;
  if (auto bytes = item(tag)) note_damage(damage_, [&] { value = read_value(*bytes); });
  return value;
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
  return read<int>(tag, [](Bytes& bytes) { return bytes.i32(); });
}

std::optional<unsigned> TagList::u8(std::string_view tag) const {
  return read<unsigned>(tag, [](Bytes& bytes) { return bytes.u8(); });
}

std::optional<unsigned> TagList::u16(std::string_view tag) const {
  return read<unsigned>(tag, [](Bytes& bytes) { return bytes.u16(); });
}

std::optional<std::string> TagList::text(std::string_view tag) const {
  return read<std::string>(tag, [](Bytes& bytes) { return bytes.text(); });
}

std::vector<double> TagList::numbers(std::string_view floats, std::string_view doubles, std::size_t count) const {
  using Numbers = std::vector<double>;
  const bool are_doubles = has(doubles);
  return read<Numbers>(are_doubles ? doubles : floats, [&](Bytes& bytes) { return bytes.numbers(count, are_doubles); })
      .value_or(Numbers());
}

std::optional<double> TagList::number(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> found = numbers(floats, doubles, 1);
  return found.empty() ? std::nullopt : std::make_optional(found.front());
}

std::optional<Quaternion> TagList::rotation(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> n = numbers(floats, doubles, 4);
  std::optional<Quaternion> turn;
  if (n.empty()) return turn;
  note_damage(damage_, [&] { turn = unit_rotation(n[0], n[1], n[2], n[3], offset_of(floats, doubles)); });
  return turn;
}

std::optional<Pose> TagList::rotation_first(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> n = numbers(floats, doubles, 7);
  std::optional<Pose> pose;
  if (n.empty()) return pose;
  note_damage(damage_, [&] { pose = pose_of({n[4], n[5], n[6], n[0], n[1], n[2], n[3]}, offset_of(floats, doubles)); });
  return pose;
}

std::optional<Pose> TagList::position_first(std::string_view floats, std::string_view doubles) const {
  const std::vector<double> n = numbers(floats, doubles, 7);
  std::optional<Pose> pose;
  if (n.empty()) return pose;
  note_damage(damage_, [&] { pose = pose_of(n, offset_of(floats, doubles)); });
  return pose;
}

std::vector<double> TagList::block(std::string_view floats, std::string_view doubles) const {
  using Numbers = std::vector<double>;
  const bool are_doubles = has(doubles);
  const auto read_block = [&](Bytes& bytes) {
    const std::size_t count = bytes.count(are_doubles ? sizeof(double) : sizeof(float));
    bytes.i32();
    return bytes.numbers(count, are_doubles);
  };
  return read<Numbers>(are_doubles ? doubles : floats, read_block).value_or(Numbers());
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
