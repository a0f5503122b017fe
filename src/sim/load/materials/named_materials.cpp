// SPDX-License-Identifier: BSD-3-Clause
#include "load/materials/named_materials.hpp"

#include <map>

namespace bubblesim {
namespace {

// By the part of the name after Gazebo/. For textures, their approximate mean colour.
const std::map<std::string, Color>& colors() {
  static const std::map<std::string, Color> known = {
      {"Grey", {0.7F, 0.7F, 0.7F}},
      {"Gray", {0.7F, 0.7F, 0.7F}},
      {"DarkGrey", {0.175F, 0.175F, 0.175F}},
      {"DarkGray", {0.175F, 0.175F, 0.175F}},
      {"White", {1, 1, 1}},
      {"FlatBlack", {0.1F, 0.1F, 0.1F}},
      {"Black", {0, 0, 0}},
      {"Red", {1, 0, 0}},
      {"RedBright", {0.87F, 0.26F, 0.07F}},
      {"Green", {0, 1, 0}},
      {"Blue", {0, 0, 1}},
      {"SkyBlue", {0.13F, 0.44F, 0.7F}},
      {"Yellow", {1, 1, 0}},
      {"ZincYellow", {0.97F, 0.95F, 0.21F}},
      {"DarkYellow", {0.7F, 0.7F, 0}},
      {"Purple", {1, 0, 1}},
      {"Turquoise", {0, 1, 1}},
      {"Orange", {1, 0.51F, 0.05F}},
      {"Indigo", {0.33F, 0, 0.5F}},
      {"Gold", {0.8F, 0.65F, 0.12F}},
      {"Wood", {0.6F, 0.44F, 0.27F}},
      {"WoodFloor", {0.6F, 0.45F, 0.3F}},
      {"WoodPallet", {0.6F, 0.47F, 0.32F}},
      {"Bricks", {0.55F, 0.3F, 0.23F}},
      {"Grass", {0.3F, 0.42F, 0.16F}},
      {"Road", {0.25F, 0.25F, 0.25F}},
      {"Residential", {0.35F, 0.35F, 0.35F}},
      {"CeilingTiled", {0.85F, 0.85F, 0.82F}},
  };
  return known;
}

}  // namespace

std::optional<Material> named_material(const std::string& name) {
  const std::string prefix = "Gazebo/";
  const std::string glow = "Glow";  // an emissive colour
  if (name.rfind(prefix, 0) != 0) return std::nullopt;
  std::string color = name.substr(prefix.size());
  const bool glows = color.size() > glow.size() && color.substr(color.size() - glow.size()) == glow;
  if (glows) color.resize(color.size() - glow.size());
  const auto found = colors().find(color);
  if (found == colors().end()) return std::nullopt;
  Material material;
  material.diffuse = found->second;
  if (glows) material.emissive = found->second;
  return material;
}

}  // namespace bubblesim
