// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/shade_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "rays/simd.hpp"

namespace bubblesim::lanes {
namespace {

constexpr Color kZenith{0.35F, 0.55F, 0.85F};
constexpr Color kHorizon{0.85F, 0.9F, 0.95F};

/// Some places on a checkerboard lie on a border between squares: half a millionth of a square keeps them from
/// flickering.
constexpr double kCheckerTolerance = 5e-7;

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
  const auto x = static_cast<float>(normal.X());
  const auto y = static_cast<float>(normal.Y());
  const auto z = static_cast<float>(normal.Z());
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
  const double p[3] = {position.X(), position.Y(), position.Z()};
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

BUBBLESIM_SIMD void paint_checker(const Material& material, const Places& in_shape, const Mask& mask, Colors& colors) {
  const double size = material.checker_size;
  const Color even = material.diffuse;
  const Color odd = material.checker_color;
  alignas(64) float parity[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double squares = std::floor(in_shape.x[i] / size + kCheckerTolerance) +
                           std::floor(in_shape.y[i] / size + kCheckerTolerance) +
                           std::floor(in_shape.z[i] / size + kCheckerTolerance);
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
  const double sizes[3] = {size.X(), size.Y(), size.Z()};
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

BUBBLESIM_SIMD void add_sky(const RTCRay16& rays, const Mask& mask, float weight, Colors& sum) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float square = rays.dir_x[i] * rays.dir_x[i] + rays.dir_y[i] * rays.dir_y[i] + rays.dir_z[i] * rays.dir_z[i];
    const float height = rays.dir_z[i] / std::sqrt(square);
    const float up = std::sqrt(height > 0 ? height : 0);
    const float part = mask.use[i] == 0 ? weight : 0;
    sum.r[i] += part * (kHorizon.r + (kZenith.r - kHorizon.r) * up);
    sum.g[i] += part * (kHorizon.g + (kZenith.g - kHorizon.g) * up);
    sum.b[i] += part * (kHorizon.b + (kZenith.b - kHorizon.b) * up);
  }
}

BUBBLESIM_SIMD void add_beside(const Color& color, const Mask& mask, float weight, Colors& sum) {
  const Color c = color;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float part = mask.use[i] == 0 ? weight : 0;
    sum.r[i] += part * c.r;
    sum.g[i] += part * c.g;
    sum.b[i] += part * c.b;
  }
}

BUBBLESIM_SIMD void add_ambient(const Colors& surface, const Color& light, const Colors& glow, const Mask& mask,
                                float weight, Colors& sum) {
  const Color l = light;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const bool use = mask.use[i] != 0;
    sum.r[i] += use ? weight * (surface.r[i] * l.r + glow.r[i]) : 0;
    sum.g[i] += use ? weight * (surface.g[i] * l.g + glow.g[i]) : 0;
    sum.b[i] += use ? weight * (surface.b[i] * l.b + glow.b[i]) : 0;
  }
}

BUBBLESIM_SIMD bool arrive_along(const Vector3& to_light, const Normals& normals, const Mask& mask,
                                 Arrivals& arrivals) {
  const double d[3] = {to_light.X(), to_light.Y(), to_light.Z()};
  for (std::size_t i = 0; i < kLanes; ++i) {
    arrivals.to_light.x[i] = d[0];
    arrivals.to_light.y[i] = d[1];
    arrivals.to_light.z[i] = d[2];
  }
  const float f[3] = {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])};
  float most = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float cosine = normals.x[i] * f[0] + normals.y[i] * f[1] + normals.z[i] * f[2];
    const bool use = (mask.use[i] != 0) & (cosine > 0);
    arrivals.distance[i] = std::numeric_limits<float>::infinity();
    arrivals.strength[i] = use ? cosine : 0;
    most = arrivals.strength[i] > most ? arrivals.strength[i] : most;
  }
  return most > 0;
}

namespace {

/// The part of a spotlight's light that goes in each direction: from 0 outside the outer cone to 1 inside the inner
/// cone, as in OGRE's fixed pipeline.
BUBBLESIM_SIMD void add_cone(const double* axis, double inner, double outer, double falloff, const Places& to_light,
                             float* strength) {
  alignas(64) double part[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double cosine = -(to_light.x[i] * axis[0] + to_light.y[i] * axis[1] + to_light.z[i] * axis[2]);
    const double between = (cosine - outer) / (inner - outer);
    const double inside = cosine >= inner ? 1 : between;
    part[i] = cosine <= outer ? 0 : inside;
  }
  if (falloff != 1) {
    for (double& value : part) {
      if (value > 0 && value < 1) value = std::pow(value, falloff);
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) strength[i] *= static_cast<float>(part[i]);
}

BUBBLESIM_SIMD void approach(const double* position, double range, const double* attenuation, const Places& places,
                             Arrivals& arrivals) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = position[0] - places.x[i];
    const double y = position[1] - places.y[i];
    const double z = position[2] - places.z[i];
    const double distance = std::sqrt(x * x + y * y + z * z);
    arrivals.to_light.x[i] = x / distance;
    arrivals.to_light.y[i] = y / distance;
    arrivals.to_light.z[i] = z / distance;
    arrivals.distance[i] = static_cast<float>(distance);
    const double fading = attenuation[0] + attenuation[1] * distance + attenuation[2] * distance * distance;
    const double strength = 1 / (fading > 0 ? fading : 1);
    const bool reached = (distance <= range) & (distance >= 1e-9);
    arrivals.strength[i] = static_cast<float>(reached ? strength : 0);
  }
}

