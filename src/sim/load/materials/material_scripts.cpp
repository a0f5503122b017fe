// SPDX-License-Identifier: BSD-3-Clause
#include "load/materials/material_scripts.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "meshes/mesh_error.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

struct ScriptedMaterial {
  std::string parent;
  std::optional<Color> diffuse;
  std::optional<Color> emissive;
  std::string texture;
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line.substr(0, line.find("//")));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

/// Three numbers from 0 to 1 after the first word.
std::optional<Color> to_color(const std::vector<std::string>& words) {
  if (words.size() < 4) return std::nullopt;
  float parts[3];
  for (std::size_t i = 0; i < 3; ++i) {
    std::istringstream number(words[i + 1]);
    if (!(number >> parts[i])) return std::nullopt;
    parts[i] = std::clamp(parts[i], 0.0F, 1.0F);
  }
  return Color{parts[0], parts[1], parts[2]};
}

/// The content of the braces after `material NAME`, which may be followed by `: PARENT`.
std::optional<ScriptedMaterial> find_in_script(const fs::path& file, const std::string& name) {
  std::ifstream script(file);
  ScriptedMaterial material;
  bool inside = false;
  int depth = 0;
  for (std::string line; std::getline(script, line);) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (!inside && words[0] == "material" && words.size() > 1 && words[1] == name) {
      inside = true;
      if (words.size() > 3 && words[2] == ":") material.parent = words[3];
    }
    if (!inside) continue;
    if (words[0] == "diffuse" && !material.diffuse) material.diffuse = to_color(words);
    if (words[0] == "emissive" && !material.emissive) material.emissive = to_color(words);
    if (words[0] == "texture" && words.size() > 1 && material.texture.empty()) material.texture = words[1];
    const auto opened = static_cast<int>(std::count(words.begin(), words.end(), "{"));
    const auto closed = static_cast<int>(std::count(words.begin(), words.end(), "}"));
    depth += opened - closed;
    if (closed > 0 && depth <= 0) return material;
  }
  return std::nullopt;
}

std::vector<fs::path> scripts_in(const fs::path& place) {
  if (fs::is_regular_file(place)) return {place};
  std::vector<fs::path> scripts;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(place, unreadable)) {
    if (entry.path().extension() == ".material" && entry.is_regular_file(unreadable)) scripts.push_back(entry.path());
  }
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

std::shared_ptr<const Texture> find_texture(const std::string& name, const std::vector<fs::path>& places) {
  for (const fs::path& place : places) {
    const fs::path folder = fs::is_directory(place) ? place : place.parent_path();
    for (const fs::path& file : {folder / name, folder.parent_path() / "textures" / name}) {
      if (!fs::is_regular_file(file)) continue;
      try {
        return read_texture(file);
      } catch (const MeshError&) {
        return nullptr;  // the colour is used
      }
    }
  }
  return nullptr;
}

std::optional<Material> read_script(const std::string& name, const std::vector<fs::path>& places, int generations) {
  for (const fs::path& place : places) {
    for (const fs::path& script : scripts_in(place)) {
      const std::optional<ScriptedMaterial> found = find_in_script(script, name);
      if (!found) continue;
      Material material;
      if (!found->parent.empty() && generations > 0) {
        material = read_script(found->parent, places, generations - 1).value_or(Material{});
      }
      if (found->diffuse) material.diffuse = *found->diffuse;
      if (found->emissive) material.emissive = *found->emissive;
      if (!found->texture.empty()) material.texture = find_texture(found->texture, places);
      if (material.texture != nullptr) material.diffuse = mean_color(*material.texture);
      return material;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Material> script_material(const std::string& name, const std::vector<fs::path>& places) {
  constexpr int kMaxGenerations = 8;  // a material may have itself as its parent
  return read_script(name, places, kMaxGenerations);
}

}  // namespace bubblesim
