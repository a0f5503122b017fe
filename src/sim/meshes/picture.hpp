// SPDX-License-Identifier: BSD-3-Clause
// Pictures from files: png, jpg, bmp, tga, gif, psd, pnm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {

/// A picture in shades of grey.
struct Heights {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> values;  ///< from 0 to 1, row by row, the uppermost first
};

/// Throws MeshError.
Heights read_heights(const std::filesystem::path& file);

/// A picture is read once and shared as long as anybody uses it. Throws MeshError.
std::shared_ptr<const Texture> read_texture(const std::filesystem::path& file);

/// From the bytes of such a file. Throws MeshError.
std::shared_ptr<const Texture> decode_texture(const unsigned char* bytes, std::size_t size);

/// The mean of all pixels: what shapes without texture coordinates show.
Color mean_color(const Texture& texture);

}  // namespace bubblesim
