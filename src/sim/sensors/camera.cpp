// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "bubblesim/sensor_noise.hpp"
#include "rays/faces_in_view.hpp"
#include "rays/hit_groups.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_scene.hpp"
#include "sensors/shading.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {
namespace {

constexpr float kNoDepth = std::numeric_limits<float>::infinity();
constexpr std::size_t kRowsPerTile = 8;  // its columns are those of a packet
/// Smaller images do not repay the search for faces in view, nor do those with fewer pixels than the scene has shapes.
constexpr std::size_t kPixelsWorthFaces = 2048;
constexpr std::size_t kPixelsPerCaster = 48;  // likewise for each shape, of faces in light

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
        is_parallel_(description.orthographic_width > 0),
        focal_(description.width /
               (is_parallel_ ? description.orthographic_width : 2 * std::tan(description.horizontal_fov / 2))) {}

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
    bool has_faces;
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

  /// Before the first image, likewise.
  void place_columns() {
    const std::size_t padded = columns_per_packet(static_cast<std::size_t>(description_.width));
    const auto fill = [&](double part, std::vector<double>& left) {
      left.reserve(padded);
      for (std::size_t column = 0; column < padded; ++column) {
        left.push_back((description_.width / 2.0 - (static_cast<double>(column) + part)) / focal_);
      }
    };
    fill(kCentre, centres_);
    borders_.reserve(padded / rays::kPacket + 1);
    for (std::size_t column = 0; column <= padded; column += rays::kPacket) {
      borders_.push_back((description_.width / 2.0 - static_cast<double>(column)) / focal_);
    }
    if (!description_.antialias) return;
    for (std::size_t i = 0; i < kQuarters.size(); ++i) fill(kQuarters[i], quarters_[i]);
  }

  void measure(const MeasurementContext& context, Measurement& measurement) override {
    if (centres_.empty()) place_columns();
    auto& image = measurement.get<CameraImage>();
    const auto pixels = static_cast<std::size_t>(description_.width) * static_cast<std::size_t>(description_.height);
    image.depth.resize(pixels);
    image.objects.resize(pixels);
    if (description_.color) image.rgb.resize(3 * pixels);
    context.rays.refresh(context.world);
    if (description_.color) shading_.place_lights(context.world, context.brightness);
    const Pose sensor = context.world.pose(id_);
    const std::size_t shapes = context.rays.shape_count();
    if (description_.color && pixels >= std::max(kPixelsWorthFaces, kPixelsPerCaster * shapes)) {
      shading_.place_casters(context.rays, sensor.position, pixels);
    }
    const View view{context.rays, sensor.position, sensor.orientation.toRotationMatrix(),
                    !is_parallel_ && pixels >= std::max(kPixelsWorthFaces, shapes)};
    if (view.has_faces) {
      faces_.start({view.eye, view.turn, description_.near, description_.far, description_.width / 2.0 / focal_,
                    description_.height / 2.0 / focal_, pixels});
      context.rays.collect(faces_);
    }
    Noise noise(description_.noise, context, id_);
    colors_.resize(description_.color && noise.active() ? image.rgb.size() : 0);
    const std::size_t strips = (static_cast<std::size_t>(description_.height) + kRowsPerTile - 1) / kRowsPerTile;
    const auto measure = [&](std::size_t strip) { measure_strip(view, strip * kRowsPerTile, image); };
    if (pixels < kRaysWorthThreads) {
      for (std::size_t strip = 0; strip < strips; ++strip) measure(strip);
    } else {
      WorkerPool::shared().run(strips, measure);
    }
    // The values of the noise follow from each other: one thread, in the order of the pixels.
    for (std::size_t i = 0; i < colors_.size(); ++i) image.rgb[i] = level(noise(colors_[i]));
    if (description_.color || !noise.active()) return;
    for (float& depth : image.depth) {
      if (std::isfinite(depth)) depth = static_cast<float>(noise(depth));
    }
  }

