// SPDX-License-Identifier: BSD-3-Clause
// Camera: a pinhole image with depth and visible objects. The centre of pixel (column, row) is at column + 0.5, row +
// 0.5 from the upper left corner; the optical axis is at the centre of the image.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rays/ray_scene.hpp"
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"
#include "sensors/shading.hpp"

namespace bubblesim {
namespace {

constexpr float kNoDepth = std::numeric_limits<float>::infinity();

/// Position of a ray in its pixel, from the pixel's upper left corner.
struct SubPixel {
  double column;
  double row;
};
constexpr SubPixel kCentre{0.5, 0.5};
constexpr std::array<SubPixel, 4> kFour = {{{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}};

class Camera final : public Sensor {
 public:
  Camera(const CameraDescription& description, const Environment& environment, ObjectId id)
      : Sensor(empty_image(description)),
        description_(description),
        id_(id),
        shading_(environment),
        focal_(description.width / (2 * std::tan(description.horizontal_fov / 2))) {}

 private:
  static CameraImage empty_image(const CameraDescription& description) {
    CameraImage image;
    image.width = description.width;
    image.height = description.height;
    image.horizontal_fov = description.horizontal_fov;
    image.near = description.near;
    image.far = description.far;
    return image;  // without pixels: most simulations never look at most cameras
  }

  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    auto& image = std::get<CameraImage>(measurement);
    const auto pixels = static_cast<std::size_t>(description_.width) * static_cast<std::size_t>(description_.height);
    image.depth.resize(pixels);
    image.objects.resize(pixels);
    if (description_.color) image.rgb.resize(3 * pixels);
    moment.rays.refresh(moment.world);
    if (description_.color) shading_.place_lights(moment.world);
    const Pose sensor = moment.world.pose(id_);
    const ignition::math::Matrix3d turn(sensor.Rot());
    const auto width = static_cast<std::size_t>(description_.width);
    Noise noise(description_.noise, moment, id_);
    std::vector<Color> colors(width);
    rays::RayPacket packet;
    for (std::size_t row = 0; row < static_cast<std::size_t>(description_.height); ++row) {
      const std::size_t start = row * width;
      std::fill(colors.begin(), colors.end(), Color{});
      const bool color_by_centre = description_.color && !description_.antialias;
      for (std::size_t first = 0; first < width; first += rays::kPacket) {
        const std::size_t count = std::min(rays::kPacket, width - first);
        aim(packet, sensor, turn, first, row, kCentre, count);
        moment.rays.trace(packet, true);
        measure_depth(moment.rays, packet, count, &image.depth[start + first], &image.objects[start + first]);
        if (color_by_centre) shading_.add(moment.rays, packet, count, 1, &colors[first]);
        if (!description_.color || color_by_centre) continue;
        for (const SubPixel& part : kFour) {
          aim(packet, sensor, turn, first, row, part, count);
          moment.rays.trace(packet, true);
          shading_.add(moment.rays, packet, count, 0.25F, &colors[first]);
        }
      }
      if (description_.color) {
        for (std::size_t i = 0; i < width; ++i) write(colors[i], noise, &image.rgb[3 * (start + i)]);
      } else if (noise.active()) {
        for (std::size_t i = 0; i < width; ++i) {
          float& depth = image.depth[start + i];
          if (std::isfinite(depth)) depth = static_cast<float>(noise(depth));
        }
      }
    }
  }

  /// Directions have length 1 along the camera's axis: distances are depths.
  void aim(rays::RayPacket& packet, const Pose& sensor, const ignition::math::Matrix3d& turn, std::size_t column,
           std::size_t row, const SubPixel& part, std::size_t count) const {
    // Surfaces nearer than the near plane are clipped, as by a graphics card.
    packet.start(sensor.Pos(), static_cast<float>(description_.near), static_cast<float>(description_.far), count);
    RTCRay16& ray = packet.data.ray;
    const double up = (description_.height / 2.0 - (static_cast<double>(row) + part.row)) / focal_;
    const double base[3] = {turn(0, 0) + up * turn(0, 2), turn(1, 0) + up * turn(1, 2), turn(2, 0) + up * turn(2, 2)};
    const double side[3] = {turn(0, 1), turn(1, 1), turn(2, 1)};
    const double first = description_.width / 2.0 - (static_cast<double>(column) + part.column);
    for (std::size_t i = 0; i < rays::kPacket; ++i) {
      const double left = (first - static_cast<double>(i)) / focal_;
      ray.dir_x[i] = static_cast<float>(base[0] + left * side[0]);
      ray.dir_y[i] = static_cast<float>(base[1] + left * side[1]);
      ray.dir_z[i] = static_cast<float>(base[2] + left * side[2]);
    }
  }

  static void measure_depth(const RayScene& scene, const rays::RayPacket& packet, std::size_t count, float* depth,
                            ObjectId* objects) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool hit = packet.hit(i);
      depth[i] = hit ? packet.data.ray.tfar[i] : kNoDepth;
      objects[i] = hit ? scene.shape(packet, i).link : kNoObject;
    }
  }

  static void write(const Color& color, Noise& noise, std::uint8_t* rgb) {
    const auto level = [&noise](float value) {
      const double noisy = noise.active() ? noise(value) : static_cast<double>(value);
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(noisy, 0.0, 1.0)));
    };
    rgb[0] = level(color.r);
    rgb[1] = level(color.g);
    rgb[2] = level(color.b);
  }

  CameraDescription description_;
  ObjectId id_;
  Shading shading_;
  double focal_;  // in pixels
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const CameraDescription& description, const SensorSite& site) {
  return std::make_unique<Camera>(description, site.environment, site.id);
}

}  // namespace bubblesim
