// SPDX-License-Identifier: BSD-3-Clause
// Convex shapes in the world as collision detection sees them: a core that is a polytope or a cylinder, rounded by a
// radius. A sphere is a rounded point, a capsule a rounded segment.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "physics/convex/convex_part.hpp"
#include "scene/transform.hpp"

namespace bubblesim {

/// A point, a segment, or a planar polygon on the surface of a shape, m, in the world.
struct Feature {
  std::vector<Vector3> corners;  // counter-clockwise from outside when there are three and more
  Vector3 normal;                // outwards, of a polygon
};

class ConvexShape {
 public:
  /// A box, sphere, capsule or cylinder of ODE. The geom must be of one of these classes.
  explicit ConvexShape(dGeomID geom);
  /// The part must outlive the shape.
  ConvexShape(const ConvexPart& part, const Transform& frame);
  /// A triangle, with its corners counter-clockwise from outside.
  explicit ConvexShape(const std::array<Vector3, 3>& corners);

  static bool knows(dGeomID geom);

  /// The point of the core that is farthest in a direction, which need not have length 1.
  Vector3 support(const Vector3& direction) const;
  /// The part of the surface, including the rounding, that faces a direction of length 1 best.
  void feature(const Vector3& direction, Feature& result) const;

  /// Moves each face of the shape inwards by a margin in m, which is less than half its smallest size.
  void shrink(double margin);

  double rounding() const { return rounding_; }
  /// A point inside.
  const Vector3& centre() const { return frame_.position; }
  /// Upper bound of the distance of its points from the centre, m.
  double reach() const { return reach_; }
  const Transform& frame() const { return frame_; }
  void set_frame(const Transform& frame) { frame_ = frame; }

 private:
  enum class Core { kPoint, kSegment, kBox, kCylinder, kPart, kTriangle };

  Vector3 local_support(const Vector3& direction) const;
  void box_face(const Vector3& direction, Feature& result) const;
  void cylinder_face(const Vector3& direction, Feature& result) const;
  void part_face(const Vector3& direction, Feature& result) const;

  Core core_;
  Transform frame_;
  Vector3 half_;  // of a box; the radius (x) and half the length (z) of a cylinder; half the length (z) of a segment
  double rounding_ = 0;
  double reach_ = 0;
  const ConvexPart* part_ = nullptr;
  Vector3 scale_{1, 1, 1};           // of the part, along its axes
  std::array<Vector3, 3> triangle_;  // in the shape's frame
  mutable std::uint32_t near_ = 0;   // corner of the part that was farthest last, where the next search starts
};

}  // namespace bubblesim
