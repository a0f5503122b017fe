// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/surface_color.hpp"

#include <cstdint>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {
namespace {

using lanes::kLanes;

lanes::Turn rows_of(const Matrix3& turn) {
  return {turn(0, 0), turn(0, 1), turn(0, 2), turn(1, 0), turn(1, 1), turn(1, 2), turn(2, 0), turn(2, 1), turn(2, 2)};
}

/// Rays that hit the same shape.
struct Painter {
  const RayScene& scene;
  const rays::RayPacket& packet;
  const rays::HitGroup& group;
  const rays::RayShape& shape;
  Surfaces& surfaces;

  void paint_all() const {
    set_normals();
    if (const Color* color = scene.color(shape.link)) {
      lanes::paint(Color{}, group.members, surfaces.emissive);
      lanes::paint(*color, group.members, surfaces.diffuse);
      return;
    }
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh == nullptr || !shape.keeps_mesh_materials || mesh->triangles->materials.empty()) {
      paint(shape.material, group.members);
      return;
    }
    rays::RayMask left = group.members;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (left.use[i] == 0) continue;
      const std::uint16_t material = material_of(*mesh->triangles, i);
      rays::RayMask same;
      for (std::size_t other = 0; other < kLanes; ++other) {
        same.use[other] = left.use[other] != 0 && material_of(*mesh->triangles, other) == material ? rays::kUsed : 0;
        if (same.use[other] != 0) left.use[other] = 0;
      }
      paint(mesh->triangles->materials[material], same);
    }
  }

 private:
  std::uint16_t material_of(const TriangleMesh& mesh, std::size_t i) const {
    return mesh.material_of[packet.data.hit.primID[i]];
  }

  void set_normals() const {
    if (const Vector3* normal = scene.plane_normal(packet, group.ray)) {
      lanes::set_normals(*normal, group.members, surfaces.normals);
      return;
    }
    const Transform* link = scene.link_frame(packet, group.ray);
    if (link != nullptr) lanes::turn_normals(rows_of(link->rotation), group.members, surfaces.normals);
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh == nullptr || mesh->triangles->normals.empty()) return;
    lanes::CornerNormals corners{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (group.members.use[i] == 0) continue;
      const TriangleMesh::Triangle& triangle = mesh->triangles->triangles[packet.data.hit.primID[i]];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const TriangleMesh::Point& normal = mesh->triangles->normals[triangle[corner]];
        corners.corner[corner].x[i] = normal[0];
        corners.corner[corner].y[i] = normal[1];
        corners.corner[corner].z[i] = normal[2];
      }
      corners.second[i] = packet.data.hit.u[i];
      corners.third[i] = packet.data.hit.v[i];
    }
    const Matrix3 turn = link != nullptr ? link->rotation * shape.turn : shape.turn;
    lanes::smooth_normals(corners, rows_of(turn), group.members, surfaces.normals);
  }

  void paint(const Material& material, const rays::RayMask& mask) const {
    lanes::paint(material.emissive, mask, surfaces.emissive);
    lanes::ImagePlaces places;
    if (material.texture != nullptr && find_image_places(mask, places)) {
      lanes::paint_texture(*material.texture, places, mask, surfaces.diffuse);
    } else if (material.checker_size > 0) {
      lanes::paint_checker(material, in_shape(), packet.data.ray.tfar, mask, surfaces.diffuse);
    } else {
      lanes::paint(material.diffuse, mask, surfaces.diffuse);
    }
  }

  lanes::Places in_shape() const {
    lanes::Places places = surfaces.places;
    if (const Transform* link = scene.link_frame(packet, group.ray)) {
      lanes::into_frame(rows_of(link->rotation), link->position, places);
    }
    lanes::into_frame(rows_of(shape.turn), shape.pose.position, places);
    return places;
  }

  /// Returns false if the shape shows no images.
  bool find_image_places(const rays::RayMask& mask, lanes::ImagePlaces& places) const {
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      lanes::place_on_box(box->size, in_shape(), places);
      return true;
    }
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh == nullptr || mesh->triangles->texture_coordinates.empty()) return false;
    places = {};
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (mask.use[i] == 0) continue;
      const TriangleMesh::Triangle& corners = mesh->triangles->triangles[packet.data.hit.primID[i]];
      const float u = packet.data.hit.u[i];
      const float v = packet.data.hit.v[i];
      const auto blend = [&](std::size_t axis) {
        const auto at = [&](std::size_t corner) { return mesh->triangles->texture_coordinates[corners[corner]][axis]; };
        return (1 - u - v) * at(0) + u * at(1) + v * at(2);
      };
      places.right[i] = blend(0);
      places.up[i] = blend(1);
    }
    return true;
  }
};

}  // namespace

void find_surfaces(const RayScene& scene, const rays::RayPacket& packet, const rays::HitGroups& groups,
                   Surfaces& surfaces) {
  lanes::find_places(packet.data, surfaces.places, surfaces.normals);
  for (const rays::HitGroup& group : groups) {
    Painter{scene, packet, group, scene.shape(packet, group.ray), surfaces}.paint_all();
  }
}

}  // namespace bubblesim
