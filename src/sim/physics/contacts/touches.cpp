// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/touches.hpp"

#include "physics/ode/ode_math.hpp"
#include "physics/parts/collider.hpp"

namespace bubblesim {
namespace {

Touch& touch_of(Touches& touches, const Collider* watched, const Collider* other) {
  for (Touch& touch : touches.all) {
    if (touch.watched == watched && touch.other == other) return touch;
  }
  Touch& touch = touches.all.emplace_back();
  touch.watched = watched;
  touch.other = other;
  return touch;
}

void add_point(Touches& touches, const FoundPair& pair, const FoundContact& found, bool of_first, double step) {
  Touch& touch = of_first ? touch_of(touches, pair.first, pair.second) : touch_of(touches, pair.second, pair.first);
  if (touch.substep != touches.substeps) touch.points.clear();
  touch.substep = touches.substeps;
  const double sign = of_first ? 1 : -1;  // the normal points into the first shape
  const Vector3 force = found.force * sign;
  const dContactGeom& geom = found.contact.geom;
  touch.impulse += force * step;
  touch.points.push_back({to_vector(geom.pos), to_vector(geom.normal) * sign, geom.depth, force});
}

}  // namespace

void Touches::clear() {
  all.clear();
  substeps = 0;
}

void Touches::add(const FoundContacts& found, double step) {
  ++substeps;
  for (const FoundPair& pair : found.pairs) {
    if (!pair.first->watched && !pair.second->watched) continue;
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      if (pair.first->watched) add_point(*this, pair, found.points[i], true, step);
      if (pair.second->watched) add_point(*this, pair, found.points[i], false, step);
    }
  }
}

}  // namespace bubblesim
