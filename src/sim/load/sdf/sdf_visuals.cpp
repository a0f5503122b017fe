// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_visuals.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>
#include <string>
#include <utility>
#include <vector>

#include "load/find/model_folders.hpp"
#include "load/materials/material_scripts.hpp"
#include "load/materials/named_materials.hpp"
#include "load/sdf_extensions.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {
namespace {

Color to_color(const ignition::math::Color& color) { return {color.R(), color.G(), color.B()}; }

Color brightened(const ignition::math::Color& color, double factor) {
  const auto part = [factor](float value) { return static_cast<float>(std::clamp(value * factor, 0.0, 1.0)); };
  return {part(color.R()), part(color.G()), part(color.B())};
}

/// The material of a material script: the model's own, or one of Gazebo's.
std::optional<Material> scripted(const sdf::Material& material, LoadContext& reading) {
  const sdf::ElementPtr element = material.Element();
  if (!element->HasElement("script")) return std::nullopt;
  const sdf::ElementPtr script = element->GetElement("script");
  std::vector<std::filesystem::path> places;
  if (script->HasElement("uri")) {
    for (auto uri = script->GetElement("uri"); uri != nullptr; uri = uri->GetNextElement("uri")) {
      std::filesystem::path place = find_resource(uri->Get<std::string>(), element->FilePath(), reading.folder());
      if (!place.empty()) places.push_back(std::move(place));
    }
  }
  if (auto own = script_material(material.ScriptName(), places)) return own;
  return named_material(material.ScriptName());
}

/// The albedo texture of <pbr>, as in models for gz-sim.
std::shared_ptr<const Texture> albedo(const sdf::Material& material, LoadContext& reading) {
  const sdf::Pbr* pbr = material.PbrMaterial();
  if (pbr == nullptr) return nullptr;
  for (const auto type : {sdf::PbrWorkflowType::METAL, sdf::PbrWorkflowType::SPECULAR}) {
    const sdf::PbrWorkflow* workflow = pbr->Workflow(type);
    if (workflow == nullptr || workflow->AlbedoMap().empty()) continue;
    const std::filesystem::path file =
        find_resource(workflow->AlbedoMap(), material.Element()->FilePath(), reading.folder());
    if (file.empty()) return nullptr;
    try {
      return read_texture(file);
    } catch (const MeshError&) {
      return nullptr;  // the other colours are used
    }
  }
  return nullptr;
}

}  // namespace

std::optional<Material> read_material(const sdf::Visual& visual, LoadContext& reading) {
  const sdf::Material* described = visual.Material();
  if (described == nullptr) return std::nullopt;
  const sdf::ElementPtr element = described->Element();
  std::optional<Material> given = scripted(*described, reading);
  Material material = given.value_or(Material{});
  const bool has_color = element->HasElement("diffuse");
  if (has_color) {
    material.diffuse = to_color(described->Diffuse());
    material.texture = nullptr;
  }
  const std::shared_ptr<const Texture> picture = albedo(*described, reading);
  if (picture != nullptr) {
    material.texture = picture;
    material.diffuse = mean_color(*picture);
  }
  if (element->HasElement("emissive")) material.emissive = to_color(described->Emissive());
  const auto checker_size = own_number(element, "bubblesim:checker_size", reading.problems());
  material.checker_size = checker_size.value_or(0);
  if (const auto color = own_vector(element, "bubblesim:checker_color", reading.problems())) {
    material.checker_color = {static_cast<float>(color->X()), static_cast<float>(color->Y()),
                              static_cast<float>(color->Z())};
  }
  return given || has_color || checker_size || picture != nullptr ? std::make_optional(std::move(material))
                                                                  : std::nullopt;
}

void read_surroundings(const sdf::Scene& scene, Environment& environment) {
  environment.ambient = to_color(scene.Ambient());
  environment.background = to_color(scene.Background());
  environment.sky = scene.Sky() != nullptr;
  environment.shadows = scene.Shadows();
}

void read_origin(const ignition::math::SphericalCoordinates& place, GeographicOrigin& origin) {
  origin.latitude = place.LatitudeReference().Degree();
  origin.longitude = place.LongitudeReference().Degree();
  origin.elevation = place.ElevationReference();
  origin.heading = place.HeadingOffset().Radian();
}

Light read_light(const sdf::Light& light, const Pose& pose) {
  Light read;
  read.direction = pose.Rot().RotateVector(light.Direction());
  read.diffuse = brightened(light.Diffuse(), light.Intensity());
  read.cast_shadows = light.CastShadows();
  if (light.Type() == sdf::LightType::DIRECTIONAL) return read;
  const bool is_spot = light.Type() == sdf::LightType::SPOT;
  read.kind = is_spot ? LightKind::kSpot : LightKind::kPoint;
  read.position = pose.Pos();
  read.range = light.AttenuationRange();
  read.constant_attenuation = light.ConstantAttenuationFactor();
  read.linear_attenuation = light.LinearAttenuationFactor();
  read.quadratic_attenuation = light.QuadraticAttenuationFactor();
  read.inner_angle = light.SpotInnerAngle().Radian();
  read.outer_angle = light.SpotOuterAngle().Radian();
  read.falloff = light.SpotFalloff();
  return read;
}

}  // namespace bubblesim
