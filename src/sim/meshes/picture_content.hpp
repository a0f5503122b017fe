// SPDX-License-Identifier: BSD-3-Clause
// Requests to the program picture_reader, and its answers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bubblesim {

/// What is made of an image file.
enum class PictureKind : std::uint8_t { kTexture, kHeights };

struct PictureQuery {
  PictureKind kind = PictureKind::kTexture;
  std::vector<std::uint8_t> bytes;  ///< of the file
};

struct PictureContent {
  std::string error;  ///< reason of a failure; empty on success
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<std::uint8_t> rgb;       ///< of a texture: 3 bytes a pixel, row by row from the top
  std::vector<std::uint16_t> heights;  ///< or the brightness of each pixel
};

/// Sends or receives a query or an answer: `step` is called with each of its values.
template <class Query, class Step>
void each_value_of_query(Query& query, const Step& step) {
  step(query.kind);
  step(query.bytes);
}

template <class Content, class Step>
void each_value_of_content(Content& content, const Step& step) {
  step(content.error);
  step(content.width);
  step(content.height);
  step(content.rgb);
  step(content.heights);
}

}  // namespace bubblesim
