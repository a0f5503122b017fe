// SPDX-License-Identifier: BSD-3-Clause
// Cameras, of colours or depths: their elements, values and limits.
#include "sensors/camera.hpp"

#include <cmath>

#include "scene/describe.hpp"
#include "sensors/define.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
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
    return make_camera(description, site.environment, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<CameraKind>();

}  // namespace bubblesim
