// SPDX-License-Identifier: BSD-3-Clause
// The custom data of objects, and the points of old paths.
#include <algorithm>

#include "load/ttt/read_objects.hpp"

namespace bubblesim::ttt {
namespace {

constexpr int kByName = 0x153becb4;  // the number under which files of V3.3 to V4.3 have all data that have names

/// Blocks of a size, the length of a name that ends with a zero byte, the name and the data.
void read_blocks(Bytes bytes, std::map<std::string, std::string>& data) {
  constexpr std::size_t kHead = 8;
  while (bytes.left() > 0) {
    const std::size_t start = bytes.offset();
    const int size = bytes.i32();
    const int name_size = bytes.i32();
    if (name_size < 1 || size < name_size || static_cast<std::size_t>(size - name_size) < kHead) {
      fail_at(start, "a block of custom data has an impossible size");
    }
    std::string name(bytes.take(static_cast<std::size_t>(name_size)));
    while (!name.empty() && name.back() == '\0') name.pop_back();
    data[name] = std::string(bytes.take(static_cast<std::size_t>(size - name_size) - kHead));
  }
}

Path::Point read_point(const TagList& list) {
  constexpr int kMostOnCurve = 200;
  const bool are_doubles = list.has("_t2");
  auto bytes = list.item(are_doubles ? "_t2" : "At2");
  if (!bytes) return {};
  const std::size_t start = bytes->offset();
  Path::Point point;
  point.pose = pose_of(bytes->numbers(7, are_doubles), start);
  const std::vector<double> parts = bytes->numbers(2, are_doubles);
  point.before = std::clamp(parts[0], 0.0, 1.0);
  point.after = std::clamp(parts[1], 0.0, 1.0);
  point.count = std::clamp(bytes->i32(), 1, kMostOnCurve);
  return point;
}

}  // namespace

Path read_path(const TagList& list) {
  constexpr unsigned kIsClosed = 4;
  const TagList points = list.list("Ntp");
  Path path;
  path.is_closed = (static_cast<unsigned>(points.integer("At2", 0)) & kIsClosed) != 0;
  for (const Item& item : points.items()) {
    if (item.tag != "Pat") continue;
    note_damage(list.damage(), [&] {
      Bytes bytes = item.content;
      path.points.push_back(read_point(TagList(bytes)));
    });
  }
  return path;
}

std::map<std::string, std::string> read_custom_data(const TagList& common) {
  std::map<std::string, std::string> data;
  const TagList by_number = common.list("Cod");
  for (const Item& item : by_number.items()) {
    if (item.tag != "Dat") continue;
    note_damage(common.damage(), [&] {
      Bytes bytes = item.content;
      const int number = bytes.i32();
      const std::size_t start = bytes.offset() + sizeof(std::int32_t);
      const std::string_view content = bytes.take(bytes.count(1));
      if (number == kByName) {
        read_blocks(Bytes(content, start), data);
      } else {
        data["#" + std::to_string(number)] = std::string(content);  // as sim.getObjectCustomData finds it
      }
    });
  }
  const TagList by_name = common.list("Cda");
  for (const Item& item : by_name.items()) {
    if (item.tag != "Cdt") continue;
    note_damage(common.damage(), [&] {
      Bytes bytes = item.content;
      const std::string name = bytes.text();
      data[name] = std::string(bytes.take(bytes.count(1)));
    });
  }
  return data;
}

}  // namespace bubblesim::ttt
