// SPDX-License-Identifier: BSD-3-Clause
// Sonar and other proximity sensors: the nearest surface in a volume, found by rays that fill the volume.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "rays/ray_scene.hpp"
#include "scene/describe.hpp"
#include "sensors/define.hpp"

namespace bubblesim {
namespace {

// Rays on concentric rings: at the default 15 degrees and 1 m they are at most 7 cm apart.
constexpr int kRings = 4;
constexpr int kRaysPerRing = 6;  // on the first ring; the n-th has n times as many
constexpr int kRaysAcross = 8;   // of a pyramid, in each direction
constexpr int kRaysOfDisc = 61;  // odd: one ray is on the axis

struct VolumeRay {
  Vector3 start;      // in the sensor's frame
  Vector3 direction;  // of unit length
};

Vector3 on_ring(int ring, int i) {
  const double turn = 2 * M_PI * i / (kRaysPerRing * ring);
  return {0, std::cos(turn) * ring / kRings, std::sin(turn) * ring / kRings};
}

std::vector<VolumeRay> fill(const SonarDescription& sonar) {
  std::vector<VolumeRay> rays;
  const double radius = sonar.max_range * std::tan(sonar.half_angle);
  const auto turned = [](double pitch, double yaw) {
    return Vector3(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
  };
  if (sonar.half_angle == 0 || sonar.volume == ProximityVolume::kRay) return {{Vector3::Zero(), Vector3::UnitX()}};
  switch (sonar.volume) {
    case ProximityVolume::kCone:
    case ProximityVolume::kCylinder:
      rays.push_back({Vector3::Zero(), Vector3::UnitX()});
      for (int ring = 1; ring <= kRings; ++ring) {
        for (int i = 0; i < kRaysPerRing * ring; ++i) {
          const Vector3 side = on_ring(ring, i);
          if (sonar.volume == ProximityVolume::kCylinder) {
            rays.push_back({side * radius, Vector3::UnitX()});
          } else {
            const double tilt = sonar.half_angle * side.norm();
            rays.push_back({Vector3::Zero(), Vector3::UnitX() * std::cos(tilt) + side.normalized() * std::sin(tilt)});
          }
        }
      }
      break;
    case ProximityVolume::kPyramid:
      rays.push_back({Vector3::Zero(), Vector3::UnitX()});
      for (int row = 0; row < kRaysAcross; ++row) {
        for (int column = 0; column < kRaysAcross; ++column) {
          const auto across = [&](int i) { return std::tan(sonar.half_angle) * (2.0 * i / (kRaysAcross - 1) - 1); };
          rays.push_back({Vector3::Zero(), Vector3(1, across(column), across(row)).normalized()});
        }
      }
      break;
    case ProximityVolume::kDisc:
      for (int i = 0; i < kRaysOfDisc; ++i) {
        rays.push_back({Vector3::Zero(), turned(0, sonar.half_angle * (2.0 * i / (kRaysOfDisc - 1) - 1))});
      }
      break;
    case ProximityVolume::kRay:
      break;
  }
  return rays;
}

class Sonar final : public Sensor {
 public:
  Sonar(const SonarDescription& description, ObjectId id, const World& world)
      : Sensor(ProximityReading{}),
        description_(description),
        id_(id),
        model_(world.tree().outermost_model_of(id)),
        rays_(fill(description)),
        least_cosine_(description.max_normal_angle > 0 ? std::cos(description.max_normal_angle) : -1) {}

  std::size_t ray_count() const override { return rays_.size(); }

 private:
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    context.rays.refresh(context.world);
    const Pose sensor = context.world.pose(id_);
    ProximityReading nearest;
    nearest.distance = description_.max_range;
    rays::RayPacket packet;
    for (std::size_t first = 0; first < rays_.size(); first += rays::kPacket) {
      const std::size_t count = std::min(rays::kPacket, rays_.size() - first);
      packet.start(sensor.position, static_cast<float>(description_.min_range), static_cast<float>(nearest.distance),
                   count);
      for (std::size_t i = 0; i < rays::kPacket; ++i) {
        const VolumeRay& ray = rays_[first + std::min(i, count - 1)];
        rays::aim(packet.data.ray, i, sensor * ray.start, sensor.orientation * ray.direction);
      }
      context.rays.trace(packet, false, model_);
      for (std::size_t i = 0; i < count; ++i) {
        const double distance = packet.data.ray.tfar[i];
        if (!packet.hit(i) || distance > nearest.distance) continue;
        const VolumeRay& ray = rays_[first + i];
        const Vector3 normal = sensor.orientation.conjugate() * context.rays.normal(packet, i);
        if (-normal.dot(ray.direction) < least_cosine_) continue;
        if (!detects(context.world, context.rays.shape(packet, i).link)) continue;
        nearest = {true, distance, ray.start + ray.direction * distance, normal, context.rays.shape(packet, i).link};
      }
    }
    if (!nearest.detected) nearest.distance = 0;
    measurement = nearest;
  }

  bool detects(const World& world, ObjectId link) const {
    const std::vector<std::string>& names = description_.detects;
    return names.empty() || std::find(names.begin(), names.end(), world.tree().at(link).name) != names.end();
  }

  SonarDescription description_;
  ObjectId id_;
  ObjectId model_;  // the sensor's own model, which it does not detect
  std::vector<VolumeRay> rays_;
  double least_cosine_;  // of the angle between a ray and the normal
};

}  // namespace

const MemberTable& SonarDescription::members() {
  static const MemberTable table = member_table<SonarDescription>(
      "SonarDescription", "A sensor that measures the distance to the nearest surface in a volume.",
      {
          member<&SonarDescription::min_range>("min_range", "m", "nearer surfaces are not detected"),
          member<&SonarDescription::max_range>("max_range", "m", "length of the volume"),
          member<&SonarDescription::half_angle>("half_angle", "rad", "between the axis and the volume's side"),
          member<&SonarDescription::volume>("volume", "", "shape of the volume")
              .with_choices({"ray", "cone", "pyramid", "disc", "cylinder"}),
          member<&SonarDescription::max_normal_angle>("max_normal_angle", "rad",
                                                      "between a ray and the normal of a surface; 0: any"),
          member<&SonarDescription::detects>("detects", "", "names of the links that it detects; empty: all"),
      });
  return table;
}

const MemberTable& ProximityReading::members() {
  static const MemberTable table = member_table<ProximityReading>(
      "ProximityReading", "Reading of a proximity sensor, in its own frame: it measures along x.",
      {
          member<&ProximityReading::detected>("detected", "", "whether there is a surface").with_quantity("detected"),
          member<&ProximityReading::distance>("distance", "m", "to the nearest surface; 0 if nothing was detected"),
          member<&ProximityReading::point>("point", "m", "the nearest point"),
          member<&ProximityReading::normal>("normal", "", "of the surface at that point"),
          member<&ProximityReading::object>("handle", "", "of the detected link, or -1"),
      });
  return table;
}

class SonarKind final : public SensorDefinitionOf<SonarDescription, ProximityReading> {
 public:
  SonarKind() : SensorDefinitionOf("proximity sensor", {"sonar"}) {
    id = "proximity";
    reader.clear();  // read_proximity() returns the tuple that scripts get
    elements = R"(
  sonar none
    geometry text cone ~ bubblesim:volume chooses the volume
    min number 0 required
    max number 1 required
    radius number 0.5
    bubblesim:volume text cone
    bubblesim:max_normal_angle number 0
    bubblesim:detects text
)";
    observe("distance", "m", "to the nearest surface; the maximum range if nothing was detected", Sizes{},
            [](const ProximityReading& reading, const SonarDescription& sonar, Row& row) {
              row.put(reading.detected ? reading.distance : sonar.max_range);
            });
  }

