// SPDX-License-Identifier: BSD-3-Clause
// Compares scans of a lidar among 200 static and 6 moving boxes with the same lidar implemented directly with Embree.
// The lidar turns from scan to scan, or stands still: then bubblesim keeps what it sees of the static boxes.
// The candidates run alternately, so that other load affects them equally. Embree alone uses one core, bubblesim all of
// them for the larger scan; the ratio of CPU times is that on one core.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "boxes.hpp"
#include "bubblesim/simulation.hpp"
#include "raw_lidar.hpp"

namespace {

using namespace bubblesim;
using benchmarks::model_of;
using benchmarks::RawLidar;

constexpr int kMoving = 6;
constexpr std::size_t kStill = 200;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Microseconds.
struct Times {
  double elapsed = 0;
  double used = 0;  ///< CPU time of all threads

  Times& operator+=(const Times& other) {
    elapsed += other.elapsed;
    used += other.used;
    return *this;
  }
};

double used_time() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return 1e6 * static_cast<double>(used.tv_sec) + 1e-3 * static_cast<double>(used.tv_nsec);
}

Times timed(const std::function<void()>& call) {
  const double used = used_time();
  const auto start = std::chrono::steady_clock::now();
  call();
  return {std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count(),
          used_time() - used};
}

Pose moved(int i, int turn) {
  return {2.0 * std::cos(i + 0.01 * turn), 2.0 * std::sin(i + 0.01 * turn), 0.6, 0, 0, 0.1 * turn};
}

struct Case {
  const char* name;
  int samples;
  int rings;
  int scans;  // per round
  bool housed = false;
  bool stands = false;
};

Pose place_of_lidar(const Case& scans, int turn) { return {0, 0, 0.5, 0, 0, 0.3 + (scans.stands ? 0 : 0.01 * turn)}; }

/// Prints the line of a case; returns false if the ranges of both differ.
bool run(const Case& scans, int rounds) {
  LidarDescription lidar;
  lidar.horizontal = {scans.samples, -M_PI, M_PI};
  lidar.vertical = {scans.rings, scans.rings > 1 ? -0.26 : 0, scans.rings > 1 ? 0.26 : 0};
  lidar.max_range = 30;

  SceneDescription scene;
  scene.gravity = Vector3::Zero();
  scene.models.push_back(model_of("Ground", Plane{}, {}, true));
  const std::vector<RawLidar::PlacedBox> still = benchmarks::boxes_around(Vector3::Zero(), 3, kStill);
  for (std::size_t i = 0; i < still.size(); ++i) {
    scene.models.push_back(model_of("Box" + std::to_string(i), still[i].box, still[i].pose, true));
  }
  const Box part{{0.4, 0.3, 0.3}};
  for (int i = 0; i < kMoving; ++i)
    scene.models.push_back(model_of("Part" + std::to_string(i), part, moved(i, 0), false));
  scene.models.push_back(model_of("Mast", Cylinder{0.05, 0.1}, place_of_lidar(scans, 0), scans.stands));
  if (!scans.housed) scene.models.back().links[0].collisions.clear();
  SensorDescription sensor;
  sensor.name = "Lidar";
  sensor.kind = lidar;
  scene.models.back().links[0].sensors.push_back(sensor);
  Simulation simulation(scene);
  const ObjectId id = simulation.world().tree().find("/Lidar");
  RawLidar raw(lidar, still, std::vector<RawLidar::PlacedBox>(kMoving, {part, {}}));

  std::vector<double> ours;
  std::vector<double> limit;
  std::vector<double> used;  // CPU time relative to Embree's
  float apart = 0;
  int turn = 0;
  std::vector<Pose> poses(kMoving);
  for (int round = 0; round < rounds; ++round) {
    Times our_time;
    Times raw_time;
    for (int i = 0; i < scans.scans; ++i, ++turn) {
      for (int part_index = 0; part_index < kMoving; ++part_index) {
        const auto index = static_cast<std::size_t>(part_index);
        poses[index] = moved(part_index, turn);
        simulation.world().set_pose(simulation.world().tree().find("/Part" + std::to_string(part_index)), poses[index]);
      }
      const Pose place = place_of_lidar(scans, turn);
      if (!scans.stands) simulation.world().set_pose(simulation.world().tree().find("/Mast"), place);
      std::shared_ptr<const Reading> reading;
      const std::vector<float>* ranges = nullptr;
      our_time += timed([&] { reading = simulation.measure(id); });
      raw_time += timed([&] { ranges = &raw.scan(place, poses); });
      const std::vector<float>& found = reading->measurement.get<LidarScan>().ranges;
      for (std::size_t ray = 0; ray < found.size() && turn % 50 == 0; ++ray) {
        if (std::isfinite(found[ray])) apart = std::max(apart, std::abs(found[ray] - (*ranges)[ray]));
      }
    }
    ours.push_back(our_time.elapsed / scans.scans);
    limit.push_back(raw_time.elapsed / scans.scans);
    used.push_back(raw_time.used / our_time.used);
  }
  std::printf("%-18s %16.1f %12.1f %26.3f %20.3f %20.2g\n", scans.name, median(ours), median(limit),
              median(limit) / median(ours), median(used), static_cast<double>(apart));
  return apart < 0.01;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 41;
  std::printf("%-18s %16s %12s %26s %20s %20s\n", "lidar", "bubblesim, us", "Embree, us", "speed relative to Embree",
              "the same, CPU time", "max. difference, m");
  bool agree = true;
  // In a housing: a cylinder around the sensor, from inside which it measures; Embree alone does not handle this.
  for (const Case& scans :
       {Case{"360", 360, 1, 200}, Case{"16 x 1800", 1800, 16, 10}, Case{"360, housed", 360, 1, 200, true},
        Case{"16 x 1800, housed", 1800, 16, 10, true}, Case{"360, stands", 360, 1, 200, false, true},
        Case{"16 x 1800, stands", 1800, 16, 10, false, true}}) {
    agree = run(scans, rounds) && agree;
  }
  return agree ? 0 : 1;
}
