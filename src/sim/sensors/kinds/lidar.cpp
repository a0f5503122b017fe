// SPDX-License-Identifier: BSD-3-Clause
// Lidar: ranges along a fan of rays, in one or several rings. Rays start at the minimum range, like Gazebo's: nearer
// surfaces, such as the robot's own housing, do not hide those behind them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bubblesim/sensor_noise.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_scene.hpp"
#include "scene/describe.hpp"
#include "scene/transform.hpp"
#include "sensors/define.hpp"
#include "sensors/worker_pool.hpp"
#include "validation/limits.hpp"

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
  struct Kept {
    rays::RayPacket packet;  // with its hits on what does not move
    rays::Cone cone;         // around its rays
  };

  static LidarScan empty_scan(const LidarDescription& description) {
    LidarScan scan{description.horizontal, description.vertical, description.min_range, description.max_range, {}, {}};
    const auto rays = static_cast<std::size_t>(description.horizontal.samples) *
                      static_cast<std::size_t>(description.vertical.samples);
    scan.ranges.assign(rays, kNoRange);
    scan.intensities.assign(rays, 0);
    return scan;
  }

  void measure(const MeasurementContext& context, Measurement& measurement) override {
    auto& scan = measurement.get<LidarScan>();
    context.rays.refresh(context.world);
    const Pose place = context.world.pose(id_);
    const bool keeps = must_keep(place, context.rays);
    const Transform frame(place);
    const std::size_t parts = count_ < kRaysWorthThreads ? 1 : (count_ + kRaysPerPart - 1) / kRaysPerPart;
    const std::size_t length = parts == 1 ? count_ : kRaysPerPart;
    WorkerPool::shared().run(parts, [&](std::size_t part) {
      const std::size_t begin = part * length;
      const std::size_t end = std::min(count_, begin + length);
      if (keeps) keep_part(context.rays, frame, begin, end);
      scan_part(context.rays, frame, begin, end, scan);
    });
    distort(context, scan.ranges);
  }

  /// Before each scan: whether it is the second one at a place, from which on what does not move is kept. Forgets what
  /// is kept of another place, or of what was there before.
  bool must_keep(const Pose& place, const RayScene& scene) {
    const bool stands = place == place_ && scene.fixed_version() == fixed_version_;
    place_ = place;
    fixed_version_ = scene.fixed_version();
    if (!stands) kept_.clear();
    if (!stands || !kept_.empty()) return false;
    kept_.resize(x_.size() / rays::kPacket);
    return true;
  }

  void keep_part(const RayScene& scene, const Transform& frame, std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += rays::kPacket) {
      auto& [packet, cone] = kept_[first / rays::kPacket];
      start(frame, first, end, packet);
      cone = rays::cone_around(packet.data.ray, packet.mask);
      scene.trace_fixed(packet);
    }
  }

  void scan_part(const RayScene& scene, const Transform& frame, std::size_t begin, std::size_t end,
                 LidarScan& scan) const {
    rays::RayPacket own;
    for (std::size_t first = begin; first < end; first += rays::kPacket) {
      const std::size_t count = std::min(rays::kPacket, end - first);
      const rays::RayPacket& packet = trace(scene, frame, first, end, own);
      rays::RayMask hits;
      rays::find_hits(packet.data.hit, packet.mask, hits);
      rays::keep_distances(packet.data.ray, hits, kNoRange, count, &scan.ranges[first]);
      for (std::size_t i = 0; i < count && scene.has_retro(); ++i) {
        scan.intensities[first + i] = packet.hit(i) ? scene.shape(packet, i).laser_retro : 0;
      }
    }
  }

  /// Sets the rays from `first` on, up to `end`.
  void start(const Transform& frame, std::size_t first, std::size_t end, rays::RayPacket& packet) const {
    packet.start(frame.position, static_cast<float>(description_.min_range), static_cast<float>(description_.max_range),
                 std::min(rays::kPacket, end - first));
    rays::aim(packet.data.ray, frame.rotation, {&x_[first], &y_[first], &z_[first]});
  }

  /// Returns the packet that was kept, or `own` if there is none or something that moves may be in its way.
  const rays::RayPacket& trace(const RayScene& scene, const Transform& frame, std::size_t first, std::size_t end,
                               rays::RayPacket& own) const {
    if (kept_.empty()) {
      start(frame, first, end, own);
      scene.trace(own, true);
      return own;
    }
    const Kept& kept = kept_[first / rays::kPacket];
    if (!scene.may_meet_moving(kept.cone)) return kept.packet;
    own = kept.packet;
    scene.trace_moving(own, kept.cone, static_cast<float>(description_.max_range));
    return own;
  }

  void distort(const MeasurementContext& context, std::vector<float>& ranges) const {
    Noise noise(description_.noise, context, id_);
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

  // A lidar that stands still traces only what moves.
  Pose place_;  // at the last scan
  std::uint64_t fixed_version_ = 0;
  std::vector<Kept> kept_;  // empty while it moves
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

namespace {

constexpr int kMaxSamples = 100000;  // per ring and number of rings

std::string range_of(const ScanAngles& angles) { return text(angles.min) + " to " + text(angles.max) + " rad"; }

void sort(SensorElement& sensor, const std::string& lidar, ScanAngles& angles, const std::string& which) {
  if (!(angles.min > angles.max)) return;
  sensor.warn(lidar, "the " + which + " angles are " + range_of(angles) + ": using them from low to high");
  std::swap(angles.min, angles.max);
}

/// Like Gazebo: rings in any order; a single ring, or none, is horizontal.
void straighten(SensorElement& sensor, const std::string& lidar, ScanAngles& vertical) {
  if (vertical.samples > 1 || (vertical.samples == 1 && vertical.min == vertical.max)) {
    return sort(sensor, lidar, vertical, "vertical");
  }
  sensor.warn(lidar, std::to_string(vertical.samples) + " vertical samples from " + range_of(vertical) +
                         ": using a single ring at 0 rad");
  vertical = {1, 0, 0};
}

/// SDFormat has a number of samples and a resolution that multiplies it.
ScanAngles read_angles(const SensorElement& sensor, const std::string& scan) {
  constexpr double kMost = 1e9;
  const double rays = std::round(sensor.number(scan + "/samples") * sensor.number(scan + "/resolution"));
  return {static_cast<int>(std::clamp(rays, -kMost, kMost)), sensor.number(scan + "/min_angle"),
          sensor.number(scan + "/max_angle")};
}

void check_scan(SensorCheck& check, const std::string& which, const ScanAngles& scan, double reach) {
  check.require(scan.samples >= 1 && scan.samples <= kMaxSamples, "the number of " + which + " samples",
                std::to_string(scan.samples), "1 to " + std::to_string(kMaxSamples));
  constexpr double kRounded = 1e-3;  // rad: files write 6.28319 for a turn and 1.5708 for a quarter
  check.require(within(scan.min, reach + kRounded) && within(scan.max, reach + kRounded) && scan.min <= scan.max,
                "the range of " + which + " angles", range_of(scan), "from low to high, at most +-" + text(reach));
}

std::vector<double> angles_of(const ScanAngles& scan) {
  std::vector<double> angles;
  for (int i = 0; i < scan.samples; ++i) angles.push_back(scan.at(i));
  return angles;
}

Sizes rings_and_samples(const LidarScan& scan) {
  return {static_cast<std::size_t>(scan.vertical.samples), static_cast<std::size_t>(scan.horizontal.samples)};
}

/// In a batch, a single ring has one dimension.
std::optional<Sizes> observed_rays(const LidarDescription& lidar) {
  const auto samples = static_cast<std::size_t>(lidar.horizontal.samples);
  if (lidar.vertical.samples == 1) return Sizes{samples};
  return Sizes{static_cast<std::size_t>(lidar.vertical.samples), samples};
}

}  // namespace

const MemberTable& ScanAngles::members() {
  static const MemberTable table =
      member_table<ScanAngles>("ScanAngles", "Evenly spaced angles, the first and the last included.",
                               {
                                   member<&ScanAngles::samples>("samples", "", "their number"),
                                   member<&ScanAngles::min>("min", "rad", "the first angle"),
                                   member<&ScanAngles::max>("max", "rad", "the last angle"),
                               });
  return table;
}

const MemberTable& LidarDescription::members() {
  using D = LidarDescription;
  static const MemberTable table = member_table<D>(
      "LidarDescription", "Measures ranges along a fan of rays, in one or several rings.",
      {
          member<&D::horizontal>("horizontal", "", "angles of the samples, to the left").unlisted(),
          member<&D::vertical>("vertical", "", "elevations of the rings, upwards").unlisted(),
          member<&D::min_range>("min_range", "m", "nearer surfaces are not detected"),
          member<&D::max_range>("max_range", "m", "length of the rays"),
          member<&D::resolution>("resolution", "m", "ranges are rounded to multiples of it; 0: not rounded"),
          member<&D::noise>("noise", "m", "noise of the ranges"),
          member<&D::signal>("signal", "", "name of the string signal with the points for scripts; empty: none"),
          computed<D>("samples", "", "of a ring", [](const D& d) { return d.horizontal.samples; }),
          computed<D>("min_angle", "rad", "of the first sample, to the left",
                      [](const D& d) { return d.horizontal.min; }),
          computed<D>("max_angle", "rad", "of the last sample, to the left",
                      [](const D& d) { return d.horizontal.max; }),
          computed<D>("rings", "", "their number", [](const D& d) { return d.vertical.samples; }),
          computed<D>("min_elevation", "rad", "of the lowest ring", [](const D& d) { return d.vertical.min; }),
          computed<D>("max_elevation", "rad", "of the highest ring", [](const D& d) { return d.vertical.max; }),
      });
  return table;
}

const MemberTable& LidarScan::members() {
  using S = LidarScan;
  static const MemberTable table = member_table<S>(
      "LidarScan", "One turn of a lidar, ring by ring from the lowest up. Its arrays are read-only.",
      {
          member<&S::horizontal>("horizontal", "", "angles of the samples, to the left").unlisted(),
          member<&S::vertical>("vertical", "", "elevations of the rings, upwards").unlisted(),
          member<&S::min_range>("min_range", "m", "of the lidar"),
          member<&S::max_range>("max_range", "m", "of the lidar"),
          member<&S::ranges>("ranges", "m", "rings x samples: at least min_range; inf if nothing is in range")
              .with_shape(rings_and_samples),
          member<&S::intensities>("intensities", "", "rings x samples: laser_retro of the shape that was hit, or 0")
              .with_shape(rings_and_samples),
          computed<S>("points", "m", "count x 3: x, y, z of the hits in the sensor's frame, ring by ring; a new array",
                      [](const S& scan) { return to_point_cloud(scan); }),
          computed<S>("angles", "rad", "of the samples, to the left",
                      [](const S& scan) { return angles_of(scan.horizontal); }),
          computed<S>("angle_min", "rad", "of the first sample, to the left",
                      [](const S& scan) { return scan.horizontal.min; }),
          computed<S>("angle_max", "rad", "of the last sample, to the left",
                      [](const S& scan) { return scan.horizontal.max; }),
          computed<S>("angle_increment", "rad", "between samples",
                      [](const S& scan) { return scan.horizontal.increment(); }),
          computed<S>("elevations", "rad", "of the rings, upwards",
                      [](const S& scan) { return angles_of(scan.vertical); }),
      });
  return table;
}

class LidarKind final : public SensorDefinitionOf<LidarDescription, LidarScan> {
 public:
  LidarKind() : SensorDefinitionOf("lidar", {"ray", "lidar", "gpu_ray", "gpu_lidar"}) {
    id = reader = "lidar";
    renamed = {{"ray", "lidar"}, {"gpu_ray", "gpu_lidar"}};
    elements = R"(
  lidar none
    &lidar
  ray none
    &lidar

=lidar
  scan none
    horizontal none
      samples integer 640 required
      resolution number 1 required
      min_angle number 0 required
      max_angle number 0 required
    vertical none
      samples integer 1 required
      resolution number 1
      min_angle number 0 required
      max_angle number 0 required
  range none
    min number 0 required
    max number 0 required
    resolution number 0
  noise none
    &noise_of_rays
  visibility_mask integer 4294967295 ~ all is visible
  bubblesim:signal text
)";
    observe("ranges", "m", "one for each ray", observed_rays, [](const LidarScan& scan, Row& row) {
      for (const float range : scan.ranges) row.put(range);
    });
    observe("intensities", "", "one for each ray", observed_rays, [](const LidarScan& scan, Row& row) {
      for (const float intensity : scan.intensities) row.put(intensity);
    });
  }

  std::optional<LidarDescription> read(SensorElement& sensor) const override {
    const std::string lidar = sensor.has("lidar") ? "lidar" : "ray";
    LidarDescription description;
    description.horizontal = read_angles(sensor, lidar + "/scan/horizontal");
    sort(sensor, lidar, description.horizontal, "horizontal");
    description.vertical = read_angles(sensor, lidar + "/scan/vertical");
    straighten(sensor, lidar, description.vertical);
    description.min_range = sensor.number(lidar + "/range/min");
    description.max_range = sensor.number(lidar + "/range/max");
    // Some models have a resolution that would leave no range.
    const double resolution = sensor.number(lidar + "/range/resolution");
    description.resolution = resolution < description.max_range ? resolution : 0;
    description.noise = sensor.noise(lidar + "/noise");
    if (sensor.has(lidar + "/bubblesim:signal")) description.signal = sensor.text(lidar + "/bubblesim:signal");
    return description;
  }

  void check(SensorCheck& check, const LidarDescription& lidar) const override {
    check_scan(check, "horizontal", lidar.horizontal, 2 * M_PI);
    check_scan(check, "vertical", lidar.vertical, M_PI / 2);
    check.require_ranges(lidar.min_range, lidar.max_range);
    check.require(lidar.resolution >= 0 && lidar.resolution <= lidar.max_range, "the range resolution",
                  text(lidar.resolution) + " m", "0 (not rounded) to the maximum range");
  }

  std::unique_ptr<Sensor> make(const LidarDescription& description, const SensorSite& site) const override {
    return std::make_unique<Lidar>(description, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<LidarKind>();

}  // namespace bubblesim
