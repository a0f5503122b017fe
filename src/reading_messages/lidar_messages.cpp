// SPDX-License-Identifier: BSD-3-Clause
#include "lidar_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "cloud_fields.hpp"

namespace bubblesim::reading_messages {
namespace {

constexpr std::array<CloudField, 6> kReturnFields{{{"x", 0, kCloudFloat32},
                                                   {"y", 4, kCloudFloat32},
                                                   {"z", 8, kCloudFloat32},
                                                   {"intensity", 12, kCloudFloat32},
                                                   {"ring", 16, kCloudUint16},
                                                   {"time", 18, kCloudFloat32}}};
constexpr std::size_t kReturnSize = 22;

/// The directions of a lidar's rays, unit vectors in its frame.
class Directions {
 public:
  explicit Directions(const LidarScan& scan) {
    for (int i = 0; i < scan.horizontal.samples; ++i) {
      across_.emplace_back(std::cos(scan.horizontal.at(i)), std::sin(scan.horizontal.at(i)));
    }
    for (int i = 0; i < scan.vertical.samples; ++i) {
      up_.emplace_back(std::cos(scan.vertical.at(i)), std::sin(scan.vertical.at(i)));
    }
  }

  std::size_t rings() const { return up_.size(); }
  std::size_t samples() const { return across_.size(); }
  Point along(std::size_t ring, std::size_t sample, float distance) const {
    const auto& [cos_up, sin_up] = up_[ring];
    const auto& [cos_left, sin_left] = across_[sample];
    return {static_cast<float>(cos_up * cos_left) * distance, static_cast<float>(cos_up * sin_left) * distance,
            static_cast<float>(sin_up) * distance};
  }

 private:
  using CosAndSin = std::pair<double, double>;

  std::vector<CosAndSin> across_;
  std::vector<CosAndSin> up_;
};

class Returns {
 public:
  explicit Returns(const CloudOptions& options)
      : least_(static_cast<float>(options.least)), most_(static_cast<float>(options.most)) {}

  bool has(float range) const { return std::isfinite(range) && range > least_ && range < most_; }

 private:
  float least_;
  float most_;
};

void write_point(const Point& point, float intensity, std::size_t ring, std::uint8_t* place) {
  const auto ring_number = static_cast<std::uint16_t>(ring);
  constexpr float kTime = 0;  // all rays are cast at once
  std::memcpy(place, point.data(), sizeof point);
  std::memcpy(place + 12, &intensity, sizeof intensity);
  std::memcpy(place + 16, &ring_number, sizeof ring_number);
  std::memcpy(place + 18, &kTime, sizeof kTime);
}

void write_cloud(const LidarScan& scan, const CloudOptions& options, std::uint8_t* place) {
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  const Directions directions(scan);
  const Returns returns(options);
  std::size_t ray = 0;
  for (std::size_t ring = 0; ring < directions.rings(); ++ring) {
    for (std::size_t sample = 0; sample < directions.samples(); ++sample, ++ray) {
      const bool met = returns.has(scan.ranges[ray]);
      if (!met && !options.organized) continue;
      const Point point = met ? directions.along(ring, sample, scan.ranges[ray]) : Point{kMissing, kMissing, kMissing};
      write_point(point, scan.intensities[ray], ring, place);
      place += kReturnSize;
    }
  }
}

void write_points(const LidarScan& scan, std::uint8_t* place) {
  const auto least = static_cast<float>(scan.min_range);
  const auto most = static_cast<float>(scan.max_range);
  const Directions directions(scan);
  auto range = scan.ranges.begin();
  for (std::size_t ring = 0; ring < directions.rings(); ++ring) {
    for (std::size_t sample = 0; sample < directions.samples(); ++sample, place += sizeof(Point)) {
      const Point point = directions.along(ring, sample, std::clamp(*range++, least, most));
      std::memcpy(place, point.data(), sizeof point);
    }
  }
}

}  // namespace

void laser_scan(Fields& fields, const Header& header, const LidarScan& scan, std::optional<int> ring) {
  const ScanAngles& angles = scan.horizontal;
  const auto samples = static_cast<std::size_t>(angles.samples);
  const std::size_t first = ring ? static_cast<std::size_t>(*ring) * samples : 0;
  const std::size_t count = ring ? samples : scan.ranges.size();
  put(fields, header);
  fields.put("angle_min", angles.min);
  fields.put("angle_max", angles.max);
  fields.put("angle_increment", angles.increment());
  fields.put("range_min", scan.min_range);
  fields.put("range_max", scan.max_range);
  fields.array("ranges", &scan.ranges[first], count);
  fields.array("intensities", &scan.intensities[first], count);
}

void lidar_cloud(Fields& fields, const Header& header, const LidarScan& scan, const CloudOptions& options) {
  const Returns returns(options);
  const std::size_t met = static_cast<std::size_t>(
      std::count_if(scan.ranges.begin(), scan.ranges.end(), [&](float range) { return returns.has(range); }));
  const CloudShape shape = options.organized ? CloudShape{static_cast<std::size_t>(scan.vertical.samples),
                                                          static_cast<std::size_t>(scan.horizontal.samples)}
                                             : CloudShape{1, met};
  put(fields, header);
  put_cloud(fields, shape, kReturnFields, kReturnSize,
            [&scan, options](std::uint8_t* place) { write_cloud(scan, options, place); });
  fields.put("is_dense", !options.organized);
}

void lidar_points(Fields& fields, const Header& header, const LidarScan& scan) {
  put(fields, header);
  fields.array("points", messages::FieldKind::kFloat32, 3 * scan.ranges.size(),
               [&scan](std::uint8_t* place) { write_points(scan, place); });
  fields.list("channels", std::array{&scan.intensities}, [&](const std::vector<float>* intensities) {
    fields.put("name", "intensities");
    fields.array("values", *intensities);
  });
}

float nearest_range(const LidarScan& scan) { return *std::min_element(scan.ranges.begin(), scan.ranges.end()); }

void range(Fields& fields, const Header& header, const RangeReading& reading) {
  put(fields, header);
  fields.put("radiation_type", reading.radiation);
  fields.put("field_of_view", reading.field_of_view);
  fields.put("min_range", reading.min_range);
  fields.put("max_range", reading.max_range);
  fields.put("range", reading.range);
}

}  // namespace bubblesim::reading_messages
