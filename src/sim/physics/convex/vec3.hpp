// SPDX-License-Identifier: BSD-3-Clause
// Plain vectors for the inner loops of collision detection: ignition's have a table of virtual functions each.
#pragma once

#include <ode/ode.h>

#include <cmath>

namespace bubblesim {

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Vec3 unit(const Vec3& a) {
  const double size = length(a);
  return size > 0 ? a * (1 / size) : a;
}
/// Some direction across `a`, which is not zero.
inline Vec3 across(const Vec3& a) {
  return std::abs(a.x) < 0.6 * length(a) ? unit(cross(a, {1, 0, 0})) : unit(cross(a, {0, 1, 0}));
}

/// A rigid transform from the frame of a shape to the world.
struct Transform {
  Vec3 origin;
  Vec3 x{1, 0, 0};
  Vec3 y{0, 1, 0};
  Vec3 z{0, 0, 1};

  Vec3 turn(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 turn_back(const Vec3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  Vec3 place(const Vec3& p) const { return origin + turn(p); }
  Vec3 place_back(const Vec3& p) const { return turn_back(p - origin); }
};

/// The transform that applies `inner` first.
inline Transform operator*(const Transform& outer, const Transform& inner) {
  return {outer.place(inner.origin), outer.turn(inner.x), outer.turn(inner.y), outer.turn(inner.z)};
}
inline Transform inverse(const Transform& t) {
  Transform back{{}, {t.x.x, t.y.x, t.z.x}, {t.x.y, t.y.y, t.z.y}, {t.x.z, t.y.z, t.z.z}};
  back.origin = -back.turn(t.origin);
  return back;
}

/// The transform of ODE's position and 3x4 rotation.
inline Transform frame_of(const dReal* position, const dReal* r) {
  return {{position[0], position[1], position[2]}, {r[0], r[4], r[8]}, {r[1], r[5], r[9]}, {r[2], r[6], r[10]}};
}

}  // namespace bubblesim
