// SPDX-License-Identifier: BSD-3-Clause
// A sequence lock: the writer makes the number odd, writes, and makes it even; a reader that saw it change reads again.
#include "bubblesim/frame_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>
#include <tuple>

namespace bubblesim {
namespace {

using Sequence = std::atomic<std::uint64_t>;
static_assert(Sequence::is_always_lock_free);

constexpr std::size_t kHeadAt = 64;  // after the sequence number, on a cache line of its own
constexpr std::size_t kNumbersAt = 192;
constexpr int kTries = 1000;
static_assert(kHeadAt + sizeof(FrameHead) <= kNumbersAt);

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

double monotonic_time() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// All but the count and the time at which it was written.
auto contents(const FrameHead& head) {
  return std::tie(head.revision, head.notices, head.time, head.state, head.links, head.axes, head.closed);
}

/// As memcmp() and memcpy(), which take no null pointer of an empty vector.
bool holds(const std::byte* memory, const void* values, std::size_t size) {
  return size == 0 || std::memcmp(memory, values, size) == 0;
}
void copy(std::byte* memory, const void* values, std::size_t size) {
  if (size > 0) std::memcpy(memory, values, size);
}

std::size_t count_numbers(const FrameHead& head) { return 7 * std::size_t{head.links} + head.axes; }

}  // namespace

FrameMemory::FrameMemory() : descriptor_(memfd_create("bubblesim-frames", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail("memory for frames");
  path_ = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
  try {
    resize(kNumbersAt);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

FrameMemory::~FrameMemory() {
  FrameHead head = last_;
  head.closed = 1;
  publish(head);
  munmap(memory_, size_);
  close(descriptor_);
}

void FrameMemory::resize(std::size_t bytes) {
  if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) fail("memory for frames");
  void* mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (mapped == MAP_FAILED) fail("memory for frames");
  if (memory_ != nullptr) munmap(memory_, size_);
  memory_ = static_cast<std::byte*>(mapped);
  size_ = bytes;
}

void FrameMemory::write(const Frame& frame) {
  FrameHead head = last_;
  head.revision = frame.layout->revision;
  head.notices = notices_.load(std::memory_order_relaxed);
  head.time = frame.time;
  head.state = static_cast<std::uint32_t>(frame.state);
  head.links = static_cast<std::uint32_t>(frame.poses.size());
  head.axes = static_cast<std::uint32_t>(frame.joint_positions.size());
  const std::size_t pose_bytes = frame.poses.size() * sizeof(FramePose);
  const std::size_t axis_bytes = frame.joint_positions.size() * sizeof(float);
  const std::size_t needed = kNumbersAt + pose_bytes + axis_bytes;
  if (needed > size_) resize(std::max(needed, 2 * size_));  // never smaller: readers map the old size
  std::byte* const poses = memory_ + kNumbersAt;
  std::byte* const axes = poses + pose_bytes;
  if (contents(head) == contents(last_) && holds(poses, frame.poses.data(), pose_bytes) &&
      holds(axes, frame.joint_positions.data(), axis_bytes)) {
    return;  // a pause in which nothing happens
  }
  ++head.count;
  head.written = monotonic_time();
  auto* sequence = reinterpret_cast<Sequence*>(memory_);
  sequence->fetch_add(1, std::memory_order_acq_rel);
  std::atomic_thread_fence(std::memory_order_release);
  std::memcpy(memory_ + kHeadAt, &head, sizeof head);
  copy(poses, frame.poses.data(), pose_bytes);
  copy(axes, frame.joint_positions.data(), axis_bytes);
  sequence->fetch_add(1, std::memory_order_release);
  last_ = head;
}

/// Writes the head alone.
void FrameMemory::publish(const FrameHead& head) {
  auto* sequence = reinterpret_cast<Sequence*>(memory_);
  sequence->fetch_add(1, std::memory_order_acq_rel);
  std::atomic_thread_fence(std::memory_order_release);
  std::memcpy(memory_ + kHeadAt, &head, sizeof head);
  sequence->fetch_add(1, std::memory_order_release);
}

FrameReader::FrameReader(const std::string& path) : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail(path);
  try {
    if (!map(kNumbersAt)) throw std::system_error(EINVAL, std::generic_category(), path);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

FrameReader::~FrameReader() {
  munmap(const_cast<std::byte*>(memory_), size_);
  close(descriptor_);
}

/// Maps at least `bytes`; false when there are fewer.
bool FrameReader::map(std::size_t bytes) {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail("memory of frames");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size < bytes) return false;
  void* mapped = mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor_, 0);
  if (mapped == MAP_FAILED) fail("memory of frames");
  if (memory_ != nullptr) munmap(const_cast<std::byte*>(memory_), size_);
  memory_ = static_cast<const std::byte*>(mapped);
  size_ = size;
  return true;
}

std::optional<FrameHead> FrameReader::head() {
  for (int i = 0; i < kTries; ++i) {
    const auto* sequence = reinterpret_cast<const Sequence*>(memory_);
    const std::uint64_t before = sequence->load(std::memory_order_acquire);
    if (before % 2 == 1) continue;
    FrameHead head;
    std::memcpy(&head, memory_ + kHeadAt, sizeof head);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (sequence->load(std::memory_order_relaxed) == before) return head;
  }
  return {};
}

std::optional<FrameReader::Copy> FrameReader::read() {
  for (int i = 0; i < kTries; ++i) {
    const auto* sequence = reinterpret_cast<const Sequence*>(memory_);
    const std::uint64_t before = sequence->load(std::memory_order_acquire);
    if (before % 2 == 1) continue;
    Copy copy;
    std::memcpy(&copy.head, memory_ + kHeadAt, sizeof copy.head);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (sequence->load(std::memory_order_relaxed) != before) continue;
    const std::size_t bytes = count_numbers(copy.head) * sizeof(float);
    if (kNumbersAt + bytes > size_ && !map(kNumbersAt + bytes)) continue;
    copy.numbers.resize(count_numbers(copy.head));
    std::memcpy(copy.numbers.data(), memory_ + kNumbersAt, bytes);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (reinterpret_cast<const Sequence*>(memory_)->load(std::memory_order_relaxed) == before) return copy;
  }
  return {};
}

}  // namespace bubblesim
