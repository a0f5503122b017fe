// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

constexpr std::size_t kMaxCorners = 513;  // per side: half a million triangles

/// The pixels that become corners: all, or evenly spaced ones including the first and the last.
std::vector<std::size_t> chosen(std::size_t pixels) {
  const std::size_t count = std::min(pixels, kMaxCorners);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < count; ++i) indices.push_back((i * (pixels - 1) + (count - 1) / 2) / (count - 1));
  return indices;
}

}  // namespace

std::shared_ptr<const TriangleMesh> raise_ground(const Heights& heights, const Vector3& size, const Vector3& middle) {
  if (heights.width < 2 || heights.height < 2) throw MeshError("is smaller than 2 x 2 pixels");
  const float brightest = *std::max_element(heights.values.begin(), heights.values.end());
  const double scale = brightest > 0 ? size.z() / static_cast<double>(brightest) : 0;
  const std::vector<std::size_t> columns = chosen(heights.width);
  const std::vector<std::size_t> rows = chosen(heights.height);
  TriangleMesh mesh;
  for (const std::size_t row : rows) {
    for (const std::size_t column : columns) {
      const double right = static_cast<double>(column) / static_cast<double>(heights.width - 1);
      const double down = static_cast<double>(row) / static_cast<double>(heights.height - 1);
      const double height = scale * static_cast<double>(heights.values[row * heights.width + column]);
      const Vector3 place = middle + Vector3((right - 0.5) * size.x(), (0.5 - down) * size.y(), height);
      mesh.vertices.push_back(
          {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())});
      mesh.texture_coordinates.push_back({static_cast<float>(right), static_cast<float>(1 - down)});
    }
  }
  const auto width = static_cast<std::uint32_t>(columns.size());
  for (std::uint32_t row = 0; row + 1 < rows.size(); ++row) {
    for (std::uint32_t column = 0; column + 1 < width; ++column) {
      const std::uint32_t corner = row * width + column;  // the upper left of four
      mesh.triangles.push_back({corner, corner + width, corner + width + 1});
      mesh.triangles.push_back({corner, corner + width + 1, corner + 1});
    }
  }
  return finish_mesh(std::move(mesh));
}

}  // namespace bubblesim
