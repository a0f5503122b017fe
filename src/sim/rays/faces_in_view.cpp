// SPDX-License-Identifier: BSD-3-Clause
#include "rays/faces_in_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

#include "rays/flat_faces.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim::rays {
namespace {

constexpr double kAnywhere = std::numeric_limits<double>::infinity();
constexpr ImageArea kWholeImage{-kAnywhere, kAnywhere, -kAnywhere, kAnywhere};

struct Range {
  double least;
  double most;
};

/// The values of a line in an area.
Range values(const Linear& line, const ImageArea& area) {
  const double a = line.x * area.right;
  const double b = line.x * area.left;
  const double c = line.y * area.down;
  const double d = line.y * area.up;
  return {line.constant + std::min(a, b) + std::min(c, d), line.constant + std::max(a, b) + std::max(c, d)};
}

Linear linear(const Vector3& factors) { return {factors.x(), factors.y(), factors.z()}; }

/// The area of an image in which a sphere is, or a larger one.
ImageArea area_of(const Vector3& middle, double reach) {
  const double nearest = middle.x() - reach;
  if (nearest <= 0) return kWholeImage;
  const double farthest = middle.x() + reach;
  const auto least = [&](double value) { return value / (value < 0 ? nearest : farthest); };
  const auto most = [&](double value) { return value / (value > 0 ? nearest : farthest); };
  return {least(middle.y() - reach), most(middle.y() + reach), least(middle.z() - reach), most(middle.z() + reach)};
}

bool is_in_view(const Pinhole& view, const Vector3& middle, double reach) {
  if (middle.x() + reach < view.near || middle.x() - reach > view.far) return false;
  const auto beside = [&](double offset, double border) {
    return std::abs(offset) - border * middle.x() > reach * std::sqrt(1 + border * border);
  };
  return !beside(middle.y(), view.left) && !beside(middle.z(), view.up);
}

bool are_apart(const ImageArea& a, const ImageArea& b) {
  return a.left < b.right || a.right > b.left || a.up < b.down || a.down > b.up;
}

}  // namespace

/// A shape, for hits of its faces.
struct FacesInView::Placed {
  Matrix3 to_hit;  // turns the camera's axes to those of the hits
  unsigned geometry;
  unsigned instance;
};

void FacesInView::start(const Pinhole& view) {
  view_ = view;
  lines_.clear();
  faces_.clear();
  order_.clear();
  others_.clear();
  rounds_.clear();
  triangles_ = 0;
}

void FacesInView::add(const RayShape& shape, const Transform* frame, unsigned geometry, unsigned instance) {
  const Vector3 middle_in_world = frame != nullptr ? *frame * shape.middle : shape.middle;
  const Vector3 middle = view_.turn.transpose() * (middle_in_world - view_.eye);
  if (!is_in_view(view_, middle, shape.reach)) return;
  const Transform of_shape(shape.pose.position, shape.turn);
  const Transform in_world = frame != nullptr ? *frame * of_shape : of_shape;
  const Matrix3 back = view_.turn.transpose();
  const Transform place(back * (in_world.position - view_.eye), back * in_world.rotation);
  const Placed placed{frame != nullptr ? Matrix3(frame->rotation.transpose() * view_.turn) : view_.turn, geometry,
                      instance};
  const auto take = [&](const Vector3* corners, std::size_t count, std::size_t number) {
    add_face(corners, count, placed, static_cast<unsigned>(number));
  };
  if (const auto* box = std::get_if<Box>(&shape.geometry)) return for_each_face(*box, place, take);
  if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
    const std::size_t triangles = mesh->triangles->triangles.size();
    if (triangles_ + triangles <= most_triangles(view_.pixels)) {
      triangles_ += triangles;
      return for_each_face(*mesh->triangles, place, take);
    }
  } else if (is_inside(-(place.rotation.transpose() * place.position), shape.geometry)) {
    return;
  }
  const double nearest = middle.x() - shape.reach;
  const Other extent{area_of(middle, shape.reach), nearest > 0 ? 1 / nearest : kAnywhere};
  if (std::holds_alternative<Mesh>(shape.geometry)) {
    others_.push_back(extent);
  } else {
    rounds_.push_back({extent, placed_round(shape, in_world, geometry, instance)});
  }
}

