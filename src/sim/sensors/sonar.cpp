// SPDX-License-Identifier: BSD-3-Clause
// Sonar: the nearest thing in a cone, found by a fan of rays.
#include <cmath>
#include <vector>

#include "kinds.hpp"

namespace bubblesim {
namespace {

// Rays on concentric rings: at the default 15 degrees and 1 m they lie at most 7 cm apart.
constexpr int kRings = 4;
constexpr int kRaysPerRing = 6;  // on the first ring; the n-th has n times as many

std::vector<Vector3> cone_rays(double half_angle) {
  std::vector<Vector3> rays{Vector3::UnitX};
  for (int ring = 1; ring <= kRings && half_angle > 0; ++ring) {
    const double tilt = half_angle * ring / kRings;
    const int count = kRaysPerRing * ring;
    for (int i = 0; i < count; ++i) {
      const double turn = 2 * M_PI * i / count;
      rays.emplace_back(std::cos(tilt), std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn));
    }
  }
  return rays;
}

class Sonar final : public Sensor {
 public:
  Sonar(const SonarDescription& description, ObjectId id, const World& world)
      : description_(description),
        id_(id),
        model_(world.tree().model_of(id)),
        rays_(cone_rays(description.half_angle)) {}

  void update(const World& world) override {
    const Pose sensor = world.pose(id_);
    reading_ = {};
    double reach = description_.max_range;
    for (const Vector3& ray : rays_) {
      const auto hit = world.cast_ray(sensor.Pos(), sensor.Rot().RotateVector(ray), reach, model_);
      if (!hit || hit->distance < description_.min_range) continue;
      reach = hit->distance;
      reading_ = {true, hit->distance, ray * hit->distance, sensor.Rot().RotateVectorReverse(hit->normal), hit->link};
    }
  }

  std::optional<ProximityReading> proximity() const override { return reading_; }

 private:
  SonarDescription description_;
  ObjectId id_;
  ObjectId model_;  // the sensor's own robot, which it does not see
  std::vector<Vector3> rays_;
  ProximityReading reading_;
};

}  // namespace

std::unique_ptr<Sensor> make_sonar(const SonarDescription& description, ObjectId id, const World& world) {
  return std::make_unique<Sonar>(description, id, world);
}

}  // namespace bubblesim
