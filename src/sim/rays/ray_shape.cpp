// SPDX-License-Identifier: BSD-3-Clause
#include "rays/ray_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bubblesim/triangle_mesh.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim::rays {
namespace {

/// Half the size of the bounding box of a shape, in the shape's frame.
struct HalfExtent {
  Vector3 operator()(const Box& box) const { return box.size / 2; }
  Vector3 operator()(const Sphere& sphere) const { return Vector3::Constant(sphere.radius); }
  Vector3 operator()(const Cylinder& cylinder) const { return {cylinder.radius, cylinder.radius, cylinder.length / 2}; }
  Vector3 operator()(const Capsule& capsule) const {
    return {capsule.radius, capsule.radius, capsule.radius + capsule.length / 2};
  }
  Vector3 operator()(const Ellipsoid& ellipsoid) const { return ellipsoid.radii; }
  Vector3 operator()(const Plane&) const { return Vector3::Zero(); }
  Vector3 operator()(const Mesh&) const { return Vector3::Zero(); }  // Embree computes the bounds of triangles itself
};

void bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& shape = *static_cast<const RayShape*>(arguments->geometryUserPtr);
  const Vector3 half = std::visit(HalfExtent{}, shape.geometry);
  const Vector3 reach = shape.turn.cwiseAbs() * half;
  float low[3];
  float high[3];
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double centre = shape.pose.position[axis];
    const double margin = 1e-6 * (1 + std::abs(centre) + reach[axis]);  // for rounding in single precision
    low[axis] = static_cast<float>(centre - reach[axis] - margin);
    high[axis] = static_cast<float>(centre + reach[axis] + margin);
  }
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = low[0];
  box.lower_y = low[1];
  box.lower_z = low[2];
  box.upper_x = high[0];
  box.upper_y = high[1];
  box.upper_z = high[2];
}

Vector3 origin_in_shape(const RayShape& shape, RTCRayN* rays, unsigned count, unsigned i) {
  const Vector3 start(RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i), RTCRayN_org_z(rays, count, i));
  return shape.turn_back * (start - shape.pose.position);
}

/// Where ray `i` of a packet enters the shape, as a multiple of the ray's direction; the normal is in the shape's outer
/// frame. `origin` is its start in the shape's frame, into which `turn_back` turns directions.
std::optional<ShapeHit> meet(const RayShape& shape, const Matrix3& turn_back, const Vector3& origin, RTCRayN* rays,
                             unsigned count, unsigned i) {
  const Vector3 direction(RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i), RTCRayN_dir_z(rays, count, i));
  const double length = direction.norm();
  const Ray ray{origin, turn_back * (direction / length)};
  std::optional<ShapeHit> hit = intersect(ray, shape.geometry, RTCRayN_tfar(rays, count, i) * length);
  if (!hit) return std::nullopt;
  hit->distance /= length;
  if (hit->distance < RTCRayN_tnear(rays, count, i)) return std::nullopt;
  hit->normal = shape.turn * hit->normal;
  return hit;
}

void set_hit(const ShapeHit& hit, unsigned geometry, RTCRayN* rays, RTCHitN* hits, unsigned count, unsigned i) {
  RTCRayN_tfar(rays, count, i) = static_cast<float>(hit.distance);
  RTCHitN_Ng_x(hits, count, i) = static_cast<float>(hit.normal.x());
  RTCHitN_Ng_y(hits, count, i) = static_cast<float>(hit.normal.y());
  RTCHitN_Ng_z(hits, count, i) = static_cast<float>(hit.normal.z());
  RTCHitN_geomID(hits, count, i) = geometry;
  RTCHitN_primID(hits, count, i) = 0;
}

/// Marks the rays of a callback that can meet the shape's bounding sphere. Returns whether any can.
bool near_shape(const RayShape& shape, const int* valid, unsigned count, const RTCRayN* rays, RayMask& near) {
  if (count != kPacket) {
    std::copy_n(valid, count, near.use);
    return true;
  }
  const double radius = std::visit(HalfExtent{}, shape.geometry).norm();
  return can_meet_sphere(*reinterpret_cast<const RTCRay16*>(rays), valid, shape.pose.position, radius, near);
}

