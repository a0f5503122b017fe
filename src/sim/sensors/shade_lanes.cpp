// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/shade_lanes.hpp"

#include <cmath>
#include <cstring>

#include "scene/simd.hpp"

namespace bubblesim::lanes {
namespace {

/// A face of a shape may lie on a border between squares: half a millionth of a square, and the rounding of the ray's
/// length, keep its places from flickering.
constexpr double kCheckerTolerance = 5e-7;
constexpr double kRounding = 2.5e-7;  // of a length in single precision, and of the direction

double floor_mod(double value, double count) { return value - count * std::floor(value / count); }

}  // namespace

BUBBLESIM_SIMD void find_places(const RTCRayHit16& packet, Places& places, Normals& normals) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double distance = ray.tfar[i];
    places.x[i] = static_cast<double>(ray.org_x[i]) + static_cast<double>(ray.dir_x[i]) * distance;
    places.y[i] = static_cast<double>(ray.org_y[i]) + static_cast<double>(ray.dir_y[i]) * distance;
    places.z[i] = static_cast<double>(ray.org_z[i]) + static_cast<double>(ray.dir_z[i]) * distance;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float length = std::sqrt(hit.Ng_x[i] * hit.Ng_x[i] + hit.Ng_y[i] * hit.Ng_y[i] + hit.Ng_z[i] * hit.Ng_z[i]);
    const float scale = length > 0 ? 1 / length : 0;
    normals.x[i] = hit.Ng_x[i] * scale;
    normals.y[i] = hit.Ng_y[i] * scale;
    normals.z[i] = hit.Ng_z[i] * scale;
  }
}

BUBBLESIM_SIMD void turn_normals(const Turn& turn, const Mask& mask, Normals& normals) {
  float r[9];
  for (std::size_t i = 0; i < 9; ++i) r[i] = static_cast<float>(turn[i]);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = normals.x[i];
    const float y = normals.y[i];
    const float z = normals.z[i];
    normals.x[i] = mask.use[i] != 0 ? r[0] * x + r[1] * y + r[2] * z : x;
    normals.y[i] = mask.use[i] != 0 ? r[3] * x + r[4] * y + r[5] * z : y;
    normals.z[i] = mask.use[i] != 0 ? r[6] * x + r[7] * y + r[8] * z : z;
  }
}

BUBBLESIM_SIMD void set_normals(const Vector3& normal, const Mask& mask, Normals& normals) {
  const auto x = static_cast<float>(normal.x());
  const auto y = static_cast<float>(normal.y());
  const auto z = static_cast<float>(normal.z());
  for (std::size_t i = 0; i < kLanes; ++i) {
    normals.x[i] = mask.use[i] != 0 ? x : normals.x[i];
    normals.y[i] = mask.use[i] != 0 ? y : normals.y[i];
    normals.z[i] = mask.use[i] != 0 ? z : normals.z[i];
  }
}

BUBBLESIM_SIMD void smooth_normals(const CornerNormals& corners, const Turn& turn, const Mask& mask, Normals& normals) {
  float r[9];
  for (std::size_t i = 0; i < 9; ++i) r[i] = static_cast<float>(turn[i]);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const auto blend = [&](const float* a, const float* b, const float* c) {
      return a[i] * (1 - corners.second[i] - corners.third[i]) + b[i] * corners.second[i] + c[i] * corners.third[i];
    };
    const Normals* corner = corners.corner;
    const float x = blend(corner[0].x, corner[1].x, corner[2].x);
    const float y = blend(corner[0].y, corner[1].y, corner[2].y);
    const float z = blend(corner[0].z, corner[1].z, corner[2].z);
    const float length = std::sqrt(x * x + y * y + z * z);
    const float scale = length > 0 ? 1 / length : 0;
    const float turned_x = (r[0] * x + r[1] * y + r[2] * z) * scale;
    const float turned_y = (r[3] * x + r[4] * y + r[5] * z) * scale;
    const float turned_z = (r[6] * x + r[7] * y + r[8] * z) * scale;
    // Files may have normals that point inwards, or none.
    const bool outwards = turned_x * normals.x[i] + turned_y * normals.y[i] + turned_z * normals.z[i] > 0;
    const bool use = (mask.use[i] != 0) & outwards;
    normals.x[i] = use ? turned_x : normals.x[i];
    normals.y[i] = use ? turned_y : normals.y[i];
    normals.z[i] = use ? turned_z : normals.z[i];
  }
}

BUBBLESIM_SIMD void into_frame(const Turn& turn, const Vector3& position, Places& places) {
  const double p[3] = {position.x(), position.y(), position.z()};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = places.x[i] - p[0];
    const double y = places.y[i] - p[1];
    const double z = places.z[i] - p[2];
    places.x[i] = turn[0] * x + turn[3] * y + turn[6] * z;
    places.y[i] = turn[1] * x + turn[4] * y + turn[7] * z;
    places.z[i] = turn[2] * x + turn[5] * y + turn[8] * z;
  }
}

BUBBLESIM_SIMD void paint(const Color& color, const Mask& mask, Colors& colors) {
  const Color c = color;
  for (std::size_t i = 0; i < kLanes; ++i) {
    colors.r[i] = mask.use[i] != 0 ? c.r : colors.r[i];
    colors.g[i] = mask.use[i] != 0 ? c.g : colors.g[i];
    colors.b[i] = mask.use[i] != 0 ? c.b : colors.b[i];
  }
}

