// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_visuals.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "load/find/model_folders.hpp"
#include "load/materials/material_scripts.hpp"
#include "load/materials/named_materials.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {
namespace {

/// Old files have the name as text, and Gazebo's own materials without their file.
std::string name_of_script(const SdfElement& script, const std::string& path, LoadContext& context) {
  const std::string name = script.text("name");
  const std::string& text = script.as_text();
  if (name.empty() && text.empty()) {
    context.warn(script.source(), path, "<script> has no <name>: no material");
  } else if (name.empty()) {
    context.warn(script.source(), path,
                 "<script> has text and no <name>: '" + text + "' is used as the material's name");
  } else if (script.text("uri").empty()) {
    context.warn(script.source(), path, "<script> has no <uri>: '" + name + "' is searched in Gazebo's materials");
  }
  return name.empty() ? text : name;
}

/// The material of a material script: the model's own, or one of Gazebo's.
std::optional<Material> scripted(const SdfElement& material, const std::string& path, LoadContext& context) {
  const SdfElement script = material.child("script");
  if (!script) return std::nullopt;
  const std::string name = name_of_script(script, path, context);
  std::vector<std::filesystem::path> places;
  for (const SdfElement& uri : script.children("uri")) {
    std::filesystem::path place = find_resource(uri.as_text(), script.source().file, context.folder());
    if (!place.empty()) places.push_back(std::move(place));
  }
  if (auto own = script_material(name, places)) return own;
  return named_material(name);
}

/// The albedo texture of <pbr>, as in models for gz-sim.
std::shared_ptr<const Texture> albedo(const SdfElement& material, const LoadContext& context) {
  const SdfElement pbr = material.child("pbr");
  for (const char* workflow : {"metal", "specular"}) {
    const std::string uri = pbr.child(workflow).text("albedo_map");
    if (uri.empty()) continue;
    const std::filesystem::path file = find_resource(uri, material.source().file, context.folder());
    if (file.empty()) return nullptr;
    try {
      return read_texture(file);
    } catch (const MeshError&) {
      return nullptr;  // the other colours are used
    }
  }
  return nullptr;
}

Color brightened(const Color& color, double factor) {
  const auto part = [factor](float value) { return static_cast<float>(std::clamp(value * factor, 0.0, 1.0)); };
  return {part(color.r), part(color.g), part(color.b)};
}

/// Reads numbers of one light. Like Gazebo: negative ones are 0.
class LightNumbers {
 public:
  LightNumbers(std::string path, LoadContext& context) : path_(std::move(path)), context_(context) {}

  double read(const SdfElement& element, const char* name,
              double most = std::numeric_limits<double>::infinity()) const {
    const SdfElement number = element.child(name);
    const double value = number.as_number();
    if (value >= 0) return std::min(value, most);
    context_.warn(number.source(), path_, "<" + std::string(name) + "> is " + number.as_text() + ": using 0");
    return 0;
  }

 private:
  std::string path_;
  LoadContext& context_;
};

LightKind read_light_kind(const SdfElement& light, const std::string& path, LoadContext& context) {
  const std::string type = light.attribute("type");
  if (type == "directional") return LightKind::kDirectional;
  if (type == "spot") return LightKind::kSpot;
  if (type != "point") {
    context.warn(light.source(), path, "the light's type is '" + type + "': using point");
  }
  return LightKind::kPoint;
}

}  // namespace

std::optional<Material> read_material(const SdfElement& visual, const std::string& path, LoadContext& context) {
  const SdfElement element = visual.child("material");
  if (!element) return std::nullopt;
  std::optional<Material> given = scripted(element, path, context);
  Material material = given.value_or(Material{});
  const bool has_color = element.has("diffuse");
  if (has_color) {
    material.diffuse = element.color("diffuse");
    material.texture = nullptr;
  }
  const std::shared_ptr<const Texture> picture = albedo(element, context);
  if (picture != nullptr) {
    material.texture = picture;
    material.diffuse = mean_color(*picture);
  }
  if (element.has("emissive")) material.emissive = element.color("emissive");
  const auto checker_size = own_number(element, "bubblesim:checker_size", path, context);
  material.checker_size = checker_size.value_or(0);
  if (const auto color = own_vector(element, "bubblesim:checker_color", path, context)) {
    material.checker_color = {static_cast<float>(color->x()), static_cast<float>(color->y()),
                              static_cast<float>(color->z())};
  }
  return given || has_color || checker_size || picture != nullptr ? std::make_optional(std::move(material))
                                                                  : std::nullopt;
}

void read_surroundings(const SdfElement& scene, Environment& environment) {
  environment.ambient = scene.color("ambient");
  environment.background = scene.color("background");
  environment.sky = scene.has("sky");
  environment.shadows = scene.flag("shadows");
}

void read_origin(const SdfElement& spherical_coordinates, GeographicOrigin& origin, LoadContext& context) {
  const std::string model = spherical_coordinates.text("surface_model");
  if (model != "EARTH_WGS84") {
    context.warn(spherical_coordinates.source("surface_model"), "",
                 "<surface_model> is '" + model + "': using EARTH_WGS84");
  }
  const std::string axes = spherical_coordinates.text("world_frame_orientation");
  if (axes != "ENU") {
    context.report(spherical_coordinates.source("world_frame_orientation"), "",
                   "<world_frame_orientation> is '" + axes + "', it must be ENU");
  }
  origin.latitude = spherical_coordinates.number("latitude_deg");
  origin.longitude = spherical_coordinates.number("longitude_deg");
  origin.elevation = spherical_coordinates.number("elevation");
  origin.heading = spherical_coordinates.number("heading_deg") * M_PI / 180;
}

Light read_light(const SdfElement& light, const Pose& pose, const std::string& path, LoadContext& context) {
  const LightNumbers numbers(path, context);
  Light read;
  read.kind = read_light_kind(light, path, context);
  read.direction = pose.orientation * light.vector("direction");
  read.diffuse = brightened(light.color("diffuse"), numbers.read(light, "intensity"));
  read.cast_shadows = light.flag("cast_shadows");
  if (!light.flag("light_on")) {
    read.diffuse = {};
    read.cast_shadows = false;
  }
  if (read.kind == LightKind::kDirectional) return read;
  constexpr double kMostFactor = 1;  // Gazebo's
  const SdfElement attenuation = light.child("attenuation");
  const SdfElement spot = light.child("spot");
  read.position = pose.position;
  read.range = numbers.read(attenuation, "range");
  read.constant_attenuation = numbers.read(attenuation, "constant", kMostFactor);
  read.linear_attenuation = numbers.read(attenuation, "linear", kMostFactor);
  read.quadratic_attenuation = numbers.read(attenuation, "quadratic");
  read.inner_angle = numbers.read(spot, "inner_angle");
  read.outer_angle = numbers.read(spot, "outer_angle");
  read.falloff = numbers.read(spot, "falloff");
  return read;
}

}  // namespace bubblesim
