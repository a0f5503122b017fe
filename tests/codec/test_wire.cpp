// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {
namespace {

std::vector<std::uint8_t> bytes_of(const WireBuffer& buffer) { return {buffer.data(), buffer.data() + buffer.size()}; }

TEST(WireBuffer, NumbersAreLittleEndianWithoutPadding) {
  WireBuffer buffer;
  buffer.put(std::uint8_t{1});
  buffer.put(std::uint32_t{0x01020304});
  EXPECT_EQ(bytes_of(buffer), (std::vector<std::uint8_t>{1, 4, 3, 2, 1}));
}

TEST(WireBuffer, IsEmptyBeforeAnythingIsPut) {
  const WireBuffer buffer;
  EXPECT_EQ(buffer.size(), 0U);
}

TEST(WireBuffer, KeepsItsContentWhileItGrows) {
  WireBuffer buffer;
  std::string expected;
  for (int i = 0; i < 5000; ++i) {
    const std::string piece = std::to_string(i);
    buffer.put_bytes(piece.data(), piece.size());
    expected += piece;
  }
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(buffer.data()), buffer.size()), expected);
}

TEST(WireBuffer, ReleasedStorageHasRoomForThePrefixInFront) {
  WireBuffer buffer;
  buffer.put(std::uint8_t{7});
  const auto storage = buffer.release();
  EXPECT_EQ(storage[WireBuffer::kPrefix], 7);
  EXPECT_EQ(buffer.size(), 0U);
}

TEST(WireBuffer, AnEmptyMessageReleasesAPrefix) { EXPECT_NE(WireBuffer().release(), nullptr); }

TEST(WireBuffer, CanBeFilledAgainAfterRelease) {
  WireBuffer buffer;
  buffer.put(std::uint8_t{1});
  buffer.release();
  buffer.put(std::uint8_t{2});
  EXPECT_EQ(bytes_of(buffer), (std::vector<std::uint8_t>{2}));
}

TEST(WireBuffer, ClearForgetsTheContent) {
  WireBuffer buffer;
  buffer.put(std::uint32_t{1});
  buffer.clear();
  buffer.put(std::uint8_t{2});
  EXPECT_EQ(bytes_of(buffer), (std::vector<std::uint8_t>{2}));
}

TEST(WireBuffer, CanBeClearedBeforeAnythingIsPut) {
  WireBuffer buffer;
  buffer.clear();
  buffer.put(std::uint8_t{2});
  EXPECT_EQ(bytes_of(buffer), (std::vector<std::uint8_t>{2}));
}

TEST(WireBuffer, MovingTakesTheContentAlong) {
  WireBuffer from;
  from.put(std::uint8_t{3});
  WireBuffer to;
  to = std::move(from);
  EXPECT_EQ(bytes_of(to), (std::vector<std::uint8_t>{3}));
  EXPECT_EQ(from.size(), 0U);  // NOLINT: a moved-from buffer is empty by its contract
}

TEST(WireView, GivesBackWhatWasPut) {
  WireBuffer buffer;
  buffer.put(std::int16_t{-2});
  buffer.put(0.5);
  WireView view(buffer.data(), buffer.size());
  EXPECT_EQ(view.get<std::int16_t>(), -2);
  EXPECT_EQ(view.get<double>(), 0.5);
  EXPECT_EQ(view.left(), 0U);
}

TEST(WireView, DoesNotReadPastTheEnd) {
  const std::uint8_t bytes[3] = {1, 2, 3};
  WireView view(bytes, sizeof(bytes));
  EXPECT_THROW(view.get<std::uint32_t>(), WireError);
  EXPECT_EQ(view.left(), 3U);
}

TEST(WireView, StatesHowMuchIsMissing) {
  WireView view(nullptr, 0);
  try {
    view.take(12);
    FAIL() << "no error";
  } catch (const WireError& error) {
    EXPECT_STREQ(error.what(), "the message is truncated: expected 12 more bytes, found 0");
  }
}

}  // namespace
}  // namespace bubblesim::messages