void intersect_round(const RTCIntersectFunctionNArguments* arguments) {
  const auto& shape = *static_cast<const RayShape*>(arguments->geometryUserPtr);
  const auto& context = *reinterpret_cast<const QueryContext*>(arguments->context);
  if (shape.model == context.ignored_model) return;
  const unsigned count = arguments->N;
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, count);
  RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, count);
  std::optional<Vector3> common_origin;
  if (context.embree.coherent) {
    const auto first = std::find_if(arguments->valid, arguments->valid + count, [](int use) { return use != 0; });
    if (first == arguments->valid + count) return;
    common_origin = origin_in_shape(shape, rays, count, static_cast<unsigned>(first - arguments->valid));
    if (is_inside(*common_origin, shape.geometry)) return;  // a lidar in its housing
  }
  RayMask near;
  if (!near_shape(shape, arguments->valid, count, rays, near)) return;
  for (unsigned i = 0; i < count; ++i) {
    if (near.use[i] == 0) continue;
    const Vector3 origin = common_origin ? *common_origin : origin_in_shape(shape, rays, count, i);
    if (!common_origin && is_inside(origin, shape.geometry)) continue;
    const std::optional<ShapeHit> hit = meet(shape, shape.turn_back, origin, rays, count, i);
    if (!hit) continue;
    set_hit(*hit, arguments->geomID, rays, hits, count, i);
    set_instance(hits, count, i, *arguments->context);
  }
}

void occlude_round(const RTCOccludedFunctionNArguments* arguments) {
  const auto& shape = *static_cast<const RayShape*>(arguments->geometryUserPtr);
  if (!shape.cast_shadows) return;
  const unsigned count = arguments->N;
  RayMask near;
  if (!near_shape(shape, arguments->valid, count, arguments->ray, near)) return;
  for (unsigned i = 0; i < count; ++i) {
    if (near.use[i] == 0) continue;
    const Vector3 origin = origin_in_shape(shape, arguments->ray, count, i);
    if (is_inside(origin, shape.geometry) || !meet(shape, shape.turn_back, origin, arguments->ray, count, i)) continue;
    RTCRayN_tfar(arguments->ray, count, i) = -std::numeric_limits<float>::infinity();
  }
}

/// For faces that cast no shadow.
void let_light_through(const RTCFilterFunctionNArguments* arguments) { std::fill_n(arguments->valid, arguments->N, 0); }

GeometryHandle make_round() {
  GeometryHandle geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
  rtcSetGeometryBoundsFunction(geometry.get(), bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersect_round);
  rtcSetGeometryOccludedFunction(geometry.get(), occlude_round);
  return geometry;
}

/// Six faces, wound so that Embree's normals point outwards.
GeometryHandle make_box(const Box& box, const Pose& pose) {
  GeometryHandle geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_QUAD));
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 8));
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [corner](int axis) { return (corner >> axis & 1) != 0 ? 0.5 : -0.5; };
    const Vector3 place = pose * box.size.cwiseProduct(Vector3(side(0), side(1), side(2)));
    Eigen::Vector3f::Map(vertex) = place.cast<float>();
    vertex += 3;
  }
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), 6));
  for (const unsigned corner : kBoxFaces) *index++ = corner;
  return geometry;
}

/// Embree's normals point to the side on which the corners run counter-clockwise.
GeometryHandle make_mesh(const TriangleMesh& mesh, const Pose& pose) {
  GeometryHandle geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  check_embree();
  for (const TriangleMesh::Point& point : mesh.vertices) {
    const Vector3 place = pose * Vector3(point[0], point[1], point[2]);
    Eigen::Vector3f::Map(vertex) = place.cast<float>();
    vertex += 3;
  }
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  check_embree();
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) index = std::copy_n(triangle.begin(), 3, index);
  return geometry;
}

GeometryHandle make_any(const RayShape& shape) {
  if (is_traced_as_round(shape)) return make_round();
  if (const auto* box = std::get_if<Box>(&shape.geometry)) return make_box(*box, shape.pose);
  return make_mesh(*std::get<Mesh>(shape.geometry).triangles, shape.pose);
}

}  // namespace