void FacesInView::add(const PlaneEquation& plane, unsigned geometry, unsigned instance) {
  const double height = plane.normal.dot(view_.eye) - plane.offset;
  if (height <= 0) return;
  ImageFace lines;
  lines.nearness = linear(view_.turn.transpose() * plane.normal / -height);
  lines_.push_back(lines);
  Face face{kWholeImage, kAnywhere, {}, geometry, instance, 0, false};
  Eigen::Vector3f::Map(face.normal) = plane.normal.cast<float>();
  faces_.push_back(face);
}

/// The corners run counter-clockwise as seen from the front.
void FacesInView::add_face(const Vector3* corners, std::size_t count, const Placed& placed, unsigned primitive) {
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double behind = normal.dot(corners[0]);
  if (!(behind < 0)) return;
  ImageArea bounds{kAnywhere, -kAnywhere, kAnywhere, -kAnywhere};
  double least = kAnywhere;
  double most = -kAnywhere;
  for (std::size_t i = 0; i < count; ++i) {
    const double depth = corners[i].x();
    least = std::min(least, depth);
    most = std::max(most, depth);
    bounds.right = std::min(bounds.right, corners[i].y() / depth);
    bounds.left = std::max(bounds.left, corners[i].y() / depth);
    bounds.down = std::min(bounds.down, corners[i].z() / depth);
    bounds.up = std::max(bounds.up, corners[i].z() / depth);
  }
  if (most < view_.near || least > view_.far) return;
  if (least <= 0) bounds = kWholeImage;
  if (are_apart(bounds, {-view_.left, view_.left, -view_.up, view_.up})) return;
  const double nearest = least > 0 ? 1 / least : kAnywhere;
  if (faces_.size() > std::numeric_limits<std::uint16_t>::max()) {
    others_.push_back({bounds, nearest});
    return;
  }
  ImageFace lines;
  for (std::size_t i = 0; i < count; ++i) lines.sides[i] = linear(corners[(i + 1) % count].cross(corners[i]));
  lines.nearness = linear(normal / behind);
  lines_.push_back(lines);
  Face face{bounds, nearest, {}, placed.geometry, placed.instance, primitive, count == 3};
  Eigen::Vector3f::Map(face.normal) = (placed.to_hit * normal.normalized()).cast<float>();
  faces_.push_back(face);
}

void FacesInView::sort() {
  order_.resize(faces_.size());
  std::iota(order_.begin(), order_.end(), std::uint16_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [this](std::uint16_t a, std::uint16_t b) { return faces_[a].nearest > faces_[b].nearest; });
}

/// Calls `look` for the tiles in an area.
template <class Look>
void FacesInView::for_each_tile(const ImageArea& area, const ImageArea& rows, const std::vector<double>& borders,
                                std::vector<Tile>& tiles, const Look& look) {
  if (area.up < rows.down || area.down > rows.up) return;
  const auto right_of = [&](double left) { return [left](double border) { return border > left; }; };
  const auto first =
      std::partition_point(borders.begin() + 1, borders.end(), right_of(area.left)) - borders.begin() - 1;
  for (auto i = static_cast<std::size_t>(first); i < tiles.size() && borders[i] >= area.right; ++i) {
    look(tiles[i], ImageArea{borders[i + 1], borders[i], rows.down, rows.up});
  }
}

void FacesInView::divide(double down, double up, const std::vector<double>& borders, std::vector<Tile>& tiles) const {
  tiles.assign(borders.size() - 1, {});
  const ImageArea rows{0, 0, down, up};
  for (const std::uint16_t index : order_) {
    for_each_tile(faces_[index].bounds, rows, borders, tiles,
                  [&](Tile& tile, const ImageArea& area) { add_to_tile(index, area, tile); });
  }
  for (std::size_t i = 0; i < rounds_.size(); ++i) {
    for_each_tile(rounds_[i].extent.bounds, rows, borders, tiles, [&](Tile& tile, const ImageArea&) {
      if (rounds_[i].extent.nearest < tile.filled_to) return;
      if (tile.round_count == Tile::kMostRounds) {
        tile.needs_rays = true;
      } else {
        tile.rounds[tile.round_count++] = static_cast<std::uint32_t>(i);
      }
    });
  }
  for (const Other& other : others_) {
    for_each_tile(other.bounds, rows, borders, tiles, [&](Tile& tile, const ImageArea&) {
      if (other.nearest >= tile.filled_to) tile.needs_rays = true;
    });
  }
}

