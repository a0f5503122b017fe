// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/mesh_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "files/file_text.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

namespace fs = std::filesystem;

/// A BMP with 24 bits a pixel: its rows run from the bottom to the top, as those of the image, and are padded to 4
/// bytes.
std::string bitmap(const Image& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  constexpr std::uint32_t kHeaders = 54;
  const std::size_t row = (3 * width + 3) / 4 * 4;
  std::string bytes = "BM";
  const auto number = [&bytes](std::size_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xffU));
  };
  number(kHeaders + row * height, 4);
  number(0, 4);
  number(kHeaders, 4);
  number(40, 4);  // size of the second header
  number(width, 4);
  number(height, 4);
  number(1, 2);
  number(24, 2);  // bits a pixel
  for (int i = 0; i < 6; ++i) number(0, 4);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (const std::size_t channel : {2U, 1U, 0U}) {
        bytes.push_back(static_cast<char>(image.rgb[3 * (y * width + x) + channel]));
      }
    }
    bytes.append(row - 3 * width, '\0');
  }
  return bytes;
}

/// Whether all triangles lie in a plane.
bool is_flat(const Part& part) {
  constexpr double kFlat = 1e-3;  // of the greatest extent
  const auto place = [&part](std::uint32_t vertex) {
    const auto& v = (*part.vertices)[vertex];
    return Vector3(v[0], v[1], v[2]);
  };
  Vector3 normal;  // of the largest triangle
  Vector3 on_plane;
  for (const auto& triangle : *part.triangles) {
    const Vector3 first = place(triangle[0]);
    const Vector3 area = (place(triangle[1]) - first).cross(place(triangle[2]) - first);
    if (area.squaredNorm() <= normal.squaredNorm()) continue;
    normal = area;
    on_plane = first;
  }
  if (normal == Vector3::Zero()) return false;
  normal.normalize();
  double extent = 0;
  double distance = 0;
  for (const auto& triangle : *part.triangles) {
    for (const std::uint32_t vertex : triangle) {
      const Vector3 from_plane = place(vertex) - on_plane;
      extent = std::max(extent, from_plane.norm());
      distance = std::max(distance, std::abs(normal.dot(from_plane)));
    }
  }
  return distance <= kFlat * extent;
}

}  // namespace

std::string MeshFiles::write(const std::string& name, const std::vector<const Part*>& parts, bool is_seen) {
  std::string text;
  std::size_t first = 1;  // OBJ counts from 1
  std::size_t first_corner = 1;
  for (const Part* part : parts) {
    for (const auto& v : *part->vertices) {
      const Vector3 point = part->frame * Vector3(v[0], v[1], v[2]);
      text += "v " + exact({point.x(), point.y(), point.z()}) + "\n";
    }
    for (const auto& c : part->texture_coordinates) text += "vt " + exact({c[0], c[1]}) + "\n";
    const bool has_coordinates = !part->texture_coordinates.empty();
    // Rays pass the backs of triangles: flat ones, such as lines on a floor, get a second side. Other surfaces do not:
    // the lidars of many scenes look out of an open body.
    const bool has_back = is_seen && !part->is_one_sided && is_flat(*part);
    const auto write_side = [&](std::array<std::size_t, 3> order) {
      std::size_t corner = first_corner;
      for (const auto& triangle : *part->triangles) {
        text += "f";
        for (const std::size_t i : order) {
          text += " " + std::to_string(first + triangle[i]);
          if (has_coordinates) text += "/" + std::to_string(corner + i);
        }
        corner += 3;
        text += "\n";
      }
    };
    write_side({0, 1, 2});
    if (has_back) write_side({0, 2, 1});
    first += part->vertices->size();
    first_corner += part->texture_coordinates.size();
  }
  const std::string path = "meshes/" + names_.take(name) + ".obj";
  write_file(folder_ / path, text);
  return path;
}

std::string MeshFiles::texture(const Part& part) {
  if (part.texture < 0 || part.texture_coordinates.empty()) return {};
  const auto [known, is_new] = textures_.emplace(part.texture, "");
  if (!is_new) return known->second;
  const auto image = std::find_if(file_.images.begin(), file_.images.end(),
                                  [&part](const Image& each) { return each.id == part.texture; });
  if (image == file_.images.end()) return {};  // the image of a vision sensor
  known->second = "textures/" + std::to_string(textures_.size()) + ".bmp";
  write_file(folder_ / known->second, bitmap(*image));
  return known->second;
}

}  // namespace bubblesim::ttt