  std::optional<SonarDescription> read(SensorElement& sensor) const override {
    if (!sensor.has("sonar")) {
      sensor.report("", "a sonar needs a <sonar> element with <min>, <max> and <radius>");
      return std::nullopt;
    }
    SonarDescription sonar;
    sonar.min_range = sensor.number("sonar/min");
    sonar.max_range = sensor.number("sonar/max");
    sonar.half_angle = std::atan2(sensor.number("sonar/radius"), sonar.max_range);  // radius at max
    const auto volume = sensor.choice("sonar/bubblesim:volume", SonarDescription::members().find("volume")->choices);
    if (!volume) return std::nullopt;
    sonar.volume = static_cast<ProximityVolume>(*volume);
    sonar.max_normal_angle = sensor.number("sonar/bubblesim:max_normal_angle");
    std::istringstream names(sensor.text("sonar/bubblesim:detects"));
    for (std::string name; names >> name;) sonar.detects.push_back(name);
    return sonar;
  }

  void check(SensorCheck& check, const SonarDescription& sonar) const override {
    check.require_ranges(sonar.min_range, sonar.max_range);
    check.require(sonar.half_angle >= 0 && sonar.half_angle < M_PI / 2, "the cone's half angle",
                  text(sonar.half_angle) + " rad", "from 0 to below pi/2");
    check.require(sonar.max_normal_angle >= 0 && sonar.max_normal_angle <= M_PI, "the angle to the normal",
                  text(sonar.max_normal_angle) + " rad", "from 0 to pi");
  }

  std::unique_ptr<Sensor> make(const SonarDescription& description, const SensorSite& site) const override {
    return std::make_unique<Sonar>(description, site.id, site.world);
  }
};

template std::unique_ptr<SensorDefinition> define<SonarKind>();

}  // namespace bubblesim
