// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/surface_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {
namespace {

using Place = std::array<float, 2>;  // on an image, from its lower left corner (0, 0) to (1, 1)

Color checker(const Material& material, const Vector3& in_shape) {
  // Tolerance of half a millionth of a square: a face on a border between squares must not flicker.
  const auto field = [&](double place) { return std::lround(std::floor(place / material.checker_size + 5e-7)); };
  const long parity = field(in_shape.X()) + field(in_shape.Y()) + field(in_shape.Z());
  return parity % 2 == 0 ? material.diffuse : material.checker_color;
}

/// The image repeats; colours are interpolated between pixel centres.
Color sample(const Texture& texture, const Place& place) {
  const auto along = [](float part, int pixels, bool flipped) {
    const double turned = flipped ? 1.0 - static_cast<double>(part) : static_cast<double>(part);
    return (turned - std::floor(turned)) * pixels - 0.5;
  };
  const double x = along(place[0], texture.width, false);
  const double y = along(place[1], texture.height, true);
  if (!std::isfinite(x) || !std::isfinite(y)) return {};
  const double left = std::floor(x);
  const double upper = std::floor(y);
  Color sum;
  for (int corner = 0; corner < 4; ++corner) {
    const int right_one = corner & 1;
    const int lower_one = corner >> 1;
    const auto wrapped = [](int index, int count) { return ((index % count) + count) % count; };
    const int column = wrapped(static_cast<int>(left) + right_one, texture.width);
    const int row = wrapped(static_cast<int>(upper) + lower_one, texture.height);
    const double weight_x = right_one != 0 ? x - left : 1 - (x - left);
    const double weight_y = lower_one != 0 ? y - upper : 1 - (y - upper);
    const auto weight = static_cast<float>(weight_x * weight_y / 255);
    const std::uint8_t* pixel =
        &texture.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) +
                          static_cast<std::size_t>(column))];
    sum.r += weight * static_cast<float>(pixel[0]);
    sum.g += weight * static_cast<float>(pixel[1]);
    sum.b += weight * static_cast<float>(pixel[2]);
  }
  return sum;
}

/// Each face of a box shows the whole image: upright on the sides, the upper edge at +x on top and bottom.
Place place_on_box(const Box& box, const Vector3& point) {
  const Vector3 part = point / box.size;  // from -0.5 to 0.5
  std::size_t face = 0;
  for (const std::size_t axis : {1U, 2U}) {
    if (std::abs(part[axis]) > std::abs(part[face])) face = axis;
  }
  const double side = part[face] > 0 ? 1 : -1;
  const double right = face == 0 ? side * part.Y() : face == 1 ? -side * part.X() : -side * part.Y();
  const double up = face == 2 ? part.X() : part.Z();
  return {static_cast<float>(right + 0.5), static_cast<float>(up + 0.5)};
}

Place place_on_mesh(const TriangleMesh& mesh, unsigned triangle, float u, float v) {
  const auto& corners = mesh.triangles[triangle];
  const auto blend = [&](std::size_t i) {
    const auto at = [&](std::size_t corner) { return mesh.texture_coordinates[corners[corner]][i]; };
    return (1 - u - v) * at(0) + u * at(1) + v * at(2);
  };
  return {blend(0), blend(1)};
}

}  // namespace

SurfaceColor surface_color(const RayScene& scene, const rays::RayPacket& packet, std::size_t i, const Vector3& point) {
  const rays::RayShape& shape = scene.shape(packet, i);
  const Material* material = &shape.material;
  std::optional<Place> place;
  if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
    const TriangleMesh& triangles = *mesh->triangles;
    const unsigned triangle = packet.data.hit.primID[i];
    if (shape.keeps_mesh_materials && !triangles.materials.empty()) {
      material = &triangles.materials[triangles.material_of[triangle]];
    }
    if (material->texture != nullptr && !triangles.texture_coordinates.empty()) {
      place = place_on_mesh(triangles, triangle, packet.data.hit.u[i], packet.data.hit.v[i]);
    }
  } else if (material->texture != nullptr) {
    const auto* box = std::get_if<Box>(&shape.geometry);
    if (box != nullptr) place = place_on_box(*box, scene.in_shape(packet, i, point));
  }
  if (place) return {sample(*material->texture, *place), material->emissive};
  if (material->checker_size > 0) return {checker(*material, scene.in_shape(packet, i, point)), material->emissive};
  return {material->diffuse, material->emissive};
}

}  // namespace bubblesim
