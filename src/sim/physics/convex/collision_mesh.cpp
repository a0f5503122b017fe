// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/collision_mesh.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>

#include "meshes/convex_hull.hpp"
#include "meshes/convex_parts.hpp"
#include "meshes/simplify.hpp"

namespace bubblesim {
namespace {

// A mesh is convex if its volume differs from that of its hull by less than this fraction; files round their corners.
constexpr double kConvex = 0.001;
// ODE takes ten microseconds for each triangle that a body may touch, in each collision check.
constexpr std::size_t kTooManyInCubicMetre = 10'000;  // triangles; a check takes a tenth of a second and more
constexpr std::size_t kFewInCubicMetre = 3'000;       // triangles; a check takes some hundredths of a second
// Of the division of a concave mesh into convex parts: a contact takes a few microseconds for each pair of parts.
constexpr PartLimits kPartLimits;
constexpr std::size_t kMostToDivide = 5'000;  // triangles; these take a few tenths of a second

/// Merges corners with equal positions: files repeat them, and each would make its own contacts.
void take_surface(const TriangleMesh& mesh, CollisionMesh& result) {
  std::map<TriangleMesh::Point, dTriIndex> index_of;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      const TriangleMesh::Point& place = mesh.vertices[corner];
      const auto [found, is_new] = index_of.try_emplace(place, static_cast<dTriIndex>(index_of.size()));
      if (is_new) result.coordinates.insert(result.coordinates.end(), place.begin(), place.end());
      result.indices.push_back(found->second);
    }
  }
}

bool is_convex(const TriangleMesh& mesh, const Hull& hull) {
  const double full = enclosed_volume(hull.triangles, [&](std::uint32_t i) { return hull.corners[i]; });
  const double own = enclosed_volume(mesh.triangles, [&](std::uint32_t i) {
    const TriangleMesh::Point& place = mesh.vertices[i];
    return Vector3(place[0], place[1], place[2]);
  });
  // Also for a mesh that is inside out.
  return full > 0 && std::abs(std::abs(own) / full - 1) < kConvex;
}

/// Keeps unused corners in the array: ODE reads triangles only.
void make_coarser(CollisionMesh& mesh) {
  const std::vector<float> coordinates(mesh.coordinates.begin(), mesh.coordinates.end());
  CornerIndices triangles(mesh.indices.begin(), mesh.indices.end());
  const std::size_t fullest = most_in_cubic_metre(coordinates, triangles);
  if (fullest <= kTooManyInCubicMetre) return;
  const std::size_t before = triangles.size() / 3;
  const double moved = simplify(coordinates, triangles, kFewInCubicMetre);
  mesh.indices.assign(triangles.begin(), triangles.end());
  char millimetres[32];
  std::snprintf(millimetres, sizeof millimetres, "%.2g", 1000 * moved);
  mesh.remark += std::string(mesh.remark.empty() ? "" : "; ") + "mesh too fine for collisions (" +
                 std::to_string(before) + " triangles, up to " + std::to_string(fullest) +
                 " in a cubic metre): simplified to " + std::to_string(triangles.size() / 3) +
                 " triangles, which deviate up to about " + millimetres + " mm; use a simpler collision mesh";
}

TriangleMesh::Point to_point(const Vector3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

std::string percent(double fraction) { return std::to_string(std::lround(100 * fraction)) + " %"; }

/// Divides a concave mesh into convex parts; false when they do not fit it and must.
bool take_parts(const TriangleMesh& mesh, bool must_fit, CollisionMesh& result) {
  const bool too_many = must_fit && mesh.triangles.size() > kMostToDivide;
  const ConvexParts parts = too_many ? ConvexParts{} : convex_parts(mesh, kPartLimits);
  if (!too_many && !parts.hulls.empty() && (!must_fit || parts.excess <= kPartLimits.excess)) {
    TriangleMesh corners;
    for (const Hull& hull : parts.hulls) {
      result.parts.push_back(make_part(hull));
      for (const Vector3& p : hull.corners) corners.vertices.push_back(to_point(p));
    }
    if (parts.hulls.size() > 1) result.hull = std::make_unique<ConvexPart>(make_part(convex_hull(corners)));
    return true;
  }
  const std::string reason = too_many ? "it has more than " + std::to_string(kMostToDivide) + " triangles"
                             : std::isfinite(parts.excess) ? std::to_string(kPartLimits.most) + " convex parts add " +
                                                                 percent(parts.excess) + " to it"
                                                           : "its surface is not closed";
  result.remark = "concave mesh that moves, collides as triangles (" + reason +
                  "): another mesh of triangles may throw it; use several simpler shapes, or <bubblesim:convex>";
  return false;
}

/// Takes the hull or convex parts, as the use wants; false when triangles are left to take.
bool take_convex(const TriangleMesh& mesh, MeshUse use, CollisionMesh& result) {
  if (use == MeshUse::kTriangles) return false;
  const Hull hull = convex_hull(mesh);
  if (hull.triangles.empty()) return false;
  if (use == MeshUse::kHull || is_convex(mesh, hull)) {
    result.parts.push_back(make_part(hull));
    return true;
  }
  return use != MeshUse::kStatic && take_parts(mesh, use == MeshUse::kMoving, result);
}

std::shared_ptr<const CollisionMesh> prepare(const TriangleMesh& mesh, MeshUse use) {
  auto result = std::make_shared<CollisionMesh>();
  if (take_convex(mesh, use, *result)) return result;
  take_surface(mesh, *result);
  make_coarser(*result);
  result->data.reset(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildDouble(result->data.get(), result->coordinates.data(), 3 * sizeof(double),
                              static_cast<int>(result->coordinates.size() / 3), result->indices.data(),
                              static_cast<int>(result->indices.size()), 3 * sizeof(dTriIndex));
  return result;
}

}  // namespace

const TriangleTree& CollisionMesh::tree() const {
  std::call_once(tree_made_, [&] { tree_ = std::make_unique<TriangleTree>(coordinates, indices); });
  return *tree_;
}

std::shared_ptr<const CollisionMesh> collision_mesh(const std::shared_ptr<const TriangleMesh>& mesh, MeshUse use) {
  // Keyed by owner, not by address: a new mesh may have the address of an old one.
  using Known = std::map<std::weak_ptr<const TriangleMesh>, std::weak_ptr<const CollisionMesh>,
                         std::owner_less<std::weak_ptr<const TriangleMesh>>>;
  static std::mutex mutex;
  static std::array<Known, 5> known_by_use;
  const std::scoped_lock lock(mutex);
  Known& known = known_by_use[static_cast<std::size_t>(use)];
  for (auto entry = known.begin(); entry != known.end();) {
    entry = entry->first.expired() ? known.erase(entry) : std::next(entry);
  }
  std::weak_ptr<const CollisionMesh>& shared = known[mesh];
  if (std::shared_ptr<const CollisionMesh> prepared = shared.lock()) return prepared;
  std::shared_ptr<const CollisionMesh> prepared = prepare(*mesh, use);
  shared = prepared;
  return prepared;
}

}  // namespace bubblesim
