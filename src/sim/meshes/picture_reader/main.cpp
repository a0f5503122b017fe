// SPDX-License-Identifier: BSD-3-Clause
// The program picture_reader: decodes an image file for a simulator in a separate process, because stb_image reads
// beyond its tables and aborts on some damaged files. Ends after one file.
#include <stb_image.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <utility>

#include "meshes/mesh_limits.hpp"
#include "meshes/picture_content.hpp"
#include "meshes/reader_program.hpp"
#include "meshes/reader_stream.hpp"

namespace bubblesim {
namespace {

// An image file of a few bytes may declare any size.
constexpr std::int64_t kMostPixels = 8192LL * 8192;
constexpr std::uint64_t kMemory = 3072 * kMegabyte;  // the decoder of PNG holds such an image three times

PictureContent failed(std::string error) {
  PictureContent content;
  content.error = std::move(error);
  return content;
}

PictureContent decode(const PictureQuery& query) {
  PictureContent content;
  int channels = 0;
  const stbi_uc* const bytes = query.bytes.data();
  const auto size = static_cast<int>(query.bytes.size());
  const bool known = stbi_info_from_memory(bytes, size, &content.width, &content.height, &channels) != 0;
  const std::int64_t pixels = std::int64_t{content.width} * content.height;
  if (known && pixels > kMostPixels) {  // unknown formats fail later, when they are read
    return failed("has " + std::to_string(content.width) + " x " + std::to_string(content.height) +
                  " pixels; the maximum is " + std::to_string(kMostPixels));
  }
  const auto take = [&content](const auto* first, std::int64_t values, auto& array) {
    if (first != nullptr) array.assign(first, first + values * content.width * content.height);
    return first != nullptr;
  };
  const bool read =
      query.kind == PictureKind::kHeights
          ? take(stbi_load_16_from_memory(bytes, size, &content.width, &content.height, &channels, 1), 1,
                 content.heights)
          : take(stbi_load_from_memory(bytes, size, &content.width, &content.height, &channels, 3), 3, content.rgb);
  if (read) return content;
  return failed(std::string("cannot be read as an image (") + stbi_failure_reason() +
                "); supported formats: png, jpg, bmp, tga, gif");
}

int serve(int socket) {
  ReaderStream stream(socket);
  try {
    PictureQuery query;
    each_value_of_query(query, [&stream](auto& value) { stream.receive(value); });
    set_limits(mesh_seconds(query.bytes.size()), kMemory);
    const PictureContent content = decode(query);
    each_value_of_content(content, [&stream](const auto& value) { stream.send(value); });
  } catch (const StreamClosed&) {
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace bubblesim

int main() {
  if (!bubblesim::begin_reading("picture_reader", "images")) return 2;
  ::_exit(bubblesim::serve(STDIN_FILENO));  // which frees the pixels, too
}
