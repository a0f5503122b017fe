// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_visuals.hpp"

#include <algorithm>
#include <sdf/Material.hh>

#include "named_materials.hpp"
#include "own_elements.hpp"

namespace bubblesim {
namespace {

Color to_color(const ignition::math::Color& color) { return {color.R(), color.G(), color.B()}; }

Color brightened(const ignition::math::Color& color, double factor) {
  const auto part = [factor](float value) { return static_cast<float>(std::clamp(value * factor, 0.0, 1.0)); };
  return {part(color.R()), part(color.G()), part(color.B())};
}

}  // namespace

Material read_material(const sdf::Visual& visual, std::vector<Problem>& problems) {
  Material material;
  const sdf::Material* described = visual.Material();
  if (described == nullptr) return material;
  if (const auto named = named_material(described->ScriptName())) material = *named;
  const sdf::ElementPtr element = described->Element();
  if (element->HasElement("diffuse")) material.diffuse = to_color(described->Diffuse());
  if (element->HasElement("emissive")) material.emissive = to_color(described->Emissive());
  material.checker_size = own_number(element, "bubblesim:checker_size", problems).value_or(0);
  if (const auto color = own_vector(element, "bubblesim:checker_color", problems)) {
    material.checker_color = {static_cast<float>(color->X()), static_cast<float>(color->Y()),
                              static_cast<float>(color->Z())};
  }
  return material;
}

void read_surroundings(const sdf::Scene& scene, Environment& environment) {
  environment.ambient = to_color(scene.Ambient());
  environment.background = to_color(scene.Background());
  environment.sky = scene.Sky() != nullptr;
  environment.shadows = scene.Shadows();
}

std::optional<DirectionalLight> read_light(const sdf::Light& light, const Pose& pose) {
  if (light.Type() != sdf::LightType::DIRECTIONAL) return std::nullopt;
  return DirectionalLight{pose.Rot().RotateVector(light.Direction()), brightened(light.Diffuse(), light.Intensity()),
                          light.CastShadows()};
}

}  // namespace bubblesim
