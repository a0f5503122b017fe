// SPDX-License-Identifier: BSD-3-Clause
#include "rays/packet_math.hpp"

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
