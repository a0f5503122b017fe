// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/touches.hpp"

#include "physics/ode/ode_math.hpp"
#include "physics/parts/collider.hpp"

namespace bubblesim {
namespace {

void add_points(Touch& touch, const FoundContact* points, int count, double sign, double step) {
  touch.points.clear();
  for (int i = 0; i < count; ++i) {
    const Vector3 force = points[i].force * sign;
    const dContactGeom& geom = points[i].contact.geom;
    touch.impulse += force * step;
    touch.points.push_back({to_vector(geom.pos), to_vector(geom.normal) * sign, geom.depth, force});
  }
}

}  // namespace

void Touches::clear() {
  all.clear();
  substeps = 0;
}

Touch& Touches::touch(const Collider* watched, const Collider* other) {
  // A substep has the pairs in the order of the one before, and each once.
  for (std::size_t i = 0; substeps > 1 && i < all.size(); ++i) {
    Touch& touch = all[(next_ + i) % all.size()];
    if (touch.watched != watched || touch.other != other) continue;
    next_ = (next_ + i + 1) % all.size();
    return touch;
  }
  Touch& touch = all.emplace_back();
  touch.watched = watched;
  touch.other = other;
  return touch;
}

void Touches::add(const FoundContacts& found, double step) {
  ++substeps;
  next_ = 0;
  for (const FoundPair& pair : found.pairs) {
    const auto add = [&](const Collider* watched, const Collider* other, double sign) {
      if (!watched->watched) return;
      Touch& touched = touch(watched, other);
      touched.substep = substeps;
      add_points(touched, &found.points[pair.begin], pair.count, sign, step);
    };
    add(pair.first, pair.second, 1);  // the normal points into the first shape
    add(pair.second, pair.first, -1);
  }
}

}  // namespace bubblesim