void FacesInView::add_to_tile(std::uint16_t index, const ImageArea& area, Tile& tile) const {
  const ImageFace& face = lines_[index];
  const Range nearness = values(face.nearness, area);
  if (nearness.most <= 0 || nearness.most < tile.filled_to) return;
  bool fills = nearness.least >= 1 / view_.far && nearness.most <= 1 / view_.near;
  for (const Linear& side : face.sides) {
    const Range inner = values(side, area);
    if (inner.most < 0) return;
    fills = fills && inner.least >= 0;
  }
  if (tile.count == Tile::kMostFaces) {
    tile.needs_rays = true;
    return;
  }
  tile.is_filled = fills && tile.count == 0;
  tile.faces[tile.count++] = index;
  if (fills) tile.filled_to = std::max(tile.filled_to, nearness.least);
}

void FacesInView::rasterize(const Tile& tile, double up, const double* left, RayPacket& packet) const {
  if (tile.count > 0) rasterize_faces(tile, up, left, packet);
  for (std::size_t i = 0; i < tile.round_count; ++i) {
    meet_round(rounds_[tile.rounds[i]].shape, packet.mask, packet.data);
  }
}

void FacesInView::rasterize_faces(const Tile& tile, double up, const double* left, RayPacket& packet) const {
  NearestFaces seen;
  find_nearest_faces(lines_.data(), tile.faces.data(), tile.count, {1 / view_.far, 1 / view_.near}, up, left, seen);
  keep_depths(seen, static_cast<float>(view_.far), packet.data.ray.tfar);
  RTCHit16& hit = packet.data.hit;
  const auto set_hit = [&hit](std::size_t i, const Face& face) {
    hit.Ng_x[i] = face.normal[0];
    hit.Ng_y[i] = face.normal[1];
    hit.Ng_z[i] = face.normal[2];
    hit.primID[i] = face.primitive;
    hit.geomID[i] = face.geometry;
    hit.instID[0][i] = face.instance;
  };
  const Face& first = faces_[tile.faces[0]];
  bool has_triangles = tile.is_filled && first.is_triangle;
  for (std::size_t i = 0; i < kPacket && tile.is_filled; ++i) set_hit(i, first);
  for (std::size_t i = 0; i < kPacket && !tile.is_filled; ++i) {
    if (seen.face[i] < 0) continue;
    const Face& face = faces_[tile.faces[static_cast<std::size_t>(seen.face[i])]];
    set_hit(i, face);
    has_triangles = has_triangles || face.is_triangle;
  }
  if (has_triangles) place_in_triangles(tile, seen, up, left, hit);
}

/// Sets the places in triangles as Embree: the parts of the second and third corner.
void FacesInView::place_in_triangles(const Tile& tile, const NearestFaces& seen, double up, const double* left,
                                     RTCHit16& hit) const {
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (seen.face[i] < 0) continue;
    const ImageFace& face = lines_[tile.faces[static_cast<std::size_t>(seen.face[i])]];
    std::array<double, 3> opposite;  // of each side: the part of the corner that is not on it, times their sum
    for (std::size_t side = 0; side < opposite.size(); ++side) {
      const Linear& line = face.sides[side];
      opposite[side] = line.constant + line.x * left[i] + line.y * up;
    }
    const double sum = opposite[0] + opposite[1] + opposite[2];
    hit.u[i] = static_cast<float>(opposite[2] / sum);
    hit.v[i] = static_cast<float>(opposite[0] / sum);
  }
}

}  // namespace bubblesim::rays
