// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/near_shapes.hpp"

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

constexpr double kMargin = 0.5;  // of the region around a model, as a part of the diagonal of its box

}  // namespace

const std::vector<NearShapes::Shape>& NearShapes::around(const Eigen::AlignedBox3d& model, const Spaces& spaces) {
  if (changes_ == spaces.changes && region_.contains(model)) return shapes_;
  changes_ = spaces.changes;
  const Vector3 margin = Vector3::Constant(kMargin * model.diagonal().norm());
  region_ = {model.min() - margin, model.max() + margin};
  search(spaces);
  return shapes_;
}

void NearShapes::search(const Spaces& spaces) {
  shapes_.clear();
  const Vector3 size = region_.sizes();
  const Vector3 centre = region_.center();
  const ode::GeomHandle probe(dCreateBox(nullptr, size.x(), size.y(), size.z()));
  dGeomSetPosition(probe.get(), centre.x(), centre.y(), centre.z());
  struct Found {
    dGeomID probe;
    std::vector<Shape>& shapes;
  } found{probe.get(), shapes_};
  const auto add = [](void* data, dGeomID first, dGeomID second) {
    auto& [asked, shapes] = *static_cast<Found*>(data);
    dGeomID other = first == asked ? second : first;
    shapes.emplace_back(other, box_of(other));
  };
  for (dSpaceID space : {spaces.sleepers.get(), spaces.statics.get()}) {
    if (space != nullptr) dSpaceCollide2(probe.get(), reinterpret_cast<dGeomID>(space), &found, add);
  }
}

}  // namespace bubblesim
