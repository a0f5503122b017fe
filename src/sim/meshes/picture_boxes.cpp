// SPDX-License-Identifier: BSD-3-Clause
// Walls from a floor plan: the dark pixels of an image as boxes, each over a rectangle of pixels.
#include <array>
#include <cstdint>
#include <utility>

#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

/// A rectangle of pixels, without its second corner.
struct Rectangle {
  std::size_t left, top, right, bottom;
};

/// Covers the dark pixels row by row with rectangles, each as wide as possible and then as high as possible.
std::vector<Rectangle> cover(std::vector<bool> dark, std::size_t width, std::size_t height) {
  std::vector<Rectangle> rectangles;
  for (std::size_t top = 0; top < height; ++top) {
    for (std::size_t left = 0; left < width; ++left) {
      if (!dark[top * width + left]) continue;
      std::size_t right = left;
      while (right < width && dark[top * width + right]) ++right;
      const auto whole = [&](std::size_t row) {
        for (std::size_t i = left; i < right; ++i) {
          if (!dark[row * width + i]) return false;
        }
        return true;
      };
      std::size_t bottom = top + 1;
      while (bottom < height && whole(bottom)) ++bottom;
      for (std::size_t row = top; row < bottom; ++row) {
        for (std::size_t i = left; i < right; ++i) dark[row * width + i] = false;
      }
      rectangles.push_back({left, top, right, bottom});
    }
  }
  return rectangles;
}

void add_box(const Vector3& low, const Vector3& high, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back({static_cast<float>((corner & 1) != 0 ? high.x() : low.x()),
                             static_cast<float>((corner & 2) != 0 ? high.y() : low.y()),
                             static_cast<float>((corner & 4) != 0 ? high.z() : low.z())});
  }
  // Corners of the faces, counter-clockwise seen from outside.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}

}  // namespace

std::shared_ptr<const TriangleMesh> raise_walls(const Heights& picture, double scale, double threshold, double height) {
  if (!(scale > 0) || !(height > 0)) throw MeshError("needs a <scale> and a <height> above 0");
  std::vector<bool> dark;
  dark.reserve(picture.values.size());
  for (const float value : picture.values) dark.push_back(static_cast<double>(value) * 255 < threshold);
  TriangleMesh mesh;
  const double middle = static_cast<double>(picture.width) / 2;
  const double centre = static_cast<double>(picture.height) / 2;
  for (const Rectangle& r : cover(std::move(dark), picture.width, picture.height)) {
    const auto x = [&](std::size_t column) { return scale * (static_cast<double>(column) - middle); };
    const auto y = [&](std::size_t row) { return scale * (centre - static_cast<double>(row)); };
    add_box({x(r.left), y(r.bottom), 0}, {x(r.right), y(r.top), height}, mesh);
  }
  if (mesh.triangles.empty()) throw MeshError("has no pixel darker than the <threshold>");
  return finish_mesh(std::move(mesh));
}

}  // namespace bubblesim