/// Ray and normal are in the same frame here.
void keep_hits_from_outside(const RTCFilterFunctionNArguments* arguments) {
  const unsigned count = arguments->N;
  for (unsigned i = 0; i < count; ++i) {
    const float along = RTCRayN_dir_x(arguments->ray, count, i) * RTCHitN_Ng_x(arguments->hit, count, i) +
                        RTCRayN_dir_y(arguments->ray, count, i) * RTCHitN_Ng_y(arguments->hit, count, i) +
                        RTCRayN_dir_z(arguments->ray, count, i) * RTCHitN_Ng_z(arguments->hit, count, i);
    if (along > 0) arguments->valid[i] = 0;
  }
}

void place(RayShape& shape, const Pose& pose) {
  shape.pose = pose;
  shape.turn = pose.orientation.toRotationMatrix();
  shape.turn_back = shape.turn.transpose();
  shape.middle = pose.position;
  shape.reach = std::visit(HalfExtent{}, shape.geometry).norm();
  if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
    const Vector3& low = mesh->triangles->low;
    const Vector3& high = mesh->triangles->high;
    shape.middle = pose * Vector3((low + high) / 2);
    shape.reach = (high - low).norm() / 2;
  }
}

bool is_infinite(const Geometry& geometry) { return std::holds_alternative<Plane>(geometry); }

bool is_traced_as_round(const RayShape& shape) {
  if (std::holds_alternative<Box>(shape.geometry)) return shape.houses_sensor;
  return !std::holds_alternative<Mesh>(shape.geometry);
}

PlacedRound placed_round(const RayShape& shape, const Transform& place, unsigned geometry, unsigned instance) {
  const Vector3 offset = shape.turn_back * (shape.middle - shape.pose.position);
  return {&shape, place, place * offset, geometry, instance};
}

void meet_round(const PlacedRound& round, const RayMask& mask, RTCRayHit16& packet) {
  RayMask near;
  if (!can_meet_sphere(packet.ray, mask.use, round.middle, round.shape->reach, near)) return;
  const Matrix3 turn_back = round.place.rotation.transpose();
  const Vector3 start(packet.ray.org_x[0], packet.ray.org_y[0], packet.ray.org_z[0]);
  const Vector3 origin = turn_back * (start - round.place.position);
  auto* rays = reinterpret_cast<RTCRayN*>(&packet.ray);
  for (unsigned i = 0; i < kPacket; ++i) {
    if (near.use[i] == 0) continue;
    const std::optional<ShapeHit> hit = meet(*round.shape, turn_back, origin, rays, kPacket, i);
    if (!hit) continue;
    set_hit(*hit, round.geometry, rays, reinterpret_cast<RTCHitN*>(&packet.hit), kPacket, i);
    packet.hit.instID[0][i] = round.instance;
  }
}

void shade_round(const PlacedRound& round, const RayMask& mask, RTCRay16& rays) {
  RayMask near;
  if (!can_meet_sphere(rays, mask.use, round.middle, round.shape->reach, near)) return;
  const Matrix3 turn_back = round.place.rotation.transpose();
  for (unsigned i = 0; i < kPacket; ++i) {
    if (near.use[i] == 0) continue;
    const Vector3 start(rays.org_x[i], rays.org_y[i], rays.org_z[i]);
    const Vector3 origin = turn_back * (start - round.place.position);
    if (is_inside(origin, round.shape->geometry)) continue;
    if (!meet(*round.shape, turn_back, origin, reinterpret_cast<RTCRayN*>(&rays), kPacket, i)) continue;
    rays.tfar[i] = -std::numeric_limits<float>::infinity();
  }
}

GeometryHandle make_geometry(const RayShape& shape) {
  GeometryHandle geometry = make_any(shape);
  if (shape.houses_sensor && std::holds_alternative<Mesh>(shape.geometry)) {
    rtcSetGeometryIntersectFilterFunction(geometry.get(), keep_hits_from_outside);
  }
  if (!shape.cast_shadows) rtcSetGeometryOccludedFilterFunction(geometry.get(), let_light_through);
  // Callbacks only read the shape; Embree's interface has no const.
  rtcSetGeometryUserData(geometry.get(), const_cast<RayShape*>(&shape));
  rtcCommitGeometry(geometry.get());
  check_embree();
  return geometry;
}

}  // namespace bubblesim::rays
