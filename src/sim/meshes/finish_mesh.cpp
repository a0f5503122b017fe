// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/finish_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

constexpr double kMaxCoordinate = 1e5;  // m
constexpr std::size_t kMaxTriangles = 10'000'000;
// Sine of the smallest allowed angle of a triangle: below, its normal is noise in single precision.
constexpr double kMinSine = 1e-6;

bool has_area(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle) {
  const Vector3 a = mesh.corner(triangle, 1) - mesh.corner(triangle, 0);
  const Vector3 b = mesh.corner(triangle, 2) - mesh.corner(triangle, 0);
  const Vector3 c = b - a;
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
  return longest > 0 && a.cross(b).norm() > kMinSine * longest;
}

/// The program that reads mesh files may have been made to answer anything by one of them.
void check_sizes(const TriangleMesh& mesh) {
  const auto is_per_vertex = [&](std::size_t size) { return size == 0 || size == mesh.vertices.size(); };
  const auto exists = [&](std::size_t material) { return material < mesh.materials.size(); };
  const bool has_materials = !mesh.materials.empty() || !mesh.material_of.empty();
  if (!is_per_vertex(mesh.normals.size()) || !is_per_vertex(mesh.texture_coordinates.size())) {
    throw MeshError("has normals or texture coordinates for some of its vertices only");
  }
  if (has_materials && (mesh.material_of.size() != mesh.triangles.size() ||
                        !std::all_of(mesh.material_of.begin(), mesh.material_of.end(), exists))) {
    throw MeshError("has a triangle with a material that does not exist");
  }
}

/// Puts what is not finite at a corner of the texture, whose pixels are found by these numbers.
void make_finite(std::vector<std::array<float, 2>>& coordinates) {
  for (std::array<float, 2>& point : coordinates) {
    for (float& number : point) {
      if (!std::isfinite(number)) number = 0;
    }
  }
}

}  // namespace

std::shared_ptr<const TriangleMesh> finish_mesh(TriangleMesh mesh) {
  const auto usable = [](const TriangleMesh::Point& point) {
    return std::all_of(point.begin(), point.end(), [](float x) { return std::abs(x) <= kMaxCoordinate; });
  };
  if (mesh.triangles.size() > kMaxTriangles) {
    throw MeshError("has " + std::to_string(mesh.triangles.size()) + " triangles; the maximum is " +
                    std::to_string(kMaxTriangles));
  }
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), usable)) {
    throw MeshError("has a vertex that is not finite or more than 1e5 m away: check its coordinates and scale");
  }
  check_sizes(mesh);
  make_finite(mesh.texture_coordinates);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const TriangleMesh::Triangle triangle = mesh.triangles[i];
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) {
      throw MeshError("has a triangle with a corner that does not exist");
    }
    if (!has_area(mesh, triangle)) continue;
    mesh.triangles[kept] = triangle;
    if (!mesh.material_of.empty()) mesh.material_of[kept] = mesh.material_of[i];
    ++kept;
  }
  if (kept == 0) throw MeshError("contains no triangle with an area");
  mesh.triangles.resize(kept);
  if (!mesh.material_of.empty()) mesh.material_of.resize(kept);
  mesh.low = Vector3::Constant(std::numeric_limits<double>::infinity());
  mesh.high = -mesh.low;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.low = mesh.low.cwiseMin(mesh.corner(triangle, i));
      mesh.high = mesh.high.cwiseMax(mesh.corner(triangle, i));
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

}  // namespace bubblesim
