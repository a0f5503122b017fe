// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/container.hpp"

#include "load/ttt/bytes.hpp"
#include "load/ttt/huffman.hpp"

namespace bubblesim::ttt {
namespace {

constexpr std::size_t kHeader = 1021;
constexpr int kOldest = 13;  // with the header as below; none was seen below 15
constexpr int kImpossible = 1000;
constexpr std::int64_t kLargest = 512LL << 20;
// A code has at least one bit.
constexpr std::int64_t kMostFactor = 8;

}  // namespace

Container open_container(std::string_view file) {
  if (file.empty()) fail_at(0, "the file is empty");
  if (file.substr(0, 7) == "version") {
    fail_at(0, "it is a pointer of Git LFS, not the file itself: fetch it with 'git lfs pull'");
  }
  if (file.substr(0, 4) != "VREP") fail_at(0, "it does not begin with VREP: it is no .ttt or .ttm file of CoppeliaSim");
  if (file.size() < kHeader) fail_at(file.size(), "the file ends within its header: it is cut off");
  Bytes header(file.substr(4));
  Container container;
  container.serialization = header.i32();
  // Later versions leave out what they add: unknown items are skipped.
  if (container.serialization < kOldest || container.serialization > kImpossible) {
    fail_at(4, "the format has the version " + std::to_string(container.serialization) + ", known are " +
                   std::to_string(kOldest) + " to " + std::to_string(kNewestFormat) +
                   " (V4.10): save it with another version of CoppeliaSim");
  }
  header.i32();
  const int compression = header.u8();
  const std::int64_t size = header.i32();
  header.i32();
  container.program_version = header.u16();
  const std::string_view payload = file.substr(kHeader);
  if (compression > 1) fail_at(12, "the compression " + std::to_string(compression) + " is not known");
  const auto packed = static_cast<std::int64_t>(payload.size());
  if (size <= 0 || size > kLargest || size > packed * (compression == 1 ? kMostFactor : 1)) {
    fail_at(13, "an unpacked size of " + std::to_string(size) + " bytes is impossible for " + std::to_string(packed) +
                    " packed ones, or above 512 MB: the file is damaged");
  }
  const auto bytes = static_cast<std::size_t>(size);
  container.content = compression == 1 ? unpack(payload, bytes, kHeader) : std::string(payload.substr(0, bytes));
  return container;
}

}  // namespace bubblesim::ttt
