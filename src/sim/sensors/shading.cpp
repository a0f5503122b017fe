// SPDX-License-Identifier: BSD-3-Clause
#include "shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bubblesim {
namespace {

constexpr Color kZenith{0.35F, 0.55F, 0.85F};
constexpr Color kHorizon{0.85F, 0.9F, 0.95F};

Color mix(const Color& a, const Color& b, float part_of_b) {
  return {a.r + (b.r - a.r) * part_of_b, a.g + (b.g - a.g) * part_of_b, a.b + (b.b - a.b) * part_of_b};
}

void accumulate(Color& sum, const Color& color, float weight) {
  sum.r += weight * color.r;
  sum.g += weight * color.g;
  sum.b += weight * color.b;
}

Color checker(const Material& material, const Vector3& in_shape) {
  // Half a millionth of a field: a face that lies on a border between fields must not flicker between the two.
  const auto field = [&](double place) { return std::lround(std::floor(place / material.checker_size + 5e-7)); };
  const long parity = field(in_shape.X()) + field(in_shape.Y()) + field(in_shape.Z());
  return parity % 2 == 0 ? material.diffuse : material.checker_color;
}

/// The points seen, on their way to a light.
struct Points {
  std::array<Vector3, rays::kPacket> place;
  std::array<Vector3, rays::kPacket> normal;
  std::array<Color, rays::kPacket> color;
};

}  // namespace

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
    const Material& material = scene.shape(packet, i).material;
    points.place[i] = Vector3(ray.org_x[i], ray.org_y[i], ray.org_z[i]) + direction * ray.tfar[i];
    points.normal[i] = scene.normal(packet, i);
    points.color[i] =
        material.checker_size > 0 ? checker(material, scene.in_shape(packet, i, points.place[i])) : material.diffuse;
    const Color& color = points.color[i];
    const Color& ambient = environment_.ambient;
    accumulate(colors[i], {color.r * ambient.r, color.g * ambient.g, color.b * ambient.b}, weight);
    accumulate(colors[i], material.emissive, weight);
  }
  for (const DirectionalLight& light : environment_.lights) {
    const Vector3 to_light = -light.direction.Normalized();
    RTCRay16 shadow;
    rays::RayMask lit;
    int any = 0;
    for (std::size_t i = 0; i < rays::kPacket; ++i) {
      const bool faces_light = i < count && packet.hit(i) && points.normal[i].Dot(to_light) > 0;
      lit.use[i] = faces_light ? rays::kUsed : 0;
      any |= lit.use[i];
      if (!faces_light) continue;
      // Off the surface by more than single precision can be wrong, or it would shade itself.
      const double gap = 1e-4 + 1e-5 * ray.tfar[i];
      const Vector3 start = points.place[i] + points.normal[i] * gap;
      rays::aim(shadow, i, start, to_light);
      shadow.tnear[i] = shadow.time[i] = 0;
      shadow.tfar[i] = std::numeric_limits<float>::infinity();
      shadow.mask[i] = ~0U;
      shadow.flags[i] = 0;
    }
    if (any == 0) continue;
    if (environment_.shadows && light.cast_shadows) scene.occlude(shadow, lit);
    for (std::size_t i = 0; i < count; ++i) {
      if (lit.use[i] == 0 || shadow.tfar[i] < 0) continue;
      const auto cosine = static_cast<float>(points.normal[i].Dot(to_light)) * weight;
      const Color& color = points.color[i];
      accumulate(colors[i], {color.r * light.diffuse.r, color.g * light.diffuse.g, color.b * light.diffuse.b}, cosine);
    }
  }
}

}  // namespace bubblesim
