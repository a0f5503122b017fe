// SPDX-License-Identifier: BSD-3-Clause
// Camera: a pinhole image with depth and visible objects. The centre of pixel (column, row) is at column + 0.5, row +
// 0.5 from the upper left corner; the optical axis is at the centre of the image.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rays/hit_groups.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_scene.hpp"
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"
#include "sensors/shading.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {
namespace {

constexpr float kNoDepth = std::numeric_limits<float>::infinity();
constexpr std::size_t kRowsPerPart = 8;  // of a large image, on one thread

// Positions of rays in a pixel, from the pixel's upper left corner.
constexpr double kCentre = 0.5;
constexpr std::array<double, 2> kQuarters = {0.25, 0.75};

class Camera final : public Sensor {
 public:
  Camera(const CameraDescription& description, const Environment& environment, ObjectId id)
      : Sensor(empty_image(description)),
        description_(description),
        id_(id),
        shading_(environment),
        focal_(description.width / (2 * std::tan(description.horizontal_fov / 2))) {
    const std::size_t padded = columns_per_packet(static_cast<std::size_t>(description.width));
    const auto fill = [&](double part, std::vector<double>& left) {
      for (std::size_t column = 0; column < padded; ++column) {
        left.push_back((description.width / 2.0 - (static_cast<double>(column) + part)) / focal_);
      }
    };
    fill(kCentre, centres_);
    if (!description.antialias) return;
    for (std::size_t i = 0; i < kQuarters.size(); ++i) fill(kQuarters[i], quarters_[i]);
  }

  std::size_t ray_count() const override {
    const auto pixels = static_cast<std::size_t>(description_.width) * static_cast<std::size_t>(description_.height);
    return pixels * (description_.antialias ? 1 + quarters_.size() * quarters_.size() : 1);
  }

 private:
  /// What the rays of an image have in common.
  struct View {
    const RayScene& scene;
    Vector3 eye;
    Matrix3 turn;
  };

  static CameraImage empty_image(const CameraDescription& description) {
    CameraImage image;
    image.width = description.width;
    image.height = description.height;
    image.horizontal_fov = description.horizontal_fov;
    image.near = description.near;
    image.far = description.far;
    return image;  // without pixels: most simulations never look at most cameras
  }

  static std::size_t columns_per_packet(std::size_t columns) {
    return (columns + rays::kPacket - 1) / rays::kPacket * rays::kPacket;
  }

  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    auto& image = std::get<CameraImage>(measurement);
    const auto pixels = static_cast<std::size_t>(description_.width) * static_cast<std::size_t>(description_.height);
    image.depth.resize(pixels);
    image.objects.resize(pixels);
    if (description_.color) image.rgb.resize(3 * pixels);
    moment.rays.refresh(moment.world);
    if (description_.color) shading_.place_lights(moment.world, moment.brightness);
    const Pose sensor = moment.world.pose(id_);
    const View view{moment.rays, sensor.position, sensor.orientation.toRotationMatrix()};
    Noise noise(description_.noise, moment, id_);
    colors_.resize(description_.color && noise.active() ? image.rgb.size() : 0);
    const auto rows = static_cast<std::size_t>(description_.height);
    const std::size_t length = image.depth.size() < kRaysWorthThreads ? rows : kRowsPerPart;
    WorkerPool::shared().run((rows + length - 1) / length, [&](std::size_t part) {
      for (std::size_t row = part * length; row < std::min(rows, (part + 1) * length); ++row) {
        measure_row(view, row, image);
      }
    });
    // The values of the noise follow from each other: one thread, in the order of the pixels.
    for (std::size_t i = 0; i < colors_.size(); ++i) image.rgb[i] = level(noise(colors_[i]));
    if (description_.color || !noise.active()) return;
    for (float& depth : image.depth) {
      if (std::isfinite(depth)) depth = static_cast<float>(noise(depth));
    }
  }

  void measure_row(const View& view, std::size_t row, CameraImage& image) {
    const auto width = static_cast<std::size_t>(description_.width);
    rays::RayPacket packet;
    for (std::size_t first = 0; first < width; first += rays::kPacket) {
      const std::size_t count = std::min(rays::kPacket, width - first);
      const std::size_t start = row * width + first;
      trace(view, static_cast<double>(row) + kCentre, &centres_[first], count, packet);
      const rays::HitGroups groups(packet);
      measure_depth(view.scene, packet, groups, count, &image.depth[start], &image.objects[start]);
      if (!description_.color) continue;
      lanes::Colors colors{};
      if (description_.antialias) {
        add_quarters(view, row, first, count, colors);
      } else {
        shading_.add(view.scene, packet, groups, 1, colors);
      }
      if (colors_.empty()) {
        lanes::to_bytes(colors, count, &image.rgb[3 * start]);
      } else {
        keep(colors, count, &colors_[3 * start]);
      }
    }
  }

  void add_quarters(const View& view, std::size_t row, std::size_t first, std::size_t count, lanes::Colors& colors) {
    rays::RayPacket packet;
    for (const double down : kQuarters) {
      for (const std::vector<double>& left : quarters_) {
        trace(view, static_cast<double>(row) + down, &left[first], count, packet);
        shading_.add(view.scene, packet, rays::HitGroups(packet), 0.25F, colors);
      }
    }
  }

  /// Traces rays `down` pixels from the upper border, and `left` from the optical axis, as parts of the focal length.
  /// Directions have length 1 along the camera's axis: distances are depths.
  void trace(const View& view, double down, const double* left, std::size_t count, rays::RayPacket& packet) const {
    // Surfaces nearer than the near plane are clipped, as by a graphics card.
    packet.start(view.eye, static_cast<float>(description_.near), static_cast<float>(description_.far), count);
    const double up = (description_.height / 2.0 - down) / focal_;
    const auto& turn = view.turn;
    const Vector3 base(turn(0, 0) + up * turn(0, 2), turn(1, 0) + up * turn(1, 2), turn(2, 0) + up * turn(2, 2));
    rays::aim(packet.data.ray, base, {turn(0, 1), turn(1, 1), turn(2, 1)}, left);
    view.scene.trace(packet, true);
  }

  static void measure_depth(const RayScene& scene, const rays::RayPacket& packet, const rays::HitGroups& groups,
                            std::size_t count, float* depth, ObjectId* objects) {
    rays::keep_distances(packet.data.ray, groups.hits(), kNoDepth, count, depth);
    std::fill_n(objects, count, kNoObject);
    for (const rays::HitGroup& group : groups) {
      rays::keep_object(scene.shape(packet, group.ray).link, group.members, count, objects);
    }
  }

  static void keep(const lanes::Colors& colors, std::size_t count, float* rgb) {
    for (std::size_t i = 0; i < count; ++i) {
      rgb[3 * i] = colors.r[i];
      rgb[3 * i + 1] = colors.g[i];
      rgb[3 * i + 2] = colors.b[i];
    }
  }

  static std::uint8_t level(double value) { return static_cast<std::uint8_t>(255 * std::clamp(value, 0.0, 1.0) + 0.5); }

  CameraDescription description_;
  ObjectId id_;
  Shading shading_;
  double focal_;                 // in pixels
  std::vector<double> centres_;  // of the columns, left of the axis, as parts of the focal length
  std::array<std::vector<double>, 2> quarters_;
  std::vector<float> colors_;  // of an image before its noise; three per pixel
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const CameraDescription& description, const SensorSite& site) {
  return std::make_unique<Camera>(description, site.environment, site.id);
}

}  // namespace bubblesim
