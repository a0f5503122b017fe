// SPDX-License-Identifier: BSD-3-Clause
// Camera: an image of a pinhole, or of parallel rays, with depth and visible objects. The centre of pixel (column, row)
// is at column + 0.5, row + 0.5 from the upper left corner; the optical axis is at the centre of the image.
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
#include "scene/describe.hpp"
#include "sensors/define.hpp"
#include "sensors/shading.hpp"
#include "sensors/worker_pool.hpp"
#include "validation/limits.hpp"

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
               (is_parallel_ ? description.orthographic_width : 2 * std::tan(description.horizontal_fov / 2))) {
    const std::size_t padded = columns_per_packet(static_cast<std::size_t>(description.width));
    const auto fill = [&](double part, std::vector<double>& left) {
      for (std::size_t column = 0; column < padded; ++column) {
        left.push_back((description.width / 2.0 - (static_cast<double>(column) + part)) / focal_);
      }
    };
    fill(kCentre, centres_);
    for (std::size_t column = 0; column <= padded; column += rays::kPacket) {
      borders_.push_back((description.width / 2.0 - static_cast<double>(column)) / focal_);
    }
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

  void measure(const MeasurementContext& context, Measurement& measurement) override {
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

namespace {

constexpr int kMaxPixels = 16384;  // width and height

/// Gazebo accepts half a turn, for which the image plane would be infinite.
double read_field_of_view(const SensorElement& sensor) {
  constexpr double kWide = 3.1;
  constexpr double kWidest = 3.13;
  const double angle = sensor.number("camera/horizontal_fov");
  if (!(angle > kWide && angle <= M_PI + 1e-3)) return angle;
  const std::string taken = angle > kWidest ? ", using " + text(kWidest) : "";
  sensor.warn("camera/horizontal_fov", "the horizontal field of view is " + text(angle) + " rad" + taken +
                                           ": objects ahead are tiny in such an image");
  return std::min(angle, kWidest);
}

Sizes rows_and_columns(const CameraImage& image) {
  return {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)};
}

Sizes rows_columns_and_colors(const CameraImage& image) {
  return {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width), 3};
}

std::optional<Sizes> observed_colors(const CameraDescription& camera) {
  if (!camera.color) return std::nullopt;
  return Sizes{static_cast<std::size_t>(camera.height), static_cast<std::size_t>(camera.width), 3};
}

std::optional<Sizes> observed_depths(const CameraDescription& camera) {
  return Sizes{static_cast<std::size_t>(camera.height), static_cast<std::size_t>(camera.width)};
}

}  // namespace

const MemberTable& CameraDescription::members() {
  using D = CameraDescription;
  static const MemberTable table = member_table<D>(
      "CameraDescription", "A camera that looks along x, with y to the left and z up: a pinhole, or parallel rays.",
      {
          member<&D::width>("width", "", "pixels"),
          member<&D::height>("height", "", "pixels"),
          member<&D::horizontal_fov>("horizontal_fov", "rad", "horizontal field of view"),
          member<&D::orthographic_width>("orthographic_width", "m",
                                         "that the image shows from left to right, by parallel rays; 0: a pinhole"),
          member<&D::near>("near", "m", "near plane, along the axis"),
          member<&D::far>("far", "m", "far plane, along the axis"),
          member<&D::color>("color", "", "whether it measures colours besides depths"),
          member<&D::antialias>("antialias", "", "four rays per pixel"),
          member<&D::noise>("noise", "", "noise of each colour value (0 to 1), or of the depth in m without colours"),
          computed<D>("kind", "", "camera or depth_camera",
                      [](const D& d) { return std::string(d.color ? "camera" : "depth_camera"); })
              .unlisted(),
      });
  return table;
}

const MemberTable& CameraImage::members() {
  using I = CameraImage;
  static const MemberTable table = member_table<I>(
      "CameraImage", "Image of a camera, top row first. Its arrays are read-only.",
      {
          member<&I::width>("width", "", "pixels"),
          member<&I::height>("height", "", "pixels"),
          member<&I::horizontal_fov>("horizontal_fov", "rad", "horizontal field of view"),
          member<&I::near>("near", "m", "near plane, along the optical axis"),
          member<&I::far>("far", "m", "far plane, along the optical axis"),
          member<&I::rgb>("rgb", "", "height x width x 3: red, green and blue; None for a depth camera")
              .with_shape(rows_columns_and_colors)
              .or_none(),
          member<&I::depth>("depth", "m",
                            "height x width, along the optical axis: at least the near plane; inf beyond the far plane")
              .with_shape(rows_and_columns),
          member<&I::objects>("objects", "", "height x width: handles of the visible links, -1 for none")
              .with_shape(rows_and_columns),
      });
  return table;
}

