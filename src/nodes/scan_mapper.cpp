// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes MRPT: its headers are slow to compile.
#include "scan_mapper.hpp"

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

namespace bubblesim {

namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::maps::CSimplePointsMap;

constexpr double kLeastGoodness = 0.4;   // share of a scan's points that must fit for a match to count
constexpr float kPointDistance = 0.02F;  // m between points that scans are matched to
constexpr double kCatch = 0.4;           // m, largest distance of matched points at first, and ...
constexpr double kFineCatch = 0.02;      // ... at its end
constexpr float kHit = 0.85F;            // occupancy from one ray at its end: occupied until other rays pass
constexpr float kPassed = 0.78F;         // and of the cells that it passes: free at once
constexpr double kStartSize = 1.0;       // m; the grid grows with the scans

mrpt::Clock::time_point time_of(const ros::Time& stamp) { return mrpt::Clock::fromDouble(stamp.toSec()); }

/// What later versions of MRPT return as a reference is a pointer in MRPT 2.5.
template <typename T>
const auto& pointed_to(const T& object) {
  if constexpr (std::is_pointer_v<T>) {
    return *object;
  } else {
    return object;
  }
}

void configure(mrpt::slam::CMetricMapBuilderICP& builder, const ScanMapperOptions& options) {
  builder.setVerbosityLevel(mrpt::system::LVL_ERROR);
  auto& how = builder.ICP_options;
  how.matchAgainstTheGrid = false;
  how.insertionLinDistance = options.linear_update;
  how.insertionAngDistance = options.angular_update;
  how.localizationLinDistance = 0.0;  // each scan is matched: see docs/adr/0014
  how.localizationAngDistance = 0.0;
  how.minICPgoodnessToAccept = kLeastGoodness;

  COccupancyGridMap2D::TMapDefinition grid;
  grid.resolution = static_cast<float>(options.cell_size);
  grid.min_x = grid.min_y = static_cast<float>(-kStartSize);
  grid.max_x = grid.max_y = static_cast<float>(kStartSize);
  grid.insertionOpts.maxOccupancyUpdateCertainty = kHit;
  grid.insertionOpts.maxFreenessUpdateCertainty = kPassed;
  grid.insertionOpts.maxFreenessInvalidRanges = kPassed;
  grid.insertionOpts.maxDistanceInsertion = static_cast<float>(options.max_usable_range);
  how.mapInitializers.push_back(grid);
  CSimplePointsMap::TMapDefinition points;
  points.insertionOpts.minDistBetweenLaserPoints = kPointDistance;
  points.insertionOpts.fuseWithExisting = false;
  how.mapInitializers.push_back(points);

  auto& matching = builder.ICP_params;
  matching.maxIterations = 80;
  matching.thresholdDist = kCatch;
  matching.thresholdAng = 0.03;
  matching.ALFA = 0.7;
  matching.smallestThresholdDist = kFineCatch;
  matching.ICP_covariance_method = mrpt::slam::icpCovLinealMSE;  // cheaper; the covariance is not used
}

mrpt::obs::CObservation2DRangeScan::Ptr observed(const sensor_msgs::LaserScan& scan, const LidarMount& mount,
                                                 double max_usable_range) {
  auto seen = mrpt::obs::CObservation2DRangeScan::Create();
  const std::size_t count = scan.ranges.size();
  const double far = std::min<double>(scan.range_max, max_usable_range);
  seen->timestamp = time_of(scan.header.stamp);
  seen->sensorLabel = "scan";
  seen->rightToLeft = !mount.upside_down;
  // MRPT's fan is symmetric about its sensor's x axis.
  seen->aperture = static_cast<float>(scan.angle_increment * static_cast<double>(count - 1));
  const double middle = scan.angle_min + 0.5 * seen->aperture;
  const double heading = mount.pose.heading + (mount.upside_down ? -middle : middle);
  seen->sensorPose = mrpt::poses::CPose3D(mount.pose.x, mount.pose.y, 0.0, heading, 0.0, 0.0);
  seen->maxRange = static_cast<float>(far);
  seen->resizeScan(count);
  for (std::size_t ray = 0; ray < count; ++ray) {
    const double range = scan.ranges[ray];
    const bool hit = std::isfinite(range) && range >= scan.range_min && range < far;
    seen->setScanRange(ray, static_cast<float>(hit ? range : far));
    seen->setScanRangeValidity(ray, hit);
  }
  return seen;
}

std::int8_t per_cent(float free) {
  // Unseen cells keep log-odds of exactly 0, which is one half.
  return static_cast<std::int8_t>(std::lround(100.0F * (1.0F - free)));
}

/// First and last column or row with known cells.
struct Span {
  int first = std::numeric_limits<int>::max();
  int last = -1;

