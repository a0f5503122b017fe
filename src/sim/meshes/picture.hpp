// SPDX-License-Identifier: BSD-3-Clause
// Reads image files, each in another process, which may crash: png, jpg, bmp, tga, gif, psd, pnm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "meshes/picture_content.hpp"

namespace bubblesim {

/// A grey image.
struct Heights {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> values;  ///< from 0 to 1, row by row from the top
};

/// Throws MeshError.
Heights read_heights(const std::filesystem::path& file);

/// Each image is read once and shared by its users. Throws MeshError.
std::shared_ptr<const Texture> read_texture(const std::filesystem::path& file);

/// Decodes the bytes of such a file. Throws MeshError.
std::shared_ptr<const Texture> decode_texture(std::vector<std::uint8_t> bytes);

/// What the other process has answered; it may have answered anything. Throw MeshError.
Heights to_heights(const PictureContent& content);
std::shared_ptr<const Texture> to_texture(PictureContent content);

/// Mean colour of all pixels, for shapes without texture coordinates.
Color mean_color(const Texture& texture);

}  // namespace bubblesim
