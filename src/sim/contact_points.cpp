// SPDX-License-Identifier: BSD-3-Clause
#include "contact_points.hpp"

#include <algorithm>
#include <mutex>
#include <vector>

namespace bubblesim {
namespace {

// A face of a mesh may touch with many corners, and ODE gives them in the order of the file: the first eight may all
// lie on one side, and the body tips over them.
constexpr int kMaxMeshContacts = 1024;

bool is_mesh(dGeomID geom) { return dGeomGetClass(geom) == dTriMeshClass; }

double squared_distance(const dContactGeom& a, const dContactGeom& b) {
  const double x = a.pos[0] - b.pos[0];
  const double y = a.pos[1] - b.pos[1];
  const double z = a.pos[2] - b.pos[2];
  return x * x + y * y + z * z;
}

/// The deepest, then each time the one farthest from those taken.
int spread(std::vector<dContactGeom>& found, int count, ContactPoints& points) {
  const auto end = found.begin() + count;
  const auto deepest = std::max_element(found.begin(), end,
                                        [](const dContactGeom& a, const dContactGeom& b) { return a.depth < b.depth; });
  points[0] = *deepest;
  std::vector<double> distance(static_cast<std::size_t>(count), dInfinity);
  for (std::size_t taken = 1; taken < points.size(); ++taken) {
    for (std::size_t i = 0; i < distance.size(); ++i) {
      distance[i] = std::min(distance[i], squared_distance(found[i], points[taken - 1]));
    }
    points[taken] =
        found[static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin())];
  }
  return kMaxContactsPerPair;
}

}  // namespace

int find_contact_points(dGeomID first, dGeomID second, ContactPoints& points) {
  if (!is_mesh(first) && !is_mesh(second)) {
    return dCollide(first, second, kMaxContactsPerPair, points.data(), sizeof(dContactGeom));
  }
  // Debian's ODE keeps what it needs for meshes once for the process.
  static std::mutex mutex;
  static std::vector<dContactGeom> found(kMaxMeshContacts);
  const std::scoped_lock lock(mutex);
  const int count = dCollide(first, second, kMaxMeshContacts, found.data(), sizeof(dContactGeom));
  if (count > kMaxContactsPerPair) return spread(found, count, points);
  std::copy_n(found.begin(), count, points.begin());
  return count;
}

}  // namespace bubblesim
