// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/picture.hpp"

#include <stb_image.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <string>

#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

[[noreturn]] void fail() {
  throw MeshError(std::string("cannot be read as an image (") + stbi_failure_reason() +
                  "); supported formats: png, jpg, bmp, tga, gif");
}

// An image file of a few bytes may declare any size.
constexpr std::int64_t kMostPixels = 8192LL * 8192;

void check_pixels(bool known, int width, int height) {
  if (!known || std::int64_t{width} * height <= kMostPixels) return;  // unknown formats fail later, when they are read
  throw MeshError("has " + std::to_string(width) + " x " + std::to_string(height) + " pixels; the maximum is " +
                  std::to_string(kMostPixels));
}

void check_pixels(const std::filesystem::path& file) {
  int width = 0;
  int height = 0;
  int channels = 0;
  check_pixels(stbi_info(file.c_str(), &width, &height, &channels) != 0, width, height);
}

/// Takes ownership of the pixels.
std::shared_ptr<const Texture> to_texture(stbi_uc* pixels, int width, int height) {
  if (pixels == nullptr) fail();
  const std::unique_ptr<stbi_uc, Free> owner(pixels);
  const std::size_t bytes = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return std::make_shared<const Texture>(Texture{width, height, {pixels, pixels + bytes}});
}

}  // namespace

Heights read_heights(const std::filesystem::path& file) {
  check_pixels(file);
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_us, Free> pixels(stbi_load_16(file.c_str(), &width, &height, &channels, 1));
  if (pixels == nullptr) fail();
  Heights heights{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
  heights.values.reserve(heights.width * heights.height);
  for (std::size_t i = 0; i < heights.width * heights.height; ++i) {
    heights.values.push_back(static_cast<float>(pixels.get()[i]) / std::numeric_limits<stbi_us>::max());
  }
  return heights;
}

std::shared_ptr<const Texture> read_texture(const std::filesystem::path& file) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Texture>> known;
  const std::scoped_lock lock(mutex);
  std::weak_ptr<const Texture>& shared = known[file.string()];
  if (std::shared_ptr<const Texture> texture = shared.lock()) return texture;
  check_pixels(file);
  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* const pixels = stbi_load(file.c_str(), &width, &height, &channels, 3);
  std::shared_ptr<const Texture> texture = to_texture(pixels, width, height);
  shared = texture;
  return texture;
}

std::shared_ptr<const Texture> decode_texture(const unsigned char* bytes, std::size_t size) {
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw MeshError("is too large for an image");
  int width = 0;
  int height = 0;
  int channels = 0;
  const bool known = stbi_info_from_memory(bytes, static_cast<int>(size), &width, &height, &channels) != 0;
  check_pixels(known, width, height);
  stbi_uc* const pixels = stbi_load_from_memory(bytes, static_cast<int>(size), &width, &height, &channels, 3);
  return to_texture(pixels, width, height);
}

Color mean_color(const Texture& texture) {
  std::array<std::uint64_t, 3> sum{};
  for (std::size_t i = 0; i < texture.rgb.size(); ++i) sum[i % 3] += texture.rgb[i];
  const double full = 255.0 * static_cast<double>(texture.rgb.size()) / 3;
  const auto mean = [&](std::size_t i) { return static_cast<float>(static_cast<double>(sum[i]) / full); };
  return {mean(0), mean(1), mean(2)};
}

}  // namespace bubblesim