BUBBLESIM_SIMD bool incline(const Normals& normals, const Mask& mask, Arrivals& arrivals) {
  float most = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float cosine = normals.x[i] * static_cast<float>(arrivals.to_light.x[i]) +
                         normals.y[i] * static_cast<float>(arrivals.to_light.y[i]) +
                         normals.z[i] * static_cast<float>(arrivals.to_light.z[i]);
    const float strength = cosine * arrivals.strength[i];
    const bool use = (mask.use[i] != 0) & (cosine > 0) & (arrivals.strength[i] > 0);
    arrivals.strength[i] = use ? strength : 0;
    most = arrivals.strength[i] > most ? arrivals.strength[i] : most;
  }
  return most > 0;
}

}  // namespace

bool arrive_from(const Light& light, const Places& places, const Normals& normals, const Mask& mask,
                 Arrivals& arrivals) {
  const double position[3] = {light.position.X(), light.position.Y(), light.position.Z()};
  const double attenuation[3] = {light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation};
  approach(position, light.range, attenuation, places, arrivals);
  if (light.kind == LightKind::kSpot) {
    const Vector3 direction = light.direction.Normalized();
    const double axis[3] = {direction.X(), direction.Y(), direction.Z()};
    add_cone(axis, std::cos(light.inner_angle / 2), std::cos(light.outer_angle / 2), light.falloff, arrivals.to_light,
             arrivals.strength);
  }
  return incline(normals, mask, arrivals);
}

BUBBLESIM_SIMD void aim_at_light(const RTCRay16& rays, const Places& places, const Normals& normals,
                                 const Arrivals& arrivals, RTCRay16& shadows, Mask& lit) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    // Offset from the surface by more than the error of single precision; otherwise the surface shades itself.
    const double gap = 1e-4 + 1e-5 * static_cast<double>(rays.tfar[i]);
    shadows.org_x[i] = static_cast<float>(places.x[i] + static_cast<double>(normals.x[i]) * gap);
    shadows.org_y[i] = static_cast<float>(places.y[i] + static_cast<double>(normals.y[i]) * gap);
    shadows.org_z[i] = static_cast<float>(places.z[i] + static_cast<double>(normals.z[i]) * gap);
    shadows.dir_x[i] = static_cast<float>(arrivals.to_light.x[i]);
    shadows.dir_y[i] = static_cast<float>(arrivals.to_light.y[i]);
    shadows.dir_z[i] = static_cast<float>(arrivals.to_light.z[i]);
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    shadows.tnear[i] = shadows.time[i] = 0;
    shadows.tfar[i] = arrivals.distance[i];
    shadows.mask[i] = ~0U;
    shadows.flags[i] = 0;
    lit.use[i] = arrivals.strength[i] > 0 ? rays::kUsed : 0;
  }
}

BUBBLESIM_SIMD void remove_shadows(const RTCRay16& shadows, Arrivals& arrivals) {
  for (std::size_t i = 0; i < kLanes; ++i) arrivals.strength[i] = shadows.tfar[i] < 0 ? 0 : arrivals.strength[i];
}

BUBBLESIM_SIMD void add_light(const Colors& surface, const Color& light, const Arrivals& arrivals, float weight,
                              Colors& sum) {
  const Color l = light;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float strength = arrivals.strength[i] * weight;
    const bool use = strength > 0;
    sum.r[i] += use ? surface.r[i] * l.r * strength : 0;
    sum.g[i] += use ? surface.g[i] * l.g * strength : 0;
    sum.b[i] += use ? surface.b[i] * l.b * strength : 0;
  }
}

BUBBLESIM_SIMD void to_bytes(const Colors& colors, std::size_t count, std::uint8_t* rgb) {
  alignas(64) std::int32_t levels[3][kLanes];
  const float* const parts[3] = {colors.r, colors.g, colors.b};
  for (std::size_t part = 0; part < 3; ++part) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float value = parts[part][i] > 0 ? parts[part][i] : 0;
      const double limited = value < 1 ? value : 1;
      levels[part][i] = static_cast<std::int32_t>(255 * limited + 0.5);
    }
  }
  alignas(64) std::int32_t pixels[kLanes];  // red in the lowest byte
  for (std::size_t i = 0; i < kLanes; ++i) pixels[i] = levels[0][i] | levels[1][i] << 8 | levels[2][i] << 16;
  // Four bytes at a time, of which the next pixel overwrites the last.
  for (std::size_t i = 0; i + 1 < count; ++i) std::memcpy(rgb + 3 * i, &pixels[i], 4);
  if (count > 0) std::memcpy(rgb + 3 * (count - 1), &pixels[count - 1], 3);
}

}  // namespace bubblesim::lanes
