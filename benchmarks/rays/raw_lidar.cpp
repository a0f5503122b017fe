// SPDX-License-Identifier: BSD-3-Clause
#include "raw_lidar.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace bubblesim::benchmarks {
namespace {

constexpr std::size_t kPacket = 16;
constexpr float kGround = 1000;  // m, half the side length

RTCGeometry quads(RTCDevice device, const std::vector<Vector3>& corners, const std::vector<unsigned>& faces) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), corners.size()));
  for (const Vector3& corner : corners) {
    for (std::size_t axis = 0; axis < 3; ++axis) *vertex++ = static_cast<float>(corner[axis]);
  }
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                                               4 * sizeof(unsigned), faces.size() / 4));
  for (const unsigned corner : faces) *index++ = corner;
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCGeometry box(RTCDevice device, const RawLidar::PlacedBox& placed) {
  std::vector<Vector3> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [corner](int axis) { return (corner >> axis & 1) != 0 ? 0.5 : -0.5; };
    corners.push_back(placed.pose * placed.box.size.cwiseProduct(Vector3(side(0), side(1), side(2))));
  }
  return quads(device, corners, {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6});
}

void attach(RTCScene scene, RTCGeometry geometry) {
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

RawLidar::RawLidar(const LidarDescription& lidar, const std::vector<PlacedBox>& still,
                   const std::vector<PlacedBox>& moving)
    : device_(rtcNewDevice("threads=1")),
      still_(rtcNewScene(device_)),
      moving_(rtcNewScene(device_)),
      max_range_(static_cast<float>(lidar.max_range)) {
  for (const PlacedBox& placed : still) attach(still_, box(device_, placed));
  attach(still_, quads(device_,
                       {{-kGround, -kGround, 0}, {kGround, -kGround, 0}, {kGround, kGround, 0}, {-kGround, kGround, 0}},
                       {0, 1, 2, 3}));
  rtcSetSceneBuildQuality(still_, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(still_);
  for (const PlacedBox& placed : moving) {
    RTCScene one = rtcNewScene(device_);
    attach(one, box(device_, placed));
    rtcCommitScene(one);
    instances_.push_back(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(instances_.back(), one);
    rtcReleaseScene(one);
    rtcCommitGeometry(instances_.back());
    rtcAttachGeometry(moving_, instances_.back());
  }
  rtcSetSceneBuildQuality(moving_, RTC_BUILD_QUALITY_LOW);
  for (int ring = 0; ring < lidar.vertical.samples; ++ring) {
    const double up = lidar.vertical.at(ring);
    for (int i = 0; i < lidar.horizontal.samples; ++i) {
      const double left = lidar.horizontal.at(i);
      x_.push_back(static_cast<float>(std::cos(up) * std::cos(left)));
      y_.push_back(static_cast<float>(std::cos(up) * std::sin(left)));
      z_.push_back(static_cast<float>(std::sin(up)));
    }
  }
  count_ = x_.size();
  ranges_.resize(count_);
  const std::size_t padded = (count_ + kPacket - 1) / kPacket * kPacket;
  for (std::vector<float>* part : {&x_, &y_, &z_}) part->resize(padded, 1);
}

RawLidar::~RawLidar() {
  for (RTCGeometry instance : instances_) rtcReleaseGeometry(instance);
  rtcReleaseScene(moving_);
  rtcReleaseScene(still_);
  rtcReleaseDevice(device_);
}

const std::vector<float>& RawLidar::scan(const Pose& sensor, const std::vector<Pose>& moving) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Matrix3 turn = moving[i].orientation.toRotationMatrix();
    std::array<float, 12> matrix;
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t row = 0; row < 3; ++row) matrix[3 * column + row] = static_cast<float>(turn(row, column));
    }
    for (std::size_t row = 0; row < 3; ++row) matrix[9 + row] = static_cast<float>(moving[i].position[row]);
    rtcSetGeometryTransform(instances_[i], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix.data());
    rtcCommitGeometry(instances_[i]);
  }
  rtcCommitScene(moving_);

  rays::EmbreeQuery query;
  query.coherent = true;
  const Matrix3 turn = sensor.orientation.toRotationMatrix();
  float r[9];
  for (std::size_t i = 0; i < 9; ++i) r[i] = static_cast<float>(turn(i / 3, i % 3));
  const auto x = static_cast<float>(sensor.position.x());
  const auto y = static_cast<float>(sensor.position.y());
  const auto z = static_cast<float>(sensor.position.z());
  alignas(64) int valid[kPacket];
  RTCRayHit16 packet;
  for (std::size_t first = 0; first < count_; first += kPacket) {
    for (std::size_t i = 0; i < kPacket; ++i) {
      const std::size_t ray = first + i;
      valid[i] = ray < count_ ? -1 : 0;
      packet.ray.org_x[i] = x;
      packet.ray.org_y[i] = y;
      packet.ray.org_z[i] = z;
      packet.ray.dir_x[i] = r[0] * x_[ray] + r[1] * y_[ray] + r[2] * z_[ray];
      packet.ray.dir_y[i] = r[3] * x_[ray] + r[4] * y_[ray] + r[5] * z_[ray];
      packet.ray.dir_z[i] = r[6] * x_[ray] + r[7] * y_[ray] + r[8] * z_[ray];
      packet.ray.tnear[i] = packet.ray.time[i] = 0;
      packet.ray.tfar[i] = max_range_;
      packet.ray.mask[i] = ~0U;
      packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rays::intersect_packet(valid, still_, query, packet);
    rays::intersect_packet(valid, moving_, query, packet);
    for (std::size_t i = 0; i < kPacket && first + i < count_; ++i) {
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      ranges_[first + i] = hit ? packet.ray.tfar[i] : std::numeric_limits<float>::infinity();
    }
  }
  return ranges_;
}

}  // namespace bubblesim::benchmarks
