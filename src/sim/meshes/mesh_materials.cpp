// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_materials.hpp"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/texture.h>

#include <algorithm>
#include <memory>
#include <string>

#include "meshes/mesh_error.hpp"
#include "meshes/picture.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

Color to_color(const aiColor4D& color) {
  const auto part = [](float value) { return std::clamp(value, 0.0F, 1.0F); };  // takes NaN to NaN
  const Color read{part(color.r), part(color.g), part(color.b)};
  return read.r + read.g + read.b >= 0 ? read : Color{};
}

/// `%20` is a space, as in each URI.
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

/// Where the file says, or where models keep textures.
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

std::shared_ptr<const Texture> embedded_texture(const aiTexture& texture) {
  if (texture.mHeight == 0) {  // a whole file of mWidth bytes
    return decode_texture(reinterpret_cast<const unsigned char*>(texture.pcData), texture.mWidth);
  }
  Texture pixels{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
  for (unsigned i = 0; i < texture.mWidth * texture.mHeight; ++i) {
    const aiTexel& texel = texture.pcData[i];
    pixels.rgb.insert(pixels.rgb.end(), {texel.r, texel.g, texel.b});
  }
  return std::make_shared<const Texture>(std::move(pixels));
}

std::shared_ptr<const Texture> texture_of(const aiScene& scene, const aiMaterial& material, const fs::path& file) {
  aiString uri;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &uri) != aiReturn_SUCCESS) return nullptr;
  try {
    if (const aiTexture* embedded = scene.GetEmbeddedTexture(uri.C_Str())) return embedded_texture(*embedded);
    const fs::path found = find_texture(uri.C_Str(), file);
    return found.empty() ? nullptr : read_texture(found);
  } catch (const MeshError&) {
    return nullptr;
  }
}

}  // namespace

std::vector<Material> mesh_materials(const aiScene& scene, const fs::path& file) {
  std::vector<Material> materials;
  bool any = false;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& read = *scene.mMaterials[i];
    Material material;
    aiColor4D color;
    aiString name;
    // Assimp's own, of files without any.
    const bool made_up =
        read.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name == aiString(AI_DEFAULT_MATERIAL_NAME);
    if (!made_up && read.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
      material.diffuse = to_color(color);
      any = true;
    }
    if (read.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS) material.emissive = to_color(color);
    material.texture = texture_of(scene, read, file);
    if (material.texture != nullptr) {
      material.diffuse = mean_color(*material.texture);
      any = true;
    }
    materials.push_back(std::move(material));
  }
  if (!any) materials.clear();
  return materials;
}

}  // namespace bubblesim
