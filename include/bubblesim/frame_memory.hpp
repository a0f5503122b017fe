// SPDX-License-Identifier: BSD-3-Clause
// Frames in memory that other processes of the same user map: the simulator writes, and never waits for a reader.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bubblesim/frame.hpp"

namespace bubblesim {

/// The first bytes of the memory. What follows are the poses (7 floats each) and joint positions (1 float each) of the
/// frame.
struct FrameHead {
  std::uint64_t count = 0;     ///< of frames so far
  std::uint64_t revision = 0;  ///< of the layout
  std::uint64_t notices = 0;   ///< see FrameMemory::notice()
  double time = 0;             ///< s, simulation time
  double written = 0;          ///< s, CLOCK_MONOTONIC
  std::uint32_t state = 0;     ///< RunState
  std::uint32_t links = 0;
  std::uint32_t axes = 0;
  std::uint32_t closed = 0;  ///< 1: the writer has ended
};

/// The last frame of a runner, in memory without a name (memfd). Functions are for the runner's thread, except
/// notice().
class FrameMemory {
 public:
  /// Throws std::system_error without memory.
  FrameMemory();
  ~FrameMemory();
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;

  /// Does nothing when only the count would change.
  void write(const Frame& frame);
  /// Counts something that readers should ask for, such as a line of a script's output. Thread-safe.
  void notice() { notices_.fetch_add(1, std::memory_order_relaxed); }
  /// Where processes of the same user open it.
  const std::string& path() const { return path_; }

 private:
  void resize(std::size_t bytes);
  void publish(const FrameHead& head);

  int descriptor_ = -1;
  std::byte* memory_ = nullptr;
  std::size_t size_ = 0;
  std::string path_;
  FrameHead last_;
  std::atomic<std::uint64_t> notices_{0};
};

/// Reads the frames of another process.
class FrameReader {
 public:
  /// Throws std::system_error when the memory cannot be opened.
  explicit FrameReader(const std::string& path);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// The head of the last frame, without its poses. Empty when the writer is in the middle of a frame for long.
  std::optional<FrameHead> head();
  struct Copy {
    FrameHead head;
    std::vector<float> numbers;  ///< poses, then joint positions
  };
  std::optional<Copy> read();

 private:
  bool map(std::size_t bytes);

  int descriptor_ = -1;
  const std::byte* memory_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace bubblesim