class CameraKind final : public SensorDefinitionOf<CameraDescription, CameraImage> {
 public:
  CameraKind() : SensorDefinitionOf("camera", {"camera", "depth_camera", "rgbd_camera", "segmentation_camera"}) {
    renamed = {{"depth", "depth_camera"}, {"rgbd", "rgbd_camera"}, {"segmentation", "segmentation_camera"}};
    elements = R"(
  camera none
    @name text
    pose pose
      &pose
    horizontal_fov number 1.047 required
    image none
      width integer 320 required
      height integer 240 required
      format text R8G8B8 ~ images are RGB, or depth
      anti_aliasing integer 4 ~ bubblesim:antialias chooses it
    clip none
      near number 0.1 required
      far number 100 required
    depth_camera none
      output text depths ~ depth is in metres along the axis
      clip none
        near number 0.1
        far number 10
    noise none
      &noise_of_rays
    save any ~ images are not written to files
    distortion any ~ the camera has no distortion
    lens any ~ the camera is a pinhole
    segmentation_type text semantic ~ the image has the visible objects
    box_type text 2d ~ bounding boxes are not measured
    visibility_mask integer 4294967295 ~ all is visible
    trigger_topic text ~ cameras run at their rate
    triggered flag false ~ cameras run at their rate
    optical_frame_id text
    camera_info_topic text
    bubblesim:antialias text false
    bubblesim:orthographic_width number 0
)";
    observe("image", "", "0 to 255", observed_colors, [](const CameraImage& image, Row& row) {
      for (const std::uint8_t value : image.rgb) row.put(value);
    });
    observe("depth", "m", "one for each pixel", observed_depths, [](const CameraImage& image, Row& row) {
      for (const float depth : image.depth) row.put(depth);
    });
  }

  std::optional<CameraDescription> read(SensorElement& sensor) const override {
    const bool is_depth_only = sensor.type() == "depth_camera";
    const auto distance = [&](const std::string& plane) {
      const bool own = is_depth_only && sensor.has("camera/depth_camera/clip/" + plane);
      return sensor.number((own ? "camera/depth_camera/clip/" : "camera/clip/") + plane);
    };
    CameraDescription description;
    description.width = sensor.integer("camera/image/width");
    description.height = sensor.integer("camera/image/height");
    description.horizontal_fov = read_field_of_view(sensor);
    description.orthographic_width = sensor.number("camera/bubblesim:orthographic_width");
    description.near = distance("near");
    description.far = distance("far");
    // Plugins of depth cameras publish colour images, too.
    description.color = !is_depth_only || sensor.has("plugin");
    description.noise = sensor.noise("camera/noise");
    description.antialias = sensor.own_flag("camera/bubblesim:antialias");
    sensor.set_offset(sensor.pose("camera/pose"));
    return description;
  }

  void check(SensorCheck& check, const CameraDescription& camera) const override {
    check.require(camera.width >= 1 && camera.width <= kMaxPixels && camera.height >= 1 && camera.height <= kMaxPixels,
                  "the image size", std::to_string(camera.width) + " x " + std::to_string(camera.height),
                  "1 to " + std::to_string(kMaxPixels) + " pixels in width and height");
    check.require(camera.horizontal_fov > 0 && camera.horizontal_fov < 3.14, "the horizontal field of view",
                  text(camera.horizontal_fov) + " rad", "above 0 and below 3.14 (pinhole camera)");
    check.require(camera.orthographic_width >= 0 && camera.orthographic_width <= kMaxSize, "the orthographic width",
                  text(camera.orthographic_width) + " m", "0 or more");
    check.require(camera.far > 0 && camera.far <= kMaxSize, "the distance of the far plane", text(camera.far) + " m",
                  "above 0");
    check.require(camera.near > 0 && camera.near < camera.far, "the distance of the near plane",
                  text(camera.near) + " m", "above 0 and less than that of the far plane");
  }

  std::unique_ptr<Sensor> make(const CameraDescription& description, const SensorSite& site) const override {
    return std::make_unique<Camera>(description, site.environment, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<CameraKind>();

}  // namespace bubblesim
