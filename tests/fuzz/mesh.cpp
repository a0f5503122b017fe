// SPDX-License-Identifier: BSD-3-Clause
// The answer of the program that reads mesh files, which a file may have made crash or answer anything.
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "meshes/finish_mesh.hpp"
#include "meshes/mesh_error.hpp"
#include "taken.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {

void read_mesh(std::string_view data) {
  Taken taken(data);
  TriangleMesh mesh;
  mesh.materials.resize(taken.value<std::uint8_t>() % 4);
  mesh.vertices = taken.values<TriangleMesh::Point>();
  for (const auto& corners : taken.values<std::array<std::uint8_t, 3>>()) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  mesh.normals = taken.values<TriangleMesh::Point>();
  mesh.texture_coordinates = taken.values<std::array<float, 2>>();
  for (const std::uint8_t material : taken.values<std::uint8_t>()) mesh.material_of.push_back(material);
  try {
    const std::shared_ptr<const TriangleMesh> made = finish_mesh(std::move(mesh));
    for (const TriangleMesh::Triangle& triangle : made->triangles) {
      for (std::size_t i = 0; i < 3; ++i) require(made->corner(triangle, i).allFinite(), "corners are finite");
    }
    for (const auto& place : made->texture_coordinates) {
      require(std::isfinite(place[0]) && std::isfinite(place[1]), "places on a texture are finite");
    }
    require(made->materials.empty() || made->material_of.size() == made->triangles.size(), "triangles have materials");
  } catch (const MeshError&) {
    return;
  }
}

}  // namespace bubblesim::fuzz
