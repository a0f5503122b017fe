// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/picture.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "meshes/mesh_error.hpp"
#include "meshes/mesh_limits.hpp"
#include "meshes/reader_process.hpp"
#include "meshes/reader_stream.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    throw MeshError(fs::exists(file, error) ? "is not a regular file" : "does not exist");
  }
  const std::uint64_t size = fs::file_size(file, error);
  if (error) throw MeshError("cannot be read (" + error.message() + ")");
  if (size > kLargestPictureFile) {
    throw MeshError("is " + std::to_string(size / kMegabyte) + " MB large; the maximum is " +
                    std::to_string(kLargestPictureFile / kMegabyte) + " MB");
  }
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw MeshError("cannot be read");
  }
  return bytes;
}

/// Reads a picture in a process of its own.
PictureContent read_picture(const PictureQuery& query) {
  ReaderProcess process("picture_reader");
  const std::uint64_t seconds = mesh_seconds(query.bytes.size());
  try {
    ReaderStream stream(process.socket());
    // The reader limits its own CPU time; this limit is for a reader that waits.
    stream.set_deadline(ReaderStream::Clock::now() + std::chrono::seconds(30 + 4 * seconds));
    each_value_of_query(query, [&stream](const auto& value) { stream.send(value); });
    PictureContent content;
    each_value_of_content(content, [&stream](auto& value) { stream.receive(value); });
    if (!content.error.empty()) throw MeshError(content.error);
    return content;
  } catch (const StreamClosed&) {
    throw MeshError("cannot be read as an image (" + process.reason_of_end(seconds) + "): the file is damaged");
  } catch (const StreamTimeout&) {
    throw MeshError("cannot be read as an image (its reader does not answer): the file is damaged");
  }
}

/// Throws MeshError unless there are so many values of each pixel.
void check_size(const PictureContent& content, std::size_t values, std::size_t found) {
  const bool whole =
      content.width > 0 && content.height > 0 &&
      found == values * static_cast<std::size_t>(content.width) * static_cast<std::size_t>(content.height);
  if (!whole) throw MeshError("cannot be read as an image (its reader answered with a part of it)");
}

}  // namespace

Heights to_heights(const PictureContent& content) {
  check_size(content, 1, content.heights.size());
  Heights heights{static_cast<std::size_t>(content.width), static_cast<std::size_t>(content.height), {}};
  heights.values.reserve(content.heights.size());
  for (const std::uint16_t height : content.heights) {
    heights.values.push_back(static_cast<float>(height) / std::numeric_limits<std::uint16_t>::max());
  }
  return heights;
}

std::shared_ptr<const Texture> to_texture(PictureContent content) {
  check_size(content, 3, content.rgb.size());
  return std::make_shared<const Texture>(Texture{content.width, content.height, std::move(content.rgb)});
}

Heights read_heights(const fs::path& file) { return to_heights(read_picture({PictureKind::kHeights, bytes_of(file)})); }

std::shared_ptr<const Texture> read_texture(const fs::path& file) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Texture>> known;
  const std::scoped_lock lock(mutex);
  std::weak_ptr<const Texture>& shared = known[file.string()];
  if (std::shared_ptr<const Texture> texture = shared.lock()) return texture;
  std::shared_ptr<const Texture> texture = decode_texture(bytes_of(file));
  shared = texture;
  return texture;
}

std::shared_ptr<const Texture> decode_texture(std::vector<std::uint8_t> bytes) {
  if (bytes.size() > kLargestPictureFile) throw MeshError("is too large for an image");
  return to_texture(read_picture({PictureKind::kTexture, std::move(bytes)}));
}

Color mean_color(const Texture& texture) {
  std::array<std::uint64_t, 3> sum{};
  for (std::size_t i = 0; i < texture.rgb.size(); ++i) sum[i % 3] += texture.rgb[i];
  const double full = 255.0 * static_cast<double>(texture.rgb.size()) / 3;
  const auto mean = [&](std::size_t i) { return static_cast<float>(static_cast<double>(sum[i]) / full); };
  return {mean(0), mean(1), mean(2)};
}

}  // namespace bubblesim
