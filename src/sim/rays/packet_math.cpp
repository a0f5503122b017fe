// SPDX-License-Identifier: BSD-3-Clause
#include "rays/packet_math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "scene/simd.hpp"

namespace bubblesim::rays {
namespace {

BUBBLESIM_SIMD void turned(const double* r, const double* x, const double* y, const double* z, float* out) {
  for (std::size_t i = 0; i < kPacket; ++i) out[i] = static_cast<float>(r[0] * x[i] + r[1] * y[i] + r[2] * z[i]);
}

BUBBLESIM_SIMD void along_row(double base, double side, const double* left, float* out) {
  for (std::size_t i = 0; i < kPacket; ++i) out[i] = static_cast<float>(base + left[i] * side);
}

}  // namespace

void aim(RTCRay16& rays, const Matrix3& turn, const DirectionLanes& directions) {
  float* const out[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
  for (Eigen::Index row = 0; row < 3; ++row) {
    const Vector3 r = turn.row(row).transpose();
    turned(r.data(), directions.x, directions.y, directions.z, out[row]);
  }
}

void aim(RTCRay16& rays, const Vector3& base, const Vector3& side, const double* left) {
  along_row(base.x(), side.x(), left, rays.dir_x);
  along_row(base.y(), side.y(), left, rays.dir_y);
  along_row(base.z(), side.z(), left, rays.dir_z);
}

namespace {

BUBBLESIM_SIMD void meet(const double* normal, double offset, unsigned geometry, unsigned instance, const int* use,
                         RTCRayHit16& packet) {
  RTCRay16& ray = packet.ray;
  RTCHit16& hit = packet.hit;
  alignas(64) float distance[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    const double height = normal[0] * static_cast<double>(ray.org_x[i]) +
                          normal[1] * static_cast<double>(ray.org_y[i]) +
                          normal[2] * static_cast<double>(ray.org_z[i]) - offset;
    const double descent =
        -(normal[0] * static_cast<double>(ray.dir_x[i]) + normal[1] * static_cast<double>(ray.dir_y[i]) +
          normal[2] * static_cast<double>(ray.dir_z[i]));
    const double met = height / descent;
    const double kept = height < 0 ? std::numeric_limits<double>::infinity() : met;
    distance[i] = static_cast<float>(descent <= 0 ? std::numeric_limits<double>::infinity() : kept);
  }
  for (std::size_t i = 0; i < kPacket; ++i) {
    const bool met = (use[i] != 0) & (distance[i] >= ray.tnear[i]) & (distance[i] < ray.tfar[i]);
    ray.tfar[i] = met ? distance[i] : ray.tfar[i];
    hit.geomID[i] = met ? geometry : hit.geomID[i];
    hit.instID[0][i] = met ? instance : hit.instID[0][i];
  }
}

BUBBLESIM_SIMD bool reach_sphere(const RTCRay16& ray, const int* use, const double* centre, double radius, int* can) {
  alignas(64) float margin[kPacket];  // negative: the sphere is out of reach
  for (std::size_t i = 0; i < kPacket; ++i) {
    const double x = centre[0] - static_cast<double>(ray.org_x[i]);
    const double y = centre[1] - static_cast<double>(ray.org_y[i]);
    const double z = centre[2] - static_cast<double>(ray.org_z[i]);
    const double dx = ray.dir_x[i];
    const double dy = ray.dir_y[i];
    const double dz = ray.dir_z[i];
    const double along = x * dx + y * dy + z * dz;
    const double square = dx * dx + dy * dy + dz * dz;
    const double end = static_cast<double>(ray.tfar[i]) * square;
    const double ahead = along < 0 ? 0 : along;
    const double nearest = (ahead < end ? ahead : end) / square;
    const double rx = x - nearest * dx;
    const double ry = y - nearest * dy;
    const double rz = z - nearest * dz;
    margin[i] = static_cast<float>(radius * radius - (rx * rx + ry * ry + rz * rz));
  }
  int any = 0;
  for (std::size_t i = 0; i < kPacket; ++i) {
    can[i] = margin[i] >= 0 ? use[i] : 0;
    any |= can[i];
  }
  return any != 0;
}

/// The least cosine between the used rays and an axis.
BUBBLESIM_SIMD float least_cosine(const RTCRay16& rays, const int* use, const float* axis) {
  alignas(64) float cosine[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    const float x = rays.dir_x[i];
    const float y = rays.dir_y[i];
    const float z = rays.dir_z[i];
    const float along = x * axis[0] + y * axis[1] + z * axis[2];
    cosine[i] = use[i] != 0 ? along / std::sqrt(x * x + y * y + z * z) : 1;
  }
  // Positive numbers are in the order of their bits, and negative ones below them: whole numbers have a least one that
  // is found sixteen at a time.
  alignas(64) std::int32_t bits[kPacket];
  std::memcpy(bits, cosine, sizeof bits);
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < kPacket; ++i) least = bits[i] < least ? bits[i] : least;
  float found = 0;
  std::memcpy(&found, &least, sizeof found);
  return found;
}

BUBBLESIM_SIMD void turn_rays(const double* columns, const double* p, const RTCRay16& rays, RTCRay16& turned) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    const double x = static_cast<double>(rays.org_x[i]) - p[0];
    const double y = static_cast<double>(rays.org_y[i]) - p[1];
    const double z = static_cast<double>(rays.org_z[i]) - p[2];
    turned.org_x[i] = static_cast<float>(columns[0] * x + columns[1] * y + columns[2] * z);
    turned.org_y[i] = static_cast<float>(columns[3] * x + columns[4] * y + columns[5] * z);
    turned.org_z[i] = static_cast<float>(columns[6] * x + columns[7] * y + columns[8] * z);
  }
  for (std::size_t i = 0; i < kPacket; ++i) {
    const double x = rays.dir_x[i];
    const double y = rays.dir_y[i];
    const double z = rays.dir_z[i];
    turned.dir_x[i] = static_cast<float>(columns[0] * x + columns[1] * y + columns[2] * z);
    turned.dir_y[i] = static_cast<float>(columns[3] * x + columns[4] * y + columns[5] * z);
    turned.dir_z[i] = static_cast<float>(columns[6] * x + columns[7] * y + columns[8] * z);
  }
  for (std::size_t i = 0; i < kPacket; ++i) {
    turned.tnear[i] = rays.tnear[i];
    turned.tfar[i] = rays.tfar[i];
    turned.time[i] = 0;
    turned.mask[i] = ~0U;
    turned.flags[i] = 0;
  }
}

