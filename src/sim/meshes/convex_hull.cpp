// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/convex_hull.hpp"

#include <libqhullcpp/Qhull.h>
#include <libqhullcpp/QhullFacetList.h>
#include <libqhullcpp/QhullVertexSet.h>

#include <map>
#include <sstream>

namespace bubblesim {

Hull convex_hull(const TriangleMesh& mesh) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.vertices.size());
  for (const TriangleMesh::Point& vertex : mesh.vertices) {
    coordinates.insert(coordinates.end(), vertex.begin(), vertex.end());
  }
  Hull hull;
  try {
    orgQhull::Qhull qhull;
    std::ostringstream messages;  // prevents printing
    qhull.setErrorStream(&messages);
    qhull.setOutputStream(&messages);
    // C-0 merges coplanar facets, Qt then splits them into triangles: corners inside a face are dropped.
    qhull.runQhull("", 3, static_cast<int>(mesh.vertices.size()), coordinates.data(), "C-0 Qt");
    std::map<int, std::uint32_t> index_of;
    for (const orgQhull::QhullFacet& facet : qhull.facetList()) {
      TriangleMesh::Triangle triangle;
      std::size_t corner = 0;
      std::array<Vector3, 3> places;
      for (const orgQhull::QhullVertex& vertex : facet.vertices()) {
        if (corner == 3) break;
        const orgQhull::QhullPoint point = vertex.point();
        places[corner] = Vector3(point[0], point[1], point[2]);
        const auto [found, is_new] = index_of.try_emplace(point.id(), static_cast<std::uint32_t>(hull.corners.size()));
        if (is_new) hull.corners.push_back(places[corner]);
        triangle[corner++] = found->second;
      }
      const double* normal = facet.hyperplane().coordinates();
      const Vector3 outwards(normal[0], normal[1], normal[2]);
      const bool backwards = (places[1] - places[0]).cross(places[2] - places[0]).dot(outwards) < 0;
      if (backwards) std::swap(triangle[1], triangle[2]);
      hull.triangles.push_back(triangle);
    }
  } catch (const orgQhull::QhullError&) {
    return {};  // qhull requires a volume
  }
  return hull;
}

}  // namespace bubblesim