  void measure_strip(const View& view, std::size_t first_row, CameraImage& image) {
    const std::size_t end = std::min(first_row + kRowsPerTile, static_cast<std::size_t>(description_.height));
    std::vector<rays::Tile> tiles;
    if (view.has_faces) {
      faces_.divide(up_of(static_cast<double>(end)), up_of(static_cast<double>(first_row)), borders_, tiles);
    }
    rays::RayPacket packet;
    // Surfaces nearer than the near plane are clipped, as by a graphics card.
    packet.start(view.eye, static_cast<float>(description_.near), static_cast<float>(description_.far), rays::kPacket);
    for (std::size_t row = first_row; row < end; ++row) {
      for (std::size_t i = 0; i + 1 < borders_.size(); ++i) {
        measure_pixels(view, view.has_faces ? &tiles[i] : nullptr, row, i * rays::kPacket, packet, image);
      }
    }
  }

  void measure_pixels(const View& view, const rays::Tile* tile, std::size_t row, std::size_t first,
                      rays::RayPacket& packet, CameraImage& image) {
    const auto width = static_cast<std::size_t>(description_.width);
    const std::size_t count = std::min(rays::kPacket, width - first);
    const std::size_t start = row * width + first;
    trace(view, tile, static_cast<double>(row) + kCentre, &centres_[first], count, packet);
    const rays::HitGroups groups(packet);
    measure_depth(view.scene, packet, groups, count, &image.depth[start], &image.objects[start]);
    if (!description_.color) return;
    lanes::Colors colors{};
    if (description_.antialias) {
      add_quarters(view, tile, row, first, count, packet, colors);
    } else {
      shading_.add(view.scene, packet, groups, 1, colors);
    }
    if (colors_.empty()) {
      lanes::to_bytes(colors, count, &image.rgb[3 * start]);
    } else {
      keep(colors, count, &colors_[3 * start]);
    }
  }

  void add_quarters(const View& view, const rays::Tile* tile, std::size_t row, std::size_t first, std::size_t count,
                    rays::RayPacket& packet, lanes::Colors& colors) {
    for (const double down : kQuarters) {
      for (const std::vector<double>& left : quarters_) {
        trace(view, tile, static_cast<double>(row) + down, &left[first], count, packet);
        shading_.add(view.scene, packet, rays::HitGroups(packet), 0.25F, colors);
      }
    }
  }

  double up_of(double down) const { return (description_.height / 2.0 - down) / focal_; }

  /// Traces rays `down` pixels from the upper border, and `left` from the optical axis, as parts of the focal length,
  /// or in m for parallel rays. Directions have length 1 along the camera's axis: distances are depths. `tile`: where
  /// they are, null without faces.
  void trace(const View& view, const rays::Tile* tile, double down, const double* left, std::size_t count,
             rays::RayPacket& packet) const {
    packet.restart(static_cast<float>(description_.far), count);
    const double up = up_of(down);
    const auto& turn = view.turn;
    if (is_parallel_) {
      for (std::size_t i = 0; i < rays::kPacket; ++i) {
        rays::aim(packet.data.ray, i, view.eye + turn * Vector3(0, left[std::min(i, count - 1)], up), turn.col(0));
      }
      view.scene.trace(packet, false);
      return;
    }
    const Vector3 base(turn(0, 0) + up * turn(0, 2), turn(1, 0) + up * turn(1, 2), turn(2, 0) + up * turn(2, 2));
    rays::aim(packet.data.ray, base, {turn(0, 1), turn(1, 1), turn(2, 1)}, left);
    if (tile == nullptr || tile->needs_rays) {
      view.scene.trace(packet, true);
    } else {
      faces_.rasterize(*tile, up, left, packet);
    }
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
  rays::FacesInView faces_;
  bool is_parallel_;
  double focal_;                 // in pixels; of parallel rays in pixels per m
  std::vector<double> centres_;  // of the columns, left of the axis, as parts of the focal length
  std::array<std::vector<double>, 2> quarters_;
  std::vector<double> borders_;  // of the packets, likewise
  std::vector<float> colors_;    // of an image before its noise; three per pixel
};

}  // namespace

std::unique_ptr<Sensor> make_camera(const CameraDescription& description, const Environment& environment, ObjectId id) {
  return std::make_unique<Camera>(description, environment, id);
}

}  // namespace bubblesim
