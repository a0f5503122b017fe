// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_geometry.hpp"

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "load/find/model_folders.hpp"
#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/mesh_file.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

/// The shape that `load` makes of the file that a shape refers to.
template <class Load>
Mesh from_file(const SdfElement& shape, const LoadContext& context, const Load& load) {
  const std::string uri = shape.text("uri");
  const fs::path file = find_resource(uri, shape.source().file, context.folder());
  if (file.empty()) {
    throw MissingFile("file not found: '" + uri + "'; model:// refers to a folder in BUBBLESIM_MODEL_PATH or " +
                      "GAZEBO_MODEL_PATH, package:// to a ROS package, other paths are relative to the file that " +
                      "contains them");
  }
  try {
    if (!fs::is_regular_file(file)) throw MeshError("is not a regular file");
    return Mesh{load(file)};
  } catch (const MeshError& error) {
    throw MeshError(file.string() + " " + error.what());
  }
}

Mesh read_mesh(const SdfElement& mesh, LoadContext& context) {
  const SdfElement part = mesh.child("submesh");
  return from_file(mesh, context, [&](const fs::path& file) {
    return load_mesh({file, mesh.vector("scale"), part.text("name"), part.flag("center")}, context.meshes());
  });
}

Mesh read_heightmap(const SdfElement& map, const LoadContext& context) {
  return from_file(map, context, [&](const fs::path& file) {
    return raise_ground(read_heights(file), map.vector("size"), map.vector("pos"));
  });
}

Mesh read_walls(const SdfElement& image, const LoadContext& context) {
  return from_file(image, context, [&](const fs::path& file) {
    return raise_walls(read_heights(file), image.number("scale"), image.number("threshold"), image.number("height"));
  });
}

/// Several polylines are one shape: an outline inside another is a hole.
Mesh read_polylines(const SdfElement& geometry) {
  std::vector<Extrusion> parts;
  for (const SdfElement& line : geometry.children("polyline")) {
    Extrusion& part = parts.emplace_back();
    part.height = line.number("height");
    for (const SdfElement& point : line.children("point")) part.outline.push_back(point.as_vector2());
  }
  try {
    return Mesh{extrude(std::move(parts))};
  } catch (const MeshError& error) {
    throw MeshError("the polyline " + std::string(error.what()));
  }
}

/// About the z axis, from the base at -length / 2 to the apex at length / 2.
Mesh read_cone(const SdfElement& cone) {
  constexpr std::uint32_t kSides = 24;
  const double radius = cone.number("radius");
  const double length = cone.number("length");
  if (!(radius > 0 && length > 0)) throw MeshError("the cone must have a radius and a length above 0");
  const auto half = static_cast<float>(length / 2);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    mesh.vertices.push_back(
        {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), -half});
  }
  mesh.vertices.push_back({0, 0, -half});
  mesh.vertices.push_back({0, 0, half});
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t next = (i + 1) % kSides;
    mesh.triangles.push_back({kSides, next, i});
    mesh.triangles.push_back({kSides + 1, i, next});
  }
  try {
    return Mesh{finish_mesh(std::move(mesh))};
  } catch (const MeshError& error) {
    throw MeshError("the cone " + std::string(error.what()));
  }
}

}  // namespace

std::optional<Geometry> read_geometry(const SdfElement& geometry, LoadContext& context) {
  if (const SdfElement box = geometry.child("box")) return Box{box.vector("size")};
  if (const SdfElement sphere = geometry.child("sphere")) return Sphere{sphere.number("radius")};
  if (const SdfElement cylinder = geometry.child("cylinder")) {
    return Cylinder{cylinder.number("radius"), cylinder.number("length")};
  }
  if (const SdfElement capsule = geometry.child("capsule")) {
    return Capsule{capsule.number("radius"), capsule.number("length")};
  }
  if (const SdfElement ellipsoid = geometry.child("ellipsoid")) return Ellipsoid{ellipsoid.vector("radii")};
  if (const SdfElement plane = geometry.child("plane")) return Plane{plane.vector("normal").normalized()};
  if (const SdfElement mesh = geometry.child("mesh")) return read_mesh(mesh, context);
  if (const SdfElement map = geometry.child("heightmap")) return read_heightmap(map, context);
  if (geometry.has("polyline")) return read_polylines(geometry);
  if (const SdfElement image = geometry.child("image")) return read_walls(image, context);
  if (const SdfElement cone = geometry.child("cone")) return read_cone(cone);
  if (geometry.has("empty")) return std::nullopt;
  throw MeshError(
      "this geometry is not supported; supported geometries: box, sphere, cylinder, capsule, cone, ellipsoid, plane, "
      "mesh, polyline, heightmap, image and empty");
}

}  // namespace bubblesim