BUBBLESIM_SIMD int from_inside(const RTCRay16& ray, const RTCHit16& hit, const int* use, unsigned first_other,
                               int* inside, int* moving) {
  int any = 0;
  int moved = 0;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const float along = ray.dir_x[i] * hit.Ng_x[i] + ray.dir_y[i] * hit.Ng_y[i] + ray.dir_z[i] * hit.Ng_z[i];
    const bool on_still =
        (use[i] != 0) & (hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) & (hit.instID[0][i] == RTC_INVALID_GEOMETRY_ID);
    moved |= (use[i] != 0) & (hit.instID[0][i] < first_other) ? kUsed : 0;
    inside[i] = on_still & (along > 0) ? kUsed : 0;
    any |= inside[i];
  }
  *moving = moved;
  return any;
}

}  // namespace

void meet_plane(const PlaneEquation& plane, unsigned geometry, unsigned instance, const RayMask& mask,
                RTCRayHit16& packet) {
  meet(plane.normal.data(), plane.offset, geometry, instance, mask.use, packet);
}

bool can_meet_sphere(const RTCRay16& rays, const int* use, const Vector3& centre, double radius, RayMask& can) {
  return reach_sphere(rays, use, centre.data(), radius * (1 + 1e-4) + 1e-4, can.use);
}

void into_frame(const Matrix3& turn, const Vector3& position, const RTCRay16& rays, RTCRayHit16& turned) {
  turn_rays(turn.data(), position.data(), rays, turned.ray);
  for (std::size_t i = 0; i < kPacket; ++i) turned.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
}

