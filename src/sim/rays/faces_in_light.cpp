// SPDX-License-Identifier: BSD-3-Clause
#include "rays/faces_in_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "rays/flat_faces.hpp"

namespace bubblesim::rays {
namespace {

constexpr std::size_t kCells = 64;      // along each side of the grid
constexpr double kReach = 32;           // m, at most, from the middle to the sides of the grid
constexpr double kLeastReach = 1.6;     // m: the pixels of a packet are in few cells
constexpr double kMargin = 1e-3;        // m, about what is in the grid
constexpr std::size_t kMostCells = 64;  // that the places of a packet may be in
constexpr std::size_t kMostFaces = 24;  // that may shade them
constexpr std::size_t kMostRounds = 8;  // likewise

/// A face whose width along the light is less than this part of it shades nothing.
constexpr double kEdgeOn = 1e-9;

Linear side_between(const Vector3& from, const Vector3& to) {
  return {from.x() * to.y() - to.x() * from.y(), from.y() - to.y(), to.x() - from.x()};
}

Linear turned_over(const Linear& side) { return {-side.constant, -side.x, -side.y}; }

/// Different things of several cells.
template <class Item, std::size_t most>
struct Found {
  std::size_t count = 0;
  std::array<Item, most> items;

  /// Returns false if it is full.
  bool add(Item item) {
    const auto end = items.begin() + count;
    if (std::find(items.begin(), end, item) != end) return true;
    if (count == most) return false;
    items[count++] = item;
    return true;
  }
};

bool can_shade(const LightBlock& face, const LightBlock& places) {
  return face.high[2] >= places.low[2] && face.low[0] <= places.high[0] && face.high[0] >= places.low[0] &&
         face.low[1] <= places.high[1] && face.high[1] >= places.low[1];
}

}  // namespace

void FacesInLight::start(const Vector3& to_light, const Vector3& middle, std::size_t pixels) {
  const Vector3 any = std::abs(to_light.x()) < 0.5 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 across = to_light.cross(any).normalized();
  turn_ << across.transpose(), to_light.cross(across).transpose(), to_light.transpose();
  middle_ = middle;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    frame_.middle[axis] = middle[axis];
    for (Eigen::Index part = 0; part < 3; ++part) frame_.axes[axis][part] = turn_(axis, part);
  }
  faces_.clear();
  bounds_.clear();
  rounds_.clear();
  round_bounds_.clear();
  others_.clear();
  most_triangles_ = most_triangles(pixels);
  triangles_ = 0;
  is_whole_ = true;
}

void FacesInLight::add(const RayShape& shape, const Transform* frame) {
  if (!shape.cast_shadows) return;
  const Vector3 middle = turn_ * ((frame != nullptr ? *frame * shape.middle : shape.middle) - middle_);
  if (std::max(std::abs(middle.x()), std::abs(middle.y())) - shape.reach > kReach) {
    is_whole_ = false;
    return;
  }
  LightBlock bounds;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    bounds.low[axis] = middle[axis] - shape.reach;
    bounds.high[axis] = middle[axis] + shape.reach;
  }
  const Transform of_shape(shape.pose.position, shape.turn);
  const Transform in_world = frame != nullptr ? *frame * of_shape : of_shape;
  const Transform place(turn_ * (in_world.position - middle_), turn_ * in_world.rotation);
  const auto* mesh = std::get_if<Mesh>(&shape.geometry);
  const std::size_t triangles = mesh != nullptr ? mesh->triangles->triangles.size() : 0;
  if (const auto* box = std::get_if<Box>(&shape.geometry); box != nullptr && !is_traced_as_round(shape)) {
    // What is below a face towards the light is in the shadow of the box, or in it.
    for_each_face(*box, place, [&](const Vector3* corners, std::size_t count, std::size_t) {
      if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).z() > 0) add_face(corners, count);
    });
  } else if (mesh != nullptr && triangles_ + triangles <= most_triangles_) {
    triangles_ += triangles;
    for_each_face(*mesh->triangles, place,
                  [&](const Vector3* corners, std::size_t count, std::size_t) { add_face(corners, count); });
  } else if (mesh != nullptr) {
    others_.push_back(bounds);
  } else {
    rounds_.push_back(placed_round(shape, in_world, 0, 0));
    round_bounds_.push_back(bounds);
  }
}

