// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/mesh_data.hpp"

namespace bubblesim::ttt {
namespace {

std::shared_ptr<const Vertices> read_vertices(Bytes bytes) {
  constexpr std::size_t kVertex = 3 * sizeof(float);
  if (bytes.left() % kVertex != 0) fail_at(bytes.offset(), "the length is no multiple of that of a vertex");
  auto vertices = std::make_shared<Vertices>(bytes.left() / kVertex);
  for (auto& vertex : *vertices) {
    for (float& number : vertex) number = static_cast<float>(bytes.f32());
  }
  return vertices;
}

std::shared_ptr<const Triangles> read_triangles(Bytes bytes) {
  constexpr std::size_t kTriangle = 3 * sizeof(std::int32_t);
  if (bytes.left() % kTriangle != 0) fail_at(bytes.offset(), "the length is no multiple of that of a triangle");
  auto triangles = std::make_shared<Triangles>(bytes.left() / kTriangle);
  for (auto& triangle : *triangles) {
    for (std::uint32_t& corner : triangle) corner = static_cast<std::uint32_t>(bytes.i32());
  }
  return triangles;
}

/// The difference of two indices, in one to four bytes: the two high bits of the first count the others.
std::int64_t read_difference(Bytes& bytes) {
  constexpr std::int64_t kBias[] = {31, 8191, 2097151, 536870911};
  const unsigned first = bytes.u8();
  const unsigned others = first >> 6U;
  std::int64_t value = first & 0x3fU;
  for (unsigned i = 0; i < others; ++i) value |= static_cast<std::int64_t>(bytes.u8()) << (6 + 8 * i);
  return value - kBias[others];
}

std::shared_ptr<const Triangles> read_packed_triangles(Bytes bytes) {
  const std::size_t start = bytes.offset();
  const std::size_t count = bytes.count(1);
  if (count % 3 != 0) fail_at(start, "the number of indices is no multiple of 3");
  auto triangles = std::make_shared<Triangles>(count / 3);
  std::int64_t index = 0;
  for (auto& triangle : *triangles) {
    for (std::uint32_t& corner : triangle) {
      index += read_difference(bytes);
      if (index < 0 || index > INT32_MAX) fail_at(bytes.offset(), "the index of a vertex is out of range");
      corner = static_cast<std::uint32_t>(index);
    }
  }
  return triangles;
}

}  // namespace

void MeshData::add(const TagList& list) {
  // A damaged array is an empty one: those after it keep their numbers.
  for (const Item& item : list.items()) {
    if (item.tag == "Ver") {
      vertices.push_back(std::make_shared<const Vertices>());
      note_damage(list.damage(), [&] { vertices.back() = read_vertices(item.content); });
    }
    if (item.tag == "Ind" || item.tag == "In2") {
      triangles.push_back(std::make_shared<const Triangles>());
      note_damage(list.damage(), [&] {
        triangles.back() = item.tag == "Ind" ? read_triangles(item.content) : read_packed_triangles(item.content);
      });
    }
  }
}

}  // namespace bubblesim::ttt