BUBBLESIM_SIMD void take_hits(const RTCRayHit16& turned, unsigned instance, const RayMask& mask, RTCRayHit16& packet) {
  RTCHit16& hit = packet.hit;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const bool met = (mask.use[i] != 0) & (turned.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID);
    packet.ray.tfar[i] = met ? turned.ray.tfar[i] : packet.ray.tfar[i];
    hit.Ng_x[i] = met ? turned.hit.Ng_x[i] : hit.Ng_x[i];
    hit.Ng_y[i] = met ? turned.hit.Ng_y[i] : hit.Ng_y[i];
    hit.Ng_z[i] = met ? turned.hit.Ng_z[i] : hit.Ng_z[i];
    hit.u[i] = met ? turned.hit.u[i] : hit.u[i];
    hit.v[i] = met ? turned.hit.v[i] : hit.v[i];
    hit.primID[i] = met ? turned.hit.primID[i] : hit.primID[i];
    hit.geomID[i] = met ? turned.hit.geomID[i] : hit.geomID[i];
    hit.instID[0][i] = met ? instance : hit.instID[0][i];
  }
}

Cone cone_around(const RTCRay16& rays, const RayMask& mask) {
  constexpr double kRounding = 1e-5;  // of a cosine, generously
  std::size_t middle = kPacket / 2;
  while (middle > 0 && mask.use[middle] == 0) --middle;
  while (middle + 1 < kPacket && mask.use[middle] == 0) ++middle;
  Cone cone;
  cone.apex = Vector3(rays.org_x[middle], rays.org_y[middle], rays.org_z[middle]);
  cone.axis = Vector3(rays.dir_x[middle], rays.dir_y[middle], rays.dir_z[middle]).normalized();
  const Eigen::Vector3f axis = cone.axis.cast<float>();
  cone.cosine = static_cast<double>(least_cosine(rays, mask.use, axis.data())) - kRounding;
  cone.sine = std::sqrt(std::max(0.0, 1 - cone.cosine * cone.cosine));
  return cone;
}

bool reaches_into(const Vector3& centre, double radius, const Cone& cone) {
  if (!(cone.cosine > 0)) return true;
  const Vector3 offset = centre - cone.apex;
  const double along = offset.dot(cone.axis);
  const double least =
      radius + along * cone.sine;  // times the cosine: what is farther from the axis is beside the cone
  const double square = offset.squaredNorm() - along * along;
  return least >= 0 && square * cone.cosine * cone.cosine <= least * least;
}

int hits_from_inside(const RTCRayHit16& packet, const RayMask& mask, unsigned first_other, RayMask& inside,
                     int& moving) {
  return from_inside(packet.ray, packet.hit, mask.use, first_other, inside.use, &moving);
}

BUBBLESIM_SIMD bool find_hits(const RTCHit16& hits, const RayMask& mask, RayMask& found) {
  int all = kUsed;
  for (std::size_t i = 0; i < kPacket; ++i) {
    found.use[i] = hits.geomID[i] != RTC_INVALID_GEOMETRY_ID ? mask.use[i] : 0;
    all &= found.use[i];
  }
  return all != 0;
}

BUBBLESIM_SIMD bool take_same(const RTCHit16& hits, std::size_t i, RayMask& left, RayMask& same) {
  const unsigned geometry = hits.geomID[i];
  const unsigned instance = hits.instID[0][i];
  int any = 0;
  for (std::size_t ray = 0; ray < kPacket; ++ray) {
    const bool equal = (hits.geomID[ray] == geometry) & (hits.instID[0][ray] == instance);
    same.use[ray] = equal ? left.use[ray] : 0;
    left.use[ray] = equal ? 0 : left.use[ray];
    any |= left.use[ray];
  }
  return any != 0;
}

BUBBLESIM_SIMD void keep_distances(const RTCRay16& rays, const RayMask& mask, float none, std::size_t count,
                                   float* distances) {
  for (std::size_t i = 0; i < count; ++i) distances[i] = mask.use[i] != 0 ? rays.tfar[i] : none;
}

BUBBLESIM_SIMD void keep_object(ObjectId object, const RayMask& mask, std::size_t count, ObjectId* objects) {
  for (std::size_t i = 0; i < count; ++i) objects[i] = mask.use[i] != 0 ? object : objects[i];
}

}  // namespace bubblesim::rays
