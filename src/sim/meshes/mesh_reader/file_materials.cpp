// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_reader/file_materials.hpp"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/texture.h>

#include <algorithm>

namespace bubblesim {
namespace {

Color to_color(const aiColor4D& color) {
  const auto part = [](float value) { return std::clamp(value, 0.0F, 1.0F); };  // NaN stays NaN
  const Color read{part(color.r), part(color.g), part(color.b)};
  return read.r + read.g + read.b >= 0 ? read : Color{};
}

void take_texture(const aiTexture& texture, FileMaterial& material) {
  if (texture.mHeight == 0) {  // a whole file of mWidth bytes
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(texture.pcData);
    material.texture.assign(bytes, bytes + texture.mWidth);
    return;
  }
  material.numbers.texture_width = static_cast<std::int32_t>(texture.mWidth);
  material.numbers.texture_height = static_cast<std::int32_t>(texture.mHeight);
  for (std::size_t i = 0; i < std::size_t{texture.mWidth} * texture.mHeight; ++i) {
    const aiTexel& texel = texture.pcData[i];
    material.texture.insert(material.texture.end(), {texel.r, texel.g, texel.b});
  }
}

}  // namespace

std::vector<FileMaterial> file_materials(const aiScene& scene) {
  std::vector<FileMaterial> materials;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& read = *scene.mMaterials[i];
    FileMaterial& material = materials.emplace_back();
    aiColor4D color;
    aiString text;
    // Assimp's default material, for files without materials.
    const bool made_up =
        read.Get(AI_MATKEY_NAME, text) == aiReturn_SUCCESS && text == aiString(AI_DEFAULT_MATERIAL_NAME);
    if (!made_up && read.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
      material.numbers.has_diffuse = true;
      material.numbers.diffuse = to_color(color);
    }
    if (read.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS) material.numbers.emissive = to_color(color);
    if (read.GetTexture(aiTextureType_DIFFUSE, 0, &text) != aiReturn_SUCCESS) continue;
    if (const aiTexture* embedded = scene.GetEmbeddedTexture(text.C_Str())) {
      take_texture(*embedded, material);
    } else {
      material.texture_uri = text.C_Str();
    }
  }
  return materials;
}

}  // namespace bubblesim
