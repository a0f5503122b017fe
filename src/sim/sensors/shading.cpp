// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/shading.hpp"

#include "sensors/light_lanes.hpp"
#include "sensors/surface_color.hpp"

namespace bubblesim {

namespace {

Color scaled_light(const Color& color, float scale) { return {scale * color.r, scale * color.g, scale * color.b}; }

}  // namespace

void Shading::place_lights(const World& world, double brightness) {
  const auto scale = static_cast<float>(brightness);
  lights_ = environment_.lights;
  for (Light& light : world.geometry().link_lights()) lights_.push_back(std::move(light));
  for (Light& light : lights_) light.diffuse = scaled_light(light.diffuse, scale);
  ambient_ = scaled_light(environment_.ambient, scale);
  has_casters_ = false;
}

void Shading::place_casters(const RayScene& scene, const Vector3& eye, std::size_t pixels) {
  if (!environment_.shadows) return;
  has_casters_ = true;
  casters_.resize(lights_.size());
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (lights_[i].kind != LightKind::kDirectional || !lights_[i].cast_shadows) continue;
    casters_[i].start(-lights_[i].direction.normalized(), eye, pixels);
    scene.collect(casters_[i]);
  }
}

void Shading::add(const RayScene& scene, const rays::RayPacket& packet, const rays::HitGroups& groups, float weight,
                  lanes::Colors& sum) const {
  const RTCRay16& ray = packet.data.ray;
  if (!groups.all_hit()) {
    if (environment_.sky) {
      lanes::add_sky(ray, groups.hits(), weight, sum);
    } else {
      lanes::add_beside(environment_.background, groups.hits(), weight, sum);
    }
  }
  if (groups.begin() == groups.end()) return;
  Surfaces surfaces;
  find_surfaces(scene, packet, groups, surfaces);
  lanes::add_ambient(surfaces.diffuse, ambient_, surfaces.emissive, groups.hits(), weight, sum);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const Light& light = lights_[i];
    lanes::Arrivals arrivals;
    const bool any = light.kind == LightKind::kDirectional
                         ? lanes::arrive_along(-light.direction.normalized(), surfaces.normals, groups.hits(), arrivals)
                         : lanes::arrive_from(light, surfaces.places, surfaces.normals, groups.hits(), arrivals);
    if (!any) continue;
    if (environment_.shadows && light.cast_shadows) cast_shadows(scene, packet, surfaces, i, arrivals);
    lanes::add_light(surfaces.diffuse, light.diffuse, arrivals, weight, sum);
  }
}

void Shading::cast_shadows(const RayScene& scene, const rays::RayPacket& packet, const Surfaces& surfaces,
                           std::size_t light, lanes::Arrivals& arrivals) const {
  RTCRay16 shadows;
  rays::RayMask lit;
  lanes::aim_at_light(packet.data.ray, surfaces.places, surfaces.normals, arrivals, shadows, lit);
  const bool is_known =
      has_casters_ && lights_[light].kind == LightKind::kDirectional && casters_[light].shade(shadows, lit);
  if (!is_known) scene.occlude(shadows, lit);
  lanes::remove_shadows(shadows, arrivals);
}

}  // namespace bubblesim
