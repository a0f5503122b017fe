// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/convex_shape.hpp"

#include <algorithm>
#include <cmath>

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

constexpr int kRimPoints = 16;       // of a cylinder's end
constexpr double kFacesEnd = 0.707;  // cosine to its axis above which an end of a cylinder faces the direction

double signed_half(double half, double direction) { return direction < 0 ? -half : half; }

}  // namespace

bool ConvexShape::knows(dGeomID geom) {
  const int kind = dGeomGetClass(geom);
  return kind == dBoxClass || kind == dSphereClass || kind == dCapsuleClass || kind == dCylinderClass;
}

ConvexShape::ConvexShape(dGeomID geom) : core_(Core::kPoint), frame_(geom_transform(geom)) {
  double length = 0;
  switch (dGeomGetClass(geom)) {
    case dBoxClass: {
      core_ = Core::kBox;
      dVector3 size;
      dGeomBoxGetLengths(geom, size);
      half_ = to_vector(size) / 2;
      break;
    }
    case dCapsuleClass:
      core_ = Core::kSegment;
      dGeomCapsuleGetParams(geom, &rounding_, &length);
      half_ = {0, 0, length / 2};
      break;
    case dCylinderClass:
      core_ = Core::kCylinder;
      dGeomCylinderGetParams(geom, &half_.x(), &length);
      half_.z() = length / 2;
      break;
    default:
      rounding_ = dGeomSphereGetRadius(geom);
  }
  reach_ = half_.norm() + rounding_;
}

ConvexShape::ConvexShape(const ConvexPart& part, const Transform& frame)
    : core_(Core::kPart), frame_(frame), half_(part.centre), part_(&part) {
  frame_.position = frame * part.centre;
  reach_ = part.reach;
}

ConvexShape::ConvexShape(const std::array<Vector3, 3>& corners) : core_(Core::kTriangle), triangle_(corners) {
  frame_.position = (corners[0] + corners[1] + corners[2]) / 3;
  for (Vector3& corner : triangle_) {
    corner -= frame_.position;
    reach_ = std::max(reach_, corner.norm());
  }
}

void ConvexShape::shrink(double margin) {
  if (core_ == Core::kBox) half_ -= Vector3::Constant(margin);
  if (core_ == Core::kCylinder) half_ -= Vector3(margin, 0, margin);
  if (core_ == Core::kPoint || core_ == Core::kSegment) rounding_ -= margin;
  if (core_ != Core::kPart) return;
  const Vector3 size = part_->high - part_->low;
  scale_ = Vector3::Ones() - 2 * margin * size.cwiseInverse();
}

Vector3 ConvexShape::support(const Vector3& direction) const {
  return frame_ * local_support(frame_.rotation.transpose() * direction);
}

Vector3 ConvexShape::local_support(const Vector3& direction) const {
  switch (core_) {
    case Core::kPoint:
      return {};
    case Core::kSegment:
      return {0, 0, signed_half(half_.z(), direction.z())};
    case Core::kBox:
      return {signed_half(half_.x(), direction.x()), signed_half(half_.y(), direction.y()),
              signed_half(half_.z(), direction.z())};
    case Core::kCylinder: {
      const double across = std::hypot(direction.x(), direction.y());
      const double scale = across > 0 ? half_.x() / across : 0;
      return {direction.x() * scale, direction.y() * scale, signed_half(half_.z(), direction.z())};
    }
    case Core::kPart:
      near_ = part_->farthest(direction.cwiseProduct(scale_), near_);
      return (part_->corners[near_] - half_).cwiseProduct(scale_);
    case Core::kTriangle:
      break;
  }
  const auto nearer = [&](const Vector3& a, const Vector3& b) { return a.dot(direction) < b.dot(direction); };
  return *std::max_element(triangle_.begin(), triangle_.end(), nearer);
}

void ConvexShape::feature(const Vector3& direction, Feature& result) const {
  result.corners.clear();
  const Vector3 local = frame_.rotation.transpose() * direction;
  switch (core_) {
    case Core::kPoint:
      result.corners.push_back({});
      break;
    case Core::kSegment:
      result.corners.insert(result.corners.end(), {{0, 0, -half_.z()}, {0, 0, half_.z()}});
      break;
    case Core::kBox:
      box_face(local, result);
      break;
    case Core::kCylinder:
      cylinder_face(local, result);
      break;
    case Core::kPart:
      part_face(local, result);
      break;
    case Core::kTriangle: {
      result.normal = (triangle_[1] - triangle_[0]).cross(triangle_[2] - triangle_[0]).normalized();
      result.corners.assign(triangle_.begin(), triangle_.end());
      if (result.normal.dot(local) >= 0) break;
      result.normal = -result.normal;
      std::swap(result.corners[1], result.corners[2]);
      break;
    }
  }
  for (Vector3& corner : result.corners) corner = frame_ * corner + direction * rounding_;
  result.normal = frame_.rotation * result.normal;
}

void ConvexShape::box_face(const Vector3& direction, Feature& result) const {
  const double x = std::abs(direction.x());
  const double y = std::abs(direction.y());
  const double z = std::abs(direction.z());
  Vector3 u{half_.x(), 0, 0};
  Vector3 v{0, half_.y(), 0};
  Vector3 out{0, 0, 1};
  double height = half_.z();
  if (x >= y && x >= z) {
    u = {0, half_.y(), 0};
    v = {0, 0, half_.z()};
    out = {1, 0, 0};
    height = half_.x();
  } else if (y >= z) {
    u = {0, 0, half_.z()};
    v = {half_.x(), 0, 0};
    out = {0, 1, 0};
    height = half_.y();
  }
  if (out.dot(direction) < 0) {
    out = -out;
    std::swap(u, v);
  }
  const Vector3 middle = out * height;
  result.normal = out;
  result.corners.insert(result.corners.end(), {middle - u - v, middle + u - v, middle + u + v, middle - u + v});
}

void ConvexShape::cylinder_face(const Vector3& direction, Feature& result) const {
  const double side = direction.z() < 0 ? -1 : 1;
  if (std::abs(direction.z()) > kFacesEnd) {
    result.normal = {0, 0, side};
    // From the point that is lowest, so that a tilted cylinder has it.
    const double first = std::atan2(direction.y(), direction.x());
    for (int i = 0; i < kRimPoints; ++i) {
      const double angle = first + side * 2 * M_PI * i / kRimPoints;
      result.corners.push_back({half_.x() * std::cos(angle), half_.x() * std::sin(angle), side * half_.z()});
    }
    return;
  }
  const double scale = half_.x() / std::hypot(direction.x(), direction.y());
  const Vector3 on_side{direction.x() * scale, direction.y() * scale, 0};
  result.corners.insert(result.corners.end(), {on_side - Vector3(0, 0, half_.z()), on_side + Vector3(0, 0, half_.z())});
}

void ConvexShape::part_face(const Vector3& direction, Feature& result) const {
  near_ = part_->farthest(direction.cwiseProduct(scale_), near_);
  const auto first = part_->faces_at.begin();
  const auto facing = [&](std::uint32_t a, std::uint32_t b) {
    return part_->faces[a].normal.dot(direction) < part_->faces[b].normal.dot(direction);
  };
  const auto best = std::max_element(first + part_->face_start[near_], first + part_->face_start[near_ + 1], facing);
  const ConvexPart::Face& face = part_->faces[*best];
  result.normal = face.normal;
  for (std::uint32_t i = 0; i < face.count; ++i) {
    result.corners.push_back((part_->corners[part_->loops[face.first + i]] - half_).cwiseProduct(scale_));
  }
}

}  // namespace bubblesim
