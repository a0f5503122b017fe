// SPDX-License-Identifier: BSD-3-Clause
// A <sensor> of a scene file, for the reader of its kind.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim {

class LoadContext;
class SdfElement;

/// Paths are names of elements below the sensor: "imu/angular_velocity/x". They must be in the table of elements, whose
/// defaults stand for elements that the file does not have.
class SensorElement {
 public:
  /// `part`: an element that is read in place of the sensor's own child of that name; null for none.
  SensorElement(const SdfElement& sensor, std::string type, std::string path, LoadContext& context,
                const SdfElement* part = nullptr)
      : sensor_(sensor), type_(std::move(type)), path_(std::move(path)), context_(context), part_(part) {}

  /// SDFormat's newest name.
  const std::string& type() const { return type_; }
  SdfElement at(std::string_view path) const;

  /// Whether the file has it.
  bool has(std::string_view path) const;
  double number(std::string_view path) const;
  /// Limited to +-1e9.
  int integer(std::string_view path) const;
  std::string text(std::string_view path) const;
  std::vector<std::string> strings(std::string_view path) const;
  /// As written, without regard to `relative_to`.
  Pose pose(std::string_view path) const;
  /// Of a <noise> element.
  NoiseDescription noise(std::string_view path) const;
  /// Of the <noise> of <x>, <y> and <z> below an element.
  std::array<NoiseDescription, 3> noise_of_axes(std::string_view path) const;
  /// The number of one of bubblesim's own elements, 0 when the file has none; other text is reported.
  double own_number(std::string_view path) const;
  /// Whether one of bubblesim's own elements is true; other text than true and false is reported.
  bool own_flag(std::string_view path) const;
  /// The place of the text of an element in a list of names; empty when it is not one of them, which is reported.
  std::optional<std::size_t> choice(std::string_view path, const std::vector<std::string>& names) const;

  /// The sensor's pose is relative to this one, which is relative to the <sensor>.
  void set_offset(const Pose& offset) { offset_ = offset; }
  const std::optional<Pose>& offset() const { return offset_; }

  /// A problem, which is an error when the scene is loaded, or a warning, at the place of an element.
  void report(std::string_view path, std::string message) const;
  void warn(std::string_view path, std::string message) const;

 private:
  Source source_of(std::string_view path) const;

  const SdfElement& sensor_;
  std::string type_;
  std::string path_;
  LoadContext& context_;
  const SdfElement* part_;
  std::optional<Pose> offset_;
};

}  // namespace bubblesim
