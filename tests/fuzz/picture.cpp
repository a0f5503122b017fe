// SPDX-License-Identifier: BSD-3-Clause
// The answer of the program that reads image files, which a file may have made crash or answer anything.
#include "meshes/picture.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"
#include "taken.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {
namespace {

void use_texture(PictureContent content) {
  try {
    const std::shared_ptr<const Texture> texture = to_texture(std::move(content));
    require(texture->rgb.size() == std::size_t{3} * texture->width * texture->height, "pixels have three colours");
    const Color color = mean_color(*texture);
    require(color.r >= 0 && color.r <= 1 && color.b >= 0 && color.b <= 1, "colours are from 0 to 1");
  } catch (const MeshError&) {
    return;
  }
}

/// As a ground, or as walls: `make` raises a mesh.
template <class Make>
void raise(const Make& make) {
  try {
    const std::shared_ptr<const TriangleMesh> made = make();
    for (const TriangleMesh::Triangle& triangle : made->triangles) {
      for (std::size_t i = 0; i < 3; ++i) require(made->corner(triangle, i).allFinite(), "corners are finite");
    }
  } catch (const MeshError&) {
    return;
  }
}

}  // namespace

void read_picture(std::string_view data) {
  Taken taken(data);
  PictureContent content;
  content.width = taken.value<std::int8_t>();
  content.height = taken.value<std::int8_t>();
  const Vector3 size{taken.value<float>(), taken.value<float>(), taken.value<float>()};
  const double threshold = taken.value<std::uint8_t>();
  content.rgb = taken.values<std::uint8_t>();
  content.heights = taken.values<std::uint16_t>();
  raise([&] { return raise_ground(to_heights(content), size); });
  raise([&] { return raise_walls(to_heights(content), size.x(), threshold, size.z()); });
  use_texture(std::move(content));
}

}  // namespace bubblesim::fuzz
