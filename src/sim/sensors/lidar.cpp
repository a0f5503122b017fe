// SPDX-License-Identifier: BSD-3-Clause
// Lidar: ranges along a fan of rays, in one or several rings. Rays start at the minimum range, like Gazebo's: nearer
// surfaces, such as the robot's own housing, do not hide those behind them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rays/packet_math.hpp"
#include "rays/ray_scene.hpp"
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {
namespace {

constexpr float kNoRange = std::numeric_limits<float>::infinity();
constexpr std::size_t kRaysPerPart = 64 * rays::kPacket;  // of a large scan, on one thread

class Lidar final : public Sensor {
 public:
  Lidar(const LidarDescription& description, ObjectId id)
      : Sensor(empty_scan(description)), description_(description), id_(id) {
    for (int ring = 0; ring < description.vertical.samples; ++ring) {
      const double up = description.vertical.at(ring);
      for (int i = 0; i < description.horizontal.samples; ++i) {
        const double left = description.horizontal.at(i);
        x_.push_back(std::cos(up) * std::cos(left));
        y_.push_back(std::cos(up) * std::sin(left));
        z_.push_back(std::sin(up));
      }
    }
    count_ = x_.size();
    const std::size_t padded = (count_ + rays::kPacket - 1) / rays::kPacket * rays::kPacket;
    x_.resize(padded, 1);
    y_.resize(padded, 0);
    z_.resize(padded, 0);
  }

  std::size_t ray_count() const override { return count_; }

 private:
  static LidarScan empty_scan(const LidarDescription& description) {
    LidarScan scan{description.horizontal, description.vertical, description.min_range, description.max_range, {}, {}};
    const auto rays = static_cast<std::size_t>(description.horizontal.samples) *
                      static_cast<std::size_t>(description.vertical.samples);
    scan.ranges.assign(rays, kNoRange);
    scan.intensities.assign(rays, 0);
    return scan;
  }

  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    auto& scan = std::get<LidarScan>(measurement);
    moment.rays.refresh(moment.world);
    const Pose sensor = moment.world.pose(id_);
    const Matrix3 turn = sensor.orientation.toRotationMatrix();
    const std::size_t parts = count_ < kRaysWorthThreads ? 1 : (count_ + kRaysPerPart - 1) / kRaysPerPart;
    const std::size_t length = parts == 1 ? count_ : kRaysPerPart;
    WorkerPool::shared().run(parts, [&](std::size_t part) {
      scan_part(moment.rays, sensor.position, turn, part * length, std::min(count_, (part + 1) * length), scan);
    });
    distort(moment, scan.ranges);
  }

  void scan_part(const RayScene& scene, const Vector3& origin, const Matrix3& turn, std::size_t begin, std::size_t end,
                 LidarScan& scan) const {
    const auto min_range = static_cast<float>(description_.min_range);
    const auto max_range = static_cast<float>(description_.max_range);
    rays::RayPacket packet;
    for (std::size_t first = begin; first < end; first += rays::kPacket) {
      const std::size_t count = std::min(rays::kPacket, end - first);
      packet.start(origin, min_range, max_range, count);
      rays::aim(packet.data.ray, turn, {&x_[first], &y_[first], &z_[first]});
      scene.trace(packet, true);
      rays::RayMask hits;
      rays::find_hits(packet.data.hit, packet.mask, hits);
      rays::keep_distances(packet.data.ray, hits, kNoRange, count, &scan.ranges[first]);
      for (std::size_t i = 0; i < count && scene.has_retro(); ++i) {
        scan.intensities[first + i] = packet.hit(i) ? scene.shape(packet, i).laser_retro : 0;
      }
    }
  }

  void distort(const MeasurementContext& moment, std::vector<float>& ranges) const {
    Noise noise(description_.noise, moment, id_);
    if (!noise.active() && description_.resolution <= 0) return;
    for (float& range : ranges) {
      if (!std::isfinite(range)) continue;
      double value = noise.active() ? noise(range) : static_cast<double>(range);
      if (description_.resolution > 0) {
        value = std::round(value / description_.resolution) * description_.resolution;
      }
      range = static_cast<float>(std::clamp(value, description_.min_range, description_.max_range));
    }
  }

  LidarDescription description_;
  ObjectId id_;
  std::size_t count_ = 0;
  std::vector<double> x_, y_, z_;  // directions in the sensor's frame, padded to whole packets
};

}  // namespace

std::vector<Point> to_point_cloud(const LidarScan& scan) {
  struct Turn {
    double cosine;
    double sine;
  };
  std::vector<Turn> turns;
  turns.reserve(static_cast<std::size_t>(scan.horizontal.samples));
  for (int i = 0; i < scan.horizontal.samples; ++i) {
    turns.push_back({std::cos(scan.horizontal.at(i)), std::sin(scan.horizontal.at(i))});
  }
  std::vector<Point> points;
  points.reserve(scan.ranges.size());
  auto range = scan.ranges.begin();
  for (int ring = 0; ring < scan.vertical.samples; ++ring) {
    const double up = scan.vertical.at(ring);
    const Turn lift{std::cos(up), std::sin(up)};
    for (const Turn& turn : turns) {
      const double distance = *range++;
      if (!std::isfinite(distance)) continue;
      const double across = distance * lift.cosine;
      points.push_back({static_cast<float>(across * turn.cosine), static_cast<float>(across * turn.sine),
                        static_cast<float>(distance * lift.sine)});
    }
  }
  return points;
}

std::unique_ptr<Sensor> make_kind(const LidarDescription& description, const SensorSite& site) {
  return std::make_unique<Lidar>(description, site.id);
}

}  // namespace bubblesim
