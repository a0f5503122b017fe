// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_geometry.hpp"

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <string>
#include <utility>
#include <vector>

#include "load/find/model_folders.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/mesh_file.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

class GeometryReader {
 public:
  GeometryReader(sdf::ElementPtr element, LoadContext& reading) : element_(std::move(element)), reading_(reading) {}

  Geometry mesh(const sdf::Mesh& mesh) const {
    return from_file(mesh.Uri(), [&](const fs::path& file) {
      return load_mesh({file, mesh.Scale(), mesh.Submesh(), mesh.CenterSubmesh()}, reading_.meshes());
    });
  }

  Geometry heightmap(const sdf::Heightmap& map) const {
    return from_file(
        map.Uri(), [&](const fs::path& file) { return raise_ground(read_heights(file), map.Size(), map.Position()); });
  }

  Geometry polylines() const {
    std::vector<Extrusion> parts;
    for (auto line = element_->GetElement("polyline"); line != nullptr; line = line->GetNextElement("polyline")) {
      Extrusion& part = parts.emplace_back();
      part.height = line->Get<double>("height", 1).first;
      if (!line->HasElement("point")) continue;
      for (auto point = line->GetElement("point"); point != nullptr; point = point->GetNextElement("point")) {
        part.outline.push_back(point->Get<ignition::math::Vector2d>());
      }
    }
    try {
      return Mesh{extrude(std::move(parts))};
    } catch (const MeshError& error) {
      throw MeshError("the polyline " + std::string(error.what()));
    }
  }

  Geometry walls() const {
    const sdf::ElementPtr image = element_->GetElement("image");
    return from_file(image->Get<std::string>("uri", "").first, [&](const fs::path& file) {
      return raise_walls(read_heights(file), image->Get<double>("scale", 1).first,
                         image->Get<double>("threshold", 200).first, image->Get<double>("height", 1).first);
    });
  }

 private:
  template <class Load>
  Geometry from_file(const std::string& uri, const Load& load) const {
    const fs::path file = find_resource(uri, element_->FilePath(), reading_.folder());
    if (file.empty()) {
      throw MissingFile(
          "file not found: '" + uri + "'; model:// refers to a folder in BUBBLESIM_MODEL_PATH or " +
          "GAZEBO_MODEL_PATH, package:// to a ROS package, other paths are relative to the file that contains them");
    }
    try {
      if (!fs::is_regular_file(file)) throw MeshError("is not a regular file");
      return Mesh{load(file)};
    } catch (const MeshError& error) {
      throw MeshError(file.string() + " " + error.what());
    }
  }

  sdf::ElementPtr element_;
  LoadContext& reading_;
};

}  // namespace

std::optional<Geometry> read_geometry(const sdf::Geometry& geometry, LoadContext& reading) {
  if (const auto* box = geometry.BoxShape()) return Box{box->Size()};
  if (const auto* sphere = geometry.SphereShape()) return Sphere{sphere->Radius()};
  if (const auto* cylinder = geometry.CylinderShape()) return Cylinder{cylinder->Radius(), cylinder->Length()};
  if (const auto* capsule = geometry.CapsuleShape()) return Capsule{capsule->Radius(), capsule->Length()};
  if (const auto* ellipsoid = geometry.EllipsoidShape()) return Ellipsoid{ellipsoid->Radii()};
  if (const auto* plane = geometry.PlaneShape()) return Plane{plane->Normal()};
  const GeometryReader reader(geometry.Element(), reading);
  if (const auto* mesh = geometry.MeshShape()) return reader.mesh(*mesh);
  if (const auto* map = geometry.HeightmapShape()) return reader.heightmap(*map);
  if (geometry.Element() != nullptr && geometry.Element()->HasElement("polyline")) return reader.polylines();
  if (geometry.Element() != nullptr && geometry.Element()->HasElement("image")) return reader.walls();
  if (geometry.Element() != nullptr && geometry.Element()->HasElement("empty")) return std::nullopt;
  throw MeshError(
      "this geometry is not supported; supported geometries: box, sphere, cylinder, capsule, ellipsoid, plane, mesh, "
      "polyline, "
      "heightmap, image and empty");
}

}  // namespace bubblesim
