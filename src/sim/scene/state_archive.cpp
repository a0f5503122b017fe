// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/state_archive.hpp"

#include <cstring>

#include "bubblesim/error.hpp"

namespace bubblesim {

void StateArchive::bytes(void* data, std::size_t size) {
  if (saved_ != nullptr) {
    saved_->append(static_cast<const char*>(data), size);
    return;
  }
  if (size > left_.size()) {
    throw InvalidInput("the saved state ends too early; it was saved by another version, or the file was cut");
  }
  if (size != 0) std::memcpy(data, left_.data(), size);
  left_.remove_prefix(size);
}

std::size_t StateArchive::count(std::size_t present) {
  std::uint64_t number = present;
  bytes(&number, sizeof number);
  if (restores() && number > left_.size()) {
    throw InvalidInput("the saved state ends too early; it was saved by another version, or the file was cut");
  }
  return static_cast<std::size_t>(number);
}

void StateArchive::require(std::uint64_t present, const char* what) {
  std::uint64_t saved = present;
  bytes(&saved, sizeof saved);
  if (saved == present) return;
  throw InvalidInput(std::string("the saved state does not fit this simulation: ") + what + ": saved " +
                     std::to_string(saved) + ", here " + std::to_string(present));
}

void transfer(StateArchive& archive, Vector3& value) { archive.bytes(value.data(), 3 * sizeof(double)); }

void transfer(StateArchive& archive, Quaternion& value) {
  double numbers[] = {value.w(), value.x(), value.y(), value.z()};
  archive.bytes(numbers, sizeof numbers);
  if (archive.restores()) value = Quaternion(numbers[0], numbers[1], numbers[2], numbers[3]);
}

void transfer(StateArchive& archive, Pose& value) { archive(value.position, value.orientation); }

void transfer(StateArchive& archive, Twist& value) { archive(value.linear, value.angular); }

void transfer(StateArchive& archive, std::string& value) {
  value.resize(archive.count(value.size()));
  archive.bytes(value.data(), value.size());
}

}  // namespace bubblesim