BUBBLESIM_SIMD void paint_checker(const Material& material, const Places& in_shape, const float* distances,
                                  const Mask& mask, Colors& colors) {
  const double size = material.checker_size;
  const Color even = material.diffuse;
  const Color odd = material.checker_color;
  alignas(64) float parity[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double tolerance = kCheckerTolerance + kRounding * static_cast<double>(distances[i]) / size;
    const double squares = std::floor(in_shape.x[i] / size + tolerance) + std::floor(in_shape.y[i] / size + tolerance) +
                           std::floor(in_shape.z[i] / size + tolerance);
    parity[i] = static_cast<float>(squares - 2 * std::floor(squares / 2));
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    colors.r[i] = mask.use[i] != 0 ? (parity[i] == 0 ? even.r : odd.r) : colors.r[i];
    colors.g[i] = mask.use[i] != 0 ? (parity[i] == 0 ? even.g : odd.g) : colors.g[i];
    colors.b[i] = mask.use[i] != 0 ? (parity[i] == 0 ? even.b : odd.b) : colors.b[i];
  }
}

BUBBLESIM_SIMD void paint_texture(const Texture& texture, const ImagePlaces& places, const Mask& mask, Colors& colors) {
  alignas(64) double left[kLanes], upper[kLanes], right_part[kLanes], lower_part[kLanes];
  const double width = texture.width;
  const double height = texture.height;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double right = places.right[i];
    const double down = 1.0 - static_cast<double>(places.up[i]);
    const double x = (right - std::floor(right)) * width - 0.5;
    const double y = (down - std::floor(down)) * height - 0.5;
    left[i] = floor_mod(std::floor(x), width);
    upper[i] = floor_mod(std::floor(y), height);
    right_part[i] = x - std::floor(x);
    lower_part[i] = y - std::floor(y);
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (mask.use[i] == 0) continue;
    colors.r[i] = colors.g[i] = colors.b[i] = 0;
    if (!(left[i] >= 0 && left[i] < width && upper[i] >= 0 && upper[i] < height)) continue;  // not finite
    for (int corner = 0; corner < 4; ++corner) {
      const int across = corner & 1;
      const int below = corner >> 1;
      const int column = static_cast<int>(left[i]) + across;
      const int row = static_cast<int>(upper[i]) + below;
      const double weight_x = across != 0 ? right_part[i] : 1 - right_part[i];
      const double weight_y = below != 0 ? lower_part[i] : 1 - lower_part[i];
      const auto weight = static_cast<float>(weight_x * weight_y / 255);
      const auto pixel =
          static_cast<std::size_t>(row < texture.height ? row : 0) * static_cast<std::size_t>(texture.width) +
          static_cast<std::size_t>(column < texture.width ? column : 0);
      const std::uint8_t* rgb = &texture.rgb[3 * pixel];
      colors.r[i] += weight * static_cast<float>(rgb[0]);
      colors.g[i] += weight * static_cast<float>(rgb[1]);
      colors.b[i] += weight * static_cast<float>(rgb[2]);
    }
  }
}

BUBBLESIM_SIMD void place_on_box(const Vector3& size, const Places& in_shape, ImagePlaces& places) {
  const double sizes[3] = {size.x(), size.y(), size.z()};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = in_shape.x[i] / sizes[0];  // from -0.5 to 0.5
    const double y = in_shape.y[i] / sizes[1];
    const double z = in_shape.z[i] / sizes[2];
    const bool on_y = std::abs(y) > std::abs(x);
    const double larger = on_y ? y : x;
    const bool on_z = std::abs(z) > std::abs(larger);
    const double face = on_z ? z : larger;
    const double along = on_y ? -x : y;
    const double level = on_z ? -y : along;
    places.right[i] = static_cast<float>((face > 0 ? level : -level) + 0.5);
    places.up[i] = static_cast<float>((on_z ? x : z) + 0.5);
  }
}

BUBBLESIM_SIMD void to_bytes(const Colors& colors, std::size_t count, std::uint8_t* rgb) {
  alignas(64) std::int32_t levels[3][kLanes];
  const float* const parts[3] = {colors.r, colors.g, colors.b};
  for (std::size_t part = 0; part < 3; ++part) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float value = parts[part][i] > 0 ? parts[part][i] : 0;
      const float limited = value < 1 ? value : 1;  // not yet double: g++ 14 would not vectorize the last part
      levels[part][i] = static_cast<std::int32_t>(255 * static_cast<double>(limited) + 0.5);
    }
  }
  alignas(64) std::int32_t pixels[kLanes];  // red in the lowest byte
  for (std::size_t i = 0; i < kLanes; ++i) pixels[i] = levels[0][i] | levels[1][i] << 8 | levels[2][i] << 16;
  // Four bytes at a time, of which the next pixel overwrites the last.
  for (std::size_t i = 0; i + 1 < count; ++i) std::memcpy(rgb + 3 * i, &pixels[i], 4);
  if (count > 0) std::memcpy(rgb + 3 * (count - 1), &pixels[count - 1], 3);
}

}  // namespace bubblesim::lanes
