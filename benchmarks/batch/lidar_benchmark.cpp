// SPDX-License-Identifier: BSD-3-Clause
// Steps 64 worlds on two threads, in each of which a tricycle drives in a circle around a lidar of 360 rays amid 200
// boxes, and compares with ODE and Embree alone: tricycles and scans in plain loops on two threads.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "boxes.hpp"
#include "bubblesim/batch.hpp"
#include "bubblesim/scene_loader.hpp"
#include "raw_lidar.hpp"
#include "raw_tricycle.hpp"

namespace {

using namespace bubblesim;
using benchmarks::RawLidar;
using benchmarks::RawTricycle;

constexpr std::size_t kWorlds = 64;
constexpr std::size_t kThreads = 2;
constexpr std::size_t kRays = 360;
constexpr std::size_t kBoxes = 200;
constexpr std::size_t kSteps = 20;
constexpr int kRounds = 15;
constexpr double kSteering = 0.6;             // rad
constexpr double kSpeed = 2;                  // rad/s, of the front wheel
const Pose kLidar(-2.5, 0.26, 0.5, 0, 0, 0);  // the centre of the circle
constexpr double kClear = 4;                  // m, between the lidar and the middle of a box
constexpr float kBehindTricycle = 2.6F;       // m
const std::vector<Box> kParts{{{1.3, 0.4, 0.3}}, {{0.6, 0.1, 0.6}}, {{0.6, 0.1, 0.6}}, {{0.6, 0.1, 0.6}}};

LidarDescription lidar() {
  LidarDescription made;
  made.horizontal = {static_cast<int>(kRays), -M_PI, M_PI};
  made.max_range = 30;
  return made;
}

/// The scene `tricycle` with boxes instead of its room, and a lidar without a body.
std::shared_ptr<const Scene> scene_with(const std::vector<RawLidar::PlacedBox>& boxes) {
  SceneDescription description = load_scene("tricycle")->description();
  std::vector<ModelDescription>& models = description.models;
  models.erase(std::remove_if(models.begin(), models.end(), [](const auto& model) { return model.name == "Room"; }),
               models.end());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    models.push_back(benchmarks::model_of("Box" + std::to_string(i), boxes[i].box, boxes[i].pose, true));
  }
  models.push_back(benchmarks::model_of("Mast", Box{}, kLidar, true));
  models.back().links[0].collisions.clear();
  SensorDescription sensor;
  sensor.name = "Lidar";
  sensor.kind = lidar();
  models.back().links[0].sensors.push_back(sensor);
  return std::make_shared<const Scene>(std::move(description));
}

/// ODE and Embree alone. Worlds of a thread share one lidar, because the boxes are the same.
class RawWorlds {
 public:
  explicit RawWorlds(const std::vector<RawLidar::PlacedBox>& boxes) : ranges_(kWorlds) {
    std::vector<RawLidar::PlacedBox> parts;
    for (const Box& part : kParts) parts.push_back({part, {}});
    for (std::size_t i = 0; i < kThreads; ++i) lidars_.push_back(std::make_unique<RawLidar>(lidar(), boxes, parts));
    for (std::size_t i = 0; i < kWorlds; ++i) {
      tricycles_.push_back(std::make_unique<RawTricycle>());
      tricycles_.back()->drive(kSteering, kSpeed);
    }
  }

  void step() {
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < kThreads; ++k) others.emplace_back([this, k] { step_part(k); });
    step_part(0);
    for (std::thread& other : others) other.join();
  }

  const std::vector<float>& ranges(std::size_t world) const { return ranges_[world]; }

 private:
  void step_part(std::size_t thread) {
    std::vector<Pose> poses(kParts.size());
    for (std::size_t i = kWorlds * thread / kThreads; i < kWorlds * (thread + 1) / kThreads; ++i) {
      for (std::size_t step = 0; step < kSteps; ++step) {
        tricycles_[i]->step();
        for (std::size_t part = 0; part < poses.size(); ++part) {
          poses[part] = Pose(tricycles_[i]->x(), tricycles_[i]->y(), 0.3, 0, 0, static_cast<double>(part));
        }
        ranges_[i] = lidars_[thread]->scan(kLidar, poses);
      }
    }
  }

  std::vector<std::unique_ptr<RawLidar>> lidars_;
  std::vector<std::unique_ptr<RawTricycle>> tricycles_;
  std::vector<std::vector<float>> ranges_;
};

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// The largest difference of ranges to the boxes; the parts of the raw tricycle are drawn more simply.
float difference(const float* ours, const std::vector<float>& raw) {
  float largest = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (ours[i] > kBehindTricycle && raw[i] > kBehindTricycle && std::isfinite(ours[i]) && std::isfinite(raw[i])) {
      largest = std::max(largest, std::abs(ours[i] - raw[i]));
    }
  }
  return largest;
}

}  // namespace

int main() {
  const std::vector<RawLidar::PlacedBox> boxes = benchmarks::boxes_around(kLidar.position, kClear, kBoxes);
  BatchOptions options;
  options.worlds = kWorlds;
  options.threads = kThreads;
  options.actions = {"/FrontMotor.target_velocity", "/Steering.target_position"};
  options.observations = {"/Lidar.ranges"};
  Batch batch(scene_with(boxes), options);
  RawWorlds raw(boxes);
  std::vector<float> actions;
  for (std::size_t i = 0; i < kWorlds; ++i) {
    actions.insert(actions.end(), {static_cast<float>(kSpeed), static_cast<float>(kSteering)});
  }
  std::vector<float> observed(kWorlds * batch.observations().width());
  std::vector<double> relative;
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const double ours = seconds([&] {
      for (std::size_t step = 0; step < kSteps; ++step) batch.step(actions.data(), 1, observed.data());
    });
    relative.push_back(seconds([&] { raw.step(); }) / ours);
    times.push_back(1e6 * ours / (kWorlds * kSteps));
  }
  const float apart = difference(observed.data(), raw.ranges(0));
  std::printf(
      "%zu tricycles with lidars, %zu threads: %.1f us for each step of a world, %.2f x ODE and Embree alone;\n",
      kWorlds, kThreads, median(times), median(relative));
  std::printf("ranges differ by at most %.2g m\n", static_cast<double>(apart));
  return apart < 0.01F ? 0 : 1;
}
