// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "physics/contacts/convex_geom.hpp"

namespace bubblesim {
namespace {

// A face of a mesh may touch with many corners, in the order of the file: the first eight may all lie on one side, and
// the body would tip over them.
constexpr int kMaxMeshContacts = 1024;

bool is_mesh(dGeomID geom) { return dGeomGetClass(geom) == dTriMeshClass; }

double squared_distance(const dContactGeom& a, const dContactGeom& b) {
  const double x = a.pos[0] - b.pos[0];
  const double y = a.pos[1] - b.pos[1];
  const double z = a.pos[2] - b.pos[2];
  return x * x + y * y + z * z;
}

}  // namespace

std::vector<std::size_t> spread(const std::vector<dContactGeom>& points, std::size_t most) {
  const auto place = [](const auto& values, auto at) { return static_cast<std::size_t>(at - values.begin()); };
  const auto shallower = [](const dContactGeom& a, const dContactGeom& b) { return a.depth < b.depth; };
  std::vector<std::size_t> taken = {place(points, std::max_element(points.begin(), points.end(), shallower))};
  std::vector<double> distance(points.size(), dInfinity);
  while (taken.size() < most) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      distance[i] = std::min(distance[i], squared_distance(points[i], points[taken.back()]));
    }
    taken.push_back(place(distance, std::max_element(distance.begin(), distance.end())));
  }
  return taken;
}

namespace {

/// Selects points for a pair; returns their number.
int take_spread(const std::vector<dContactGeom>& found, ContactPoints& points) {
  if (found.size() <= points.size()) {
    std::copy(found.begin(), found.end(), points.begin());
    return static_cast<int>(found.size());
  }
  const std::vector<std::size_t> apart = spread(found, points.size());
  std::transform(apart.begin(), apart.end(), points.begin(), [&](std::size_t i) { return found[i]; });
  return kMaxContactsPerPair;
}

/// Drops points whose normal is not a number, as ODE has it for a sphere in the middle of a cylinder: no direction
/// leads out. Returns how many stay.
int drop_undirected(ContactPoints& points, int count) {
  const auto end = points.begin() + count;
  const auto has_no_normal = [](const dContactGeom& point) {
    return !std::isfinite(point.normal[0] + point.normal[1] + point.normal[2]);
  };
  return static_cast<int>(std::remove_if(points.begin(), end, has_no_normal) - points.begin());
}

}  // namespace

int find_contact_points(dGeomID first, dGeomID second, ContactPoints& points) {
  if (is_convex_geom(first) || is_convex_geom(second)) {
    thread_local std::vector<dContactGeom> all;
    find_convex_contacts(first, second, all);
    return take_spread(all, points);
  }
  if (!is_mesh(first) && !is_mesh(second)) {
    const int count = dCollide(first, second, kMaxContactsPerPair, points.data(), sizeof(dContactGeom));
    return drop_undirected(points, count);
  }
  // Debian's ODE shares the working memory for meshes in the process.
  static std::mutex mutex;
  static std::vector<dContactGeom> found;
  const std::scoped_lock lock(mutex);
  found.resize(kMaxMeshContacts);
  const int count = dCollide(first, second, kMaxMeshContacts, found.data(), sizeof(dContactGeom));
  found.resize(static_cast<std::size_t>(count));
  return take_spread(found, points);
}

}  // namespace bubblesim