  void include(int place) {
    first = std::min(first, place);
    last = std::max(last, place);
  }
  [[nodiscard]] unsigned size() const { return last < first ? 0U : static_cast<unsigned>(last - first + 1); }
};

}  // namespace

void check(const ScanMapperOptions& options) {
  const auto require = [](bool holds, const char* problem) {
    if (!holds) throw std::invalid_argument(problem);
  };
  require(options.cell_size >= 0.005 && options.cell_size <= 10.0, "the cell size must be from 0.005 to 10 m");
  require(options.max_usable_range > 0.0, "the maximum usable range must be above 0 m");
  require(options.linear_update >= 0.0, "the linear update must not be negative");
  require(options.angular_update >= 0.0, "the angular update must not be negative");
}

struct ScanMapper::Builder {
  mrpt::slam::CMetricMapBuilderICP icp;
  double max_usable_range;
};

ScanMapper::ScanMapper(const ScanMapperOptions& options) : builder_(std::make_unique<Builder>()) {
  check(options);
  builder_->max_usable_range = options.max_usable_range;
  configure(builder_->icp, options);
  builder_->icp.initialize();
}

ScanMapper::~ScanMapper() = default;
ScanMapper::ScanMapper(ScanMapper&&) noexcept = default;
ScanMapper& ScanMapper::operator=(ScanMapper&&) noexcept = default;

PlanarPose ScanMapper::add(const sensor_msgs::LaserScan& scan, const LidarMount& mount, const PlanarPose& odometry) {
  if (scan.ranges.size() < 2 || !(scan.angle_increment > 0.0F))
    throw std::invalid_argument("a scan needs at least two rays and an angle_increment above 0");
  const auto moved = mrpt::obs::CObservationOdometry::Create();
  moved->timestamp = time_of(scan.header.stamp);
  moved->odometry = mrpt::poses::CPose2D(odometry.x, odometry.y, odometry.heading);
  builder_->icp.processObservation(moved);
  builder_->icp.processObservation(observed(scan, mount, builder_->max_usable_range));
  const mrpt::poses::CPose3D pose = builder_->icp.getCurrentPoseEstimation()->getMeanVal();
  return {pose.x(), pose.y(), pose.yaw()};
}

nav_msgs::OccupancyGrid ScanMapper::map() const {
  const auto grid = pointed_to(builder_->icp.getCurrentlyBuiltMetricMap()).mapByClass<COccupancyGridMap2D>();
  const auto unknown = COccupancyGridMap2D::p2l(0.5F);
  Span columns;
  Span rows;
  const int width = static_cast<int>(grid->getSizeX());
  const int height = static_cast<int>(grid->getSizeY());
  for (int y = 0; y < height; ++y) {
    const auto* row = grid->getRow(y);
    for (int x = 0; x < width; ++x) {
      if (row[x] == unknown) continue;
      columns.include(x);
      rows.include(y);
    }
  }
  nav_msgs::OccupancyGrid map;
  const double cell = grid->getResolution();
  map.info.resolution = static_cast<float>(cell);
  map.info.width = columns.size();
  map.info.height = rows.size();
  map.info.origin.orientation.w = 1.0;
  if (map.info.width == 0) return map;
  map.info.origin.position.x = grid->getXMin() + columns.first * cell;
  map.info.origin.position.y = grid->getYMin() + rows.first * cell;
  map.data.reserve(std::size_t{map.info.width} * map.info.height);
  for (int y = rows.first; y <= rows.last; ++y) {
    const auto* row = grid->getRow(y);
    for (int x = columns.first; x <= columns.last; ++x)
      map.data.push_back(row[x] == unknown ? std::int8_t{-1} : per_cent(COccupancyGridMap2D::l2p(row[x])));
  }
  return map;
}

}  // namespace bubblesim
