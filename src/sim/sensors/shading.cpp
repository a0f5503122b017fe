// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sensors/surface_color.hpp"

namespace bubblesim {
namespace {

constexpr Color kZenith{0.35F, 0.55F, 0.85F};
constexpr Color kHorizon{0.85F, 0.9F, 0.95F};

Color mix(const Color& a, const Color& b, float part_of_b) {
  return {a.r + (b.r - a.r) * part_of_b, a.g + (b.g - a.g) * part_of_b, a.b + (b.b - a.b) * part_of_b};
}

Color product(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }

void accumulate(Color& sum, const Color& color, float weight) {
  sum.r += weight * color.r;
  sum.g += weight * color.g;
  sum.b += weight * color.b;
}

/// The points to shade.
struct Points {
  std::array<Vector3, rays::kPacket> place;
  std::array<Vector3, rays::kPacket> normal;
  std::array<Color, rays::kPacket> color;
};

/// Light at a point.
struct Arrival {
  Vector3 to_light;  // of unit length
  float distance = 0;
  double brightness = 0;
};
using Arrivals = std::array<Arrival, rays::kPacket>;

/// From 0 outside the outer cone to 1 inside the inner cone, as in OGRE's fixed pipeline.
double spot_brightness(const Light& light, const Vector3& axis, const Vector3& to_light) {
  const double cosine = -to_light.Dot(axis);
  const double outer = std::cos(light.outer_angle / 2);
  const double inner = std::cos(light.inner_angle / 2);
  if (cosine <= outer) return 0;
  return cosine >= inner ? 1 : std::pow((cosine - outer) / (inner - outer), light.falloff);
}

/// `axis` is the light's direction, of unit length.
Arrival arrive(const Light& light, const Vector3& axis, const Vector3& point) {
  if (light.kind == LightKind::kDirectional) return {-axis, std::numeric_limits<float>::infinity(), 1};
  const Vector3 way = light.position - point;
  const double distance = way.Length();
  if (distance > light.range || distance < 1e-9) return {};
  Arrival arrival{way / distance, static_cast<float>(distance), 1};
  if (light.kind == LightKind::kSpot) arrival.brightness = spot_brightness(light, axis, arrival.to_light);
  const double attenuation = light.constant_attenuation + light.linear_attenuation * distance +
                             light.quadratic_attenuation * distance * distance;
  if (attenuation > 0) arrival.brightness /= attenuation;
  return arrival;
}

}  // namespace

void Shading::place_lights(const World& world) {
  lights_ = environment_.lights;
  for (Light& light : world.link_lights()) lights_.push_back(std::move(light));
}

Color Shading::behind(const Vector3& direction) const {
  if (!environment_.sky) return environment_.background;
  const double height = direction.Z() / direction.Length();
  return mix(kHorizon, kZenith, static_cast<float>(std::sqrt(std::max(height, 0.0))));
}

void Shading::add(const RayScene& scene, const rays::RayPacket& packet, std::size_t count, float weight,
                  Color* colors) const {
  const RTCRay16& ray = packet.data.ray;
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 direction(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]);
    if (!packet.hit(i)) {
      accumulate(colors[i], behind(direction), weight);
      continue;
    }
    points.place[i] = Vector3(ray.org_x[i], ray.org_y[i], ray.org_z[i]) + direction * ray.tfar[i];
    points.normal[i] = scene.shading_normal(packet, i);
    const SurfaceColor surface = surface_color(scene, packet, i, points.place[i]);
    points.color[i] = surface.diffuse;
    accumulate(colors[i], product(surface.diffuse, environment_.ambient), weight);
    accumulate(colors[i], surface.emissive, weight);
  }
  for (const Light& light : lights_) {
    const Vector3 axis = light.direction.Normalized();
    Arrivals arrivals;
    RTCRay16 shadow;
    rays::RayMask lit;
    int any = 0;
    for (std::size_t i = 0; i < rays::kPacket; ++i) {
      lit.use[i] = 0;
      if (i >= count || !packet.hit(i)) continue;
      arrivals[i] = arrive(light, axis, points.place[i]);
      if (arrivals[i].brightness <= 0 || points.normal[i].Dot(arrivals[i].to_light) <= 0) continue;
      lit.use[i] = any = rays::kUsed;
      // Offset from the surface by more than the error of single precision; otherwise the surface shades itself.
      const double gap = 1e-4 + 1e-5 * ray.tfar[i];
      rays::aim(shadow, i, points.place[i] + points.normal[i] * gap, arrivals[i].to_light);
      shadow.tnear[i] = shadow.time[i] = 0;
      shadow.tfar[i] = arrivals[i].distance;
      shadow.mask[i] = ~0U;
      shadow.flags[i] = 0;
    }
    if (any == 0) continue;
    if (environment_.shadows && light.cast_shadows) scene.occlude(shadow, lit);
    for (std::size_t i = 0; i < count; ++i) {
      if (lit.use[i] == 0 || shadow.tfar[i] < 0) continue;
      const double cosine = points.normal[i].Dot(arrivals[i].to_light);
      accumulate(colors[i], product(points.color[i], light.diffuse),
                 static_cast<float>(cosine * arrivals[i].brightness) * weight);
    }
  }
}

}  // namespace bubblesim
