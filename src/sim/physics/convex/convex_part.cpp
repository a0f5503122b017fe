// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/convex_part.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace bubblesim {
namespace {

constexpr double kFlat = 1e-4;           // of the size: corners of a face deviate less from its plane; files round them
constexpr double kAligned = 0.99;        // cosine between the normals of triangles of one face
constexpr std::size_t kFewCorners = 24;  // trying all is faster than following edges

struct TriangleFacts {
  Vector3 normal;
  double area = 0;  // twice
};

/// Groups adjacent triangles of one plane into faces, the largest triangle first.
class FaceFinder {
 public:
  FaceFinder(const Hull& hull, ConvexPart& part) : hull_(hull), part_(part), face_of_(hull.triangles.size(), false) {
    for (std::size_t i = 0; i < hull.triangles.size(); ++i) {
      const auto& [a, b, c] = hull.triangles[i];
      const Vector3 normal = (part.corners[b] - part.corners[a]).cross(part.corners[c] - part.corners[a]);
      facts_.push_back({normal.normalized(), normal.norm()});
      for (const auto& edge : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) at_edge_[edge].push_back(i);
    }
  }

  void find() {
    std::vector<std::size_t> order(facts_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return facts_[a].area > facts_[b].area; });
    for (const std::size_t seed : order) {
      if (!face_of_[seed] && facts_[seed].area > 0) grow(seed);
    }
  }

 private:
  bool in_plane(std::size_t triangle, std::size_t seed) const {
    const Vector3& normal = facts_[seed].normal;
    const Vector3& on = part_.corners[hull_.triangles[seed][0]];
    if (facts_[triangle].area > 0 && facts_[triangle].normal.dot(normal) < kAligned) return false;
    const TriangleMesh::Triangle& corners = hull_.triangles[triangle];
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t i) {
      return std::abs((part_.corners[i] - on).dot(normal)) < kFlat * part_.size;
    });
  }

  void grow(std::size_t seed) {
    std::vector<std::size_t> group = {seed};
    face_of_[seed] = true;
    std::set<std::uint32_t> corners;
    for (std::size_t done = 0; done < group.size(); ++done) {
      const auto& [a, b, c] = hull_.triangles[group[done]];
      corners.insert({a, b, c});
      for (const auto& edge : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
        for (const std::size_t next : at_edge_.at(edge)) {
          if (face_of_[next] || !in_plane(next, seed)) continue;
          face_of_[next] = true;
          group.push_back(next);
        }
      }
    }
    add_face(facts_[seed].normal, {corners.begin(), corners.end()});
  }

  void add_face(const Vector3& normal, std::vector<std::uint32_t> corners) {
    Vector3 middle;
    for (const std::uint32_t i : corners) middle += part_.corners[i] / static_cast<double>(corners.size());
    const Vector3 u = normal.unitOrthogonal();
    const Vector3 v = normal.cross(u);
    const auto angle = [&](std::uint32_t i) {
      const Vector3 from_middle = part_.corners[i] - middle;
      return std::atan2(from_middle.dot(v), from_middle.dot(u));
    };
    std::sort(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
    part_.faces.push_back(
        {normal, static_cast<std::uint32_t>(part_.loops.size()), static_cast<std::uint32_t>(corners.size())});
    part_.loops.insert(part_.loops.end(), corners.begin(), corners.end());
  }

  const Hull& hull_;
  ConvexPart& part_;
  std::vector<bool> face_of_;
  std::vector<TriangleFacts> facts_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> at_edge_;
};

void list_neighbours(const Hull& hull, ConvexPart& part) {
  std::vector<std::set<std::uint32_t>> of(part.corners.size());
  for (const TriangleMesh::Triangle& triangle : hull.triangles) {
    for (const std::uint32_t a : triangle) {
      for (const std::uint32_t b : triangle) {
        if (a != b) of[a].insert(b);
      }
    }
  }
  for (const std::set<std::uint32_t>& neighbours : of) {
    part.start.push_back(static_cast<std::uint32_t>(part.neighbours.size()));
    part.neighbours.insert(part.neighbours.end(), neighbours.begin(), neighbours.end());
  }
  part.start.push_back(static_cast<std::uint32_t>(part.neighbours.size()));
}

void list_faces(ConvexPart& part) {
  std::vector<std::vector<std::uint32_t>> of(part.corners.size());
  for (std::uint32_t i = 0; i < part.faces.size(); ++i) {
    for (std::uint32_t j = 0; j < part.faces[i].count; ++j) of[part.loops[part.faces[i].first + j]].push_back(i);
  }
  for (const std::vector<std::uint32_t>& faces : of) {
    part.face_start.push_back(static_cast<std::uint32_t>(part.faces_at.size()));
    part.faces_at.insert(part.faces_at.end(), faces.begin(), faces.end());
  }
  part.face_start.push_back(static_cast<std::uint32_t>(part.faces_at.size()));
}

}  // namespace

std::uint32_t ConvexPart::farthest(const Vector3& direction, std::uint32_t from) const {
  std::uint32_t best = from;
  double reach = corners[from].dot(direction);
  if (corners.size() <= kFewCorners) {
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const double next = corners[i].dot(direction);
      if (next > reach) {
        reach = next;
        best = i;
      }
    }
    return best;
  }
  for (std::uint32_t at = from;; at = best) {
    for (std::uint32_t i = start[at]; i < start[at + 1]; ++i) {
      const double next = corners[neighbours[i]].dot(direction);
      if (next > reach) {
        reach = next;
        best = neighbours[i];
      }
    }
    if (best == at) return best;
  }
}

ConvexPart make_part(const Hull& hull) {
  ConvexPart part;
  part.corners = hull.corners;
  part.low = part.high = part.corners.front();
  for (const Vector3& corner : part.corners) {
    part.low = part.low.cwiseMin(corner);
    part.high = part.high.cwiseMax(corner);
    part.centre += corner / static_cast<double>(part.corners.size());
  }
  part.size = (part.high - part.low).norm();
  for (const Vector3& corner : part.corners) part.reach = std::max(part.reach, (corner - part.centre).norm());
  FaceFinder(hull, part).find();
  list_neighbours(hull, part);
  list_faces(part);
  return part;
}

}  // namespace bubblesim
