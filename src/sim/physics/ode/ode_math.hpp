// SPDX-License-Identifier: BSD-3-Clause
// Vectors, quaternions and matrices in ODE's memory: quaternions are w, x, y, z, and matrices have rows of four.
#pragma once

#include <ode/ode.h>

#include <array>

#include "bubblesim/math.hpp"
#include "scene/transform.hpp"

namespace bubblesim {

inline Vector3 to_vector(const dReal* values) { return {values[0], values[1], values[2]}; }

inline Quaternion to_quaternion(const dReal* values) { return {values[0], values[1], values[2], values[3]}; }

inline Matrix3 to_matrix(const dReal* values) {
  return Eigen::Map<const Eigen::Matrix<dReal, 3, 3, Eigen::RowMajor>, Eigen::Unaligned, Eigen::OuterStride<4>>(values);
}

/// Of a shape in the world.
inline Transform geom_transform(dGeomID geom) {
  return {to_vector(dGeomGetPosition(geom)), to_matrix(dGeomGetRotation(geom))};
}

/// The box with the axes of the world around a shape, or around those of a space.
inline Eigen::AlignedBox3d box_of(dGeomID geom) {
  dReal box[6];
  dGeomGetAABB(geom, box);
  return {Vector3(box[0], box[2], box[4]), Vector3(box[1], box[3], box[5])};
}

/// Of a body's centre of mass in the world.
inline Transform body_transform(dBodyID body) {
  return {to_vector(dBodyGetPosition(body)), to_matrix(dBodyGetRotation(body))};
}

inline std::array<dReal, 4> to_ode(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Pose of a body; its origin is the centre of mass.
inline Pose body_pose(dBodyID body) {
  return {to_vector(dBodyGetPosition(body)), to_quaternion(dBodyGetQuaternion(body))};
}

/// Velocity of the centre of mass.
inline Twist body_velocity(dBodyID body) {
  return {to_vector(dBodyGetLinearVel(body)), to_vector(dBodyGetAngularVel(body))};
}

/// The moments of inertia of a body about its centre of mass, kg m^2, body axes.
inline Matrix3 inertia_of(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return to_matrix(mass.I);
}

}  // namespace bubblesim
