// SPDX-License-Identifier: BSD-3-Clause
#include "scan_shape.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace bubblesim {

namespace {

constexpr double kTurn = 2.0 * 3.141592653589793;
constexpr double kMostRays = 1e6;

void require(bool holds, const std::string& problem) {
  if (!holds) throw std::invalid_argument(problem);
}

double rays(const ScanShape& shape) { return std::ceil((shape.angle_max - shape.angle_min) / shape.angle_increment); }

}  // namespace

void check(const ScanShape& shape) {
  require(std::isfinite(shape.angle_min) && std::isfinite(shape.angle_max), "angle_min and angle_max must be finite");
  require(shape.angle_increment > 0.0 && std::isfinite(shape.angle_increment), "angle_increment must be above 0");
  require(shape.angle_max > shape.angle_min, "angle_max must be above angle_min");
  require(shape.angle_max - shape.angle_min < kTurn + shape.angle_increment,
          "angle_max - angle_min must not exceed one turn");
  require(rays(shape) <= kMostRays, "angle_increment is too small: more than a million rays");
  require(shape.scan_time >= 0.0, "scan_time must not be negative");
  require(shape.range_min >= 0.0, "range_min must not be negative");
  require(shape.range_max > shape.range_min, "range_max must be above range_min");
  require(shape.inf_epsilon >= 0.0, "inf_epsilon must not be negative");
}

sensor_msgs::LaserScan empty_scan(const ScanShape& shape) {
  sensor_msgs::LaserScan scan;
  scan.angle_min = static_cast<float>(shape.angle_min);
  scan.angle_max = static_cast<float>(shape.angle_max);
  scan.angle_increment = static_cast<float>(shape.angle_increment);
  scan.scan_time = static_cast<float>(shape.scan_time);
  scan.range_min = static_cast<float>(shape.range_min);
  scan.range_max = static_cast<float>(std::fmin(shape.range_max, std::numeric_limits<float>::max()));
  const double nothing = shape.use_inf ? std::numeric_limits<double>::infinity() : shape.range_max + shape.inf_epsilon;
  scan.ranges.assign(static_cast<std::size_t>(rays(shape)), static_cast<float>(nothing));
  return scan;
}

ScanFiller::ScanFiller(const ScanShape& shape, sensor_msgs::LaserScan& scan)
    : shape_(shape),
      closed_(shape.angle_max - shape.angle_min > kTurn - 0.5 * shape.angle_increment),
      rays_per_radian_(1.0 / shape.angle_increment),
      scan_(scan) {}

void ScanFiller::add(double x, double y) {
  const double range = std::sqrt(x * x + y * y);
  if (!(range >= shape_.range_min && range <= shape_.range_max)) return;
  double angle = std::atan2(y, x);
  if (angle < shape_.angle_min) angle += kTurn;  // angles may range from 0 to 2 pi
  if (angle > shape_.angle_max) {
    angle -= kTurn;
    if (angle < shape_.angle_min) return;
  }
  std::size_t ray = static_cast<std::size_t>(std::lrint((angle - shape_.angle_min) * rays_per_radian_));
  if (ray >= scan_.ranges.size()) {
    if (!closed_) return;
    ray = 0;
  }
  float& nearest = scan_.ranges[ray];
  if (static_cast<float>(range) < nearest) nearest = static_cast<float>(range);
}

}  // namespace bubblesim
