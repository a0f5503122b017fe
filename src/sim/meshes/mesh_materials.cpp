// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_materials.hpp"

#include <memory>
#include <string>
#include <utility>

#include "meshes/mesh_error.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

/// Decodes %20 and the like in a URI.
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const std::string digits = uri[i] == '%' ? uri.substr(i + 1, 2) : "";
    if (digits.size() == 2 && digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos) {
      text += static_cast<char>(std::stoi(digits, nullptr, 16));
      i += 2;
    } else {
      text += uri[i] == '\\' ? '/' : uri[i];
    }
  }
  return text;
}

/// Searches a texture at the given path, and where models have their textures.
fs::path find_texture(const std::string& uri, const fs::path& mesh_file) {
  const std::string scheme = "file://";
  const fs::path named = decoded(uri.rfind(scheme, 0) == 0 ? uri.substr(scheme.size()) : uri);
  const fs::path beside = mesh_file.parent_path();
  const fs::path model = beside.parent_path();
  for (const fs::path& candidate :
       {beside / named, beside / named.filename(), model / "materials" / "textures" / named.filename(),
        model / "textures" / named.filename(), model / "materials" / named.filename()}) {
    if (fs::is_regular_file(candidate)) return candidate;
  }
  return {};
}

std::shared_ptr<const Texture> embedded_texture(const FileMaterial& material) {
  const auto [width, height] = std::pair(material.numbers.texture_width, material.numbers.texture_height);
  if (width == 0) return decode_texture(material.texture);
  const bool whole = width > 0 && height > 0 && material.texture.size() == 3ULL * width * height;
  return whole ? std::make_shared<const Texture>(Texture{width, height, material.texture}) : nullptr;
}

std::shared_ptr<const Texture> texture_of(const FileMaterial& material, const fs::path& file) {
  try {
    if (!material.texture.empty()) return embedded_texture(material);
    if (material.texture_uri.empty()) return nullptr;
    const fs::path found = find_texture(material.texture_uri, file);
    return found.empty() ? nullptr : read_texture(found);
  } catch (const MeshError&) {
    return nullptr;
  }
}

}  // namespace

std::vector<Material> mesh_materials(const std::vector<FileMaterial>& materials, const fs::path& file) {
  std::vector<Material> found;
  bool any = false;
  for (const FileMaterial& read : materials) {
    Material material;
    if (read.numbers.has_diffuse) {
      material.diffuse = read.numbers.diffuse;
      any = true;
    }
    material.emissive = read.numbers.emissive;
    material.texture = texture_of(read, file);
    if (material.texture != nullptr) {
      material.diffuse = mean_color(*material.texture);
      any = true;
    }
    found.push_back(std::move(material));
  }
  if (!any) found.clear();
  return found;
}

}  // namespace bubblesim
