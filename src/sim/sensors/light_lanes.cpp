// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/light_lanes.hpp"

#include <cmath>
#include <limits>

#include "scene/simd.hpp"

namespace bubblesim::lanes {
namespace {

constexpr Color kZenith{0.35F, 0.55F, 0.85F};
constexpr Color kHorizon{0.85F, 0.9F, 0.95F};

}  // namespace

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
  const double d[3] = {to_light.x(), to_light.y(), to_light.z()};
  for (std::size_t i = 0; i < kLanes; ++i) {
    arrivals.to_light.x[i] = d[0];
    arrivals.to_light.y[i] = d[1];
    arrivals.to_light.z[i] = d[2];
  }
  const float f[3] = {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])};
  int any = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float cosine = normals.x[i] * f[0] + normals.y[i] * f[1] + normals.z[i] * f[2];
    const bool use = (mask.use[i] != 0) & (cosine > 0);
    arrivals.distance[i] = std::numeric_limits<float>::infinity();
    arrivals.strength[i] = use ? cosine : 0;
    any |= use ? 1 : 0;
  }
  return any != 0;
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
  int any = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float cosine = normals.x[i] * static_cast<float>(arrivals.to_light.x[i]) +
                         normals.y[i] * static_cast<float>(arrivals.to_light.y[i]) +
                         normals.z[i] * static_cast<float>(arrivals.to_light.z[i]);
    const float strength = cosine * arrivals.strength[i];
    const bool use = (mask.use[i] != 0) & (cosine > 0) & (arrivals.strength[i] > 0);
    arrivals.strength[i] = use ? strength : 0;
    any |= use & (strength > 0) ? 1 : 0;
  }
  return any != 0;
}

}  // namespace

bool arrive_from(const Light& light, const Places& places, const Normals& normals, const Mask& mask,
                 Arrivals& arrivals) {
  const double position[3] = {light.position.x(), light.position.y(), light.position.z()};
  const double attenuation[3] = {light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation};
  approach(position, light.range, attenuation, places, arrivals);
  if (light.kind == LightKind::kSpot) {
    const Vector3 direction = light.direction.normalized();
    const double axis[3] = {direction.x(), direction.y(), direction.z()};
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

}  // namespace bubblesim::lanes