/// Either side of a face shades.
void FacesInLight::add_face(const Vector3* corners, std::size_t count) {
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (!(std::abs(normal.z()) > kEdgeOn * normal.norm())) return;
  LightBlock bounds;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    bounds.low[axis] = bounds.high[axis] = corners[0][axis];
    for (std::size_t i = 1; i < count; ++i) {
      bounds.low[axis] = std::min(bounds.low[axis], corners[i][axis]);
      bounds.high[axis] = std::max(bounds.high[axis], corners[i][axis]);
    }
  }
  if (faces_.size() > std::numeric_limits<std::uint16_t>::max()) {
    others_.push_back(bounds);
    return;
  }
  LightFace face;
  for (std::size_t i = 0; i < count; ++i) {
    const Linear side = side_between(corners[i], corners[(i + 1) % count]);
    face.sides[i] = normal.z() > 0 ? side : turned_over(side);
  }
  face.height = {normal.dot(corners[0]) / normal.z(), -normal.x() / normal.z(), -normal.y() / normal.z()};
  faces_.push_back(face);
  bounds_.push_back(bounds);
}

void FacesInLight::arrange() {
  double reach = 0;
  for (const std::vector<LightBlock>* all : {&bounds_, &round_bounds_, &others_}) {
    for (const LightBlock& bounds : *all) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        reach = std::max({reach, -bounds.low[axis], bounds.high[axis]});
      }
    }
  }
  is_whole_ = is_whole_ && reach < kReach;
  half_ = (is_whole_ ? std::max(reach, kLeastReach) : kReach) + kMargin;
  cells_.assign(kCells * kCells, {});
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    change_cells(bounds_[face], [&](Cell& cell) {
      if (cell.count == Cell::kMostFaces) {
        need_rays(bounds_[face], cell);
      } else {
        cell.faces[cell.count++] = static_cast<std::uint16_t>(face);
      }
    });
  }
  for (std::size_t round = 0; round < rounds_.size(); ++round) {
    change_cells(round_bounds_[round], [&](Cell& cell) {
      if (cell.round_count == Cell::kMostRounds) {
        need_rays(round_bounds_[round], cell);
      } else {
        cell.rounds[cell.round_count++] = static_cast<std::uint32_t>(round);
      }
    });
  }
  for (const LightBlock& bounds : others_) {
    change_cells(bounds, [&](Cell& cell) { need_rays(bounds, cell); });
  }
}

void FacesInLight::need_rays(const LightBlock& bounds, Cell& cell) {
  cell.top = cell.needs_rays ? std::max(cell.top, bounds.high[2]) : bounds.high[2];
  cell.needs_rays = true;
}

/// The cells that a block is over: the first ones, and those behind the last ones.
FacesInLight::CellRange FacesInLight::cells_of(const LightBlock& block) const {
  CellRange range{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (!(block.high[axis] >= -half_ && block.low[axis] <= half_)) return {};
    const auto cells_to = [&](double place) {
      return static_cast<std::size_t>(std::clamp((place + half_) / (2 * half_), 0.0, 1.0) * kCells);
    };
    range.first[axis] = cells_to(block.low[axis]);
    range.end[axis] = std::min(cells_to(block.high[axis]) + 1, kCells);
  }
  return range;
}

template <class Change>
void FacesInLight::change_cells(const LightBlock& block, const Change& change) {
  const CellRange range = cells_of(block);
  for (std::size_t y = range.first[1]; y < range.end[1]; ++y) {
    for (std::size_t x = range.first[0]; x < range.end[0]; ++x) change(cells_[y * kCells + x]);
  }
}

bool FacesInLight::shade(RTCRay16& rays, const RayMask& mask) const {
  if (is_whole_ && faces_.empty() && rounds_.empty() && others_.empty()) return true;
  LightPlaces places;
  place_in_light(frame_, rays, places);
  const LightBlock block = block_around(places, mask);
  const bool is_within =
      block.low[0] > -half_ && block.low[1] > -half_ && block.high[0] < half_ && block.high[1] < half_;
  if (!is_within && !is_whole_) return false;
  const CellRange range = cells_of(block);
  if ((range.end[0] - range.first[0]) * (range.end[1] - range.first[1]) > kMostCells) return false;
  Found<std::uint16_t, kMostFaces> faces;
  Found<std::uint32_t, kMostRounds> rounds;
  for (std::size_t y = range.first[1]; y < range.end[1]; ++y) {
    for (std::size_t x = range.first[0]; x < range.end[0]; ++x) {
      const Cell& cell = cells_[y * kCells + x];
      if (cell.needs_rays && cell.top >= block.low[2]) return false;
      for (std::size_t i = 0; i < cell.count; ++i) {
        if (can_shade(bounds_[cell.faces[i]], block) && !faces.add(cell.faces[i])) return false;
      }
      for (std::size_t i = 0; i < cell.round_count; ++i) {
        if (can_shade(round_bounds_[cell.rounds[i]], block) && !rounds.add(cell.rounds[i])) return false;
      }
    }
  }
  if (faces.count > 0) shade_below(faces_.data(), faces.items.data(), faces.count, places, mask, rays);
  for (std::size_t i = 0; i < rounds.count; ++i) shade_round(rounds_[rounds.items[i]], mask, rays);
  return true;
}

}  // namespace bubblesim::rays
