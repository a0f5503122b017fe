// SPDX-License-Identifier: BSD-3-Clause
// Writes small files in CoppeliaSim's format for tests: items, lists, objects, the header.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace bubblesim::test::ttt_writer {

/// The bytes of a number, the lowest first.
template <class Value>
std::string raw(Value value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline std::string ints(std::initializer_list<std::int32_t> values) {
  std::string bytes;
  for (const std::int32_t value : values) bytes += raw(value);
  return bytes;
}
inline std::string floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) bytes += raw(value);
  return bytes;
}
inline std::string doubles(std::initializer_list<double> values) {
  std::string bytes;
  for (const double value : values) bytes += raw(value);
  return bytes;
}
inline std::string byte(unsigned value) { return std::string(1, static_cast<char>(value)); }
inline std::string text(const std::string& value) { return ints({static_cast<std::int32_t>(value.size())}) + value; }

inline std::string item(const std::string& tag, const std::string& content) {
  return tag + ints({static_cast<std::int32_t>(content.size())}) + content;
}

/// An object: `pose` is w x y z and then x y z.
struct ObjectText {
  std::string tag;
  int handle = 0;
  int parent = -1;
  std::string alias{};
  std::array<double, 7> pose{1, 0, 0, 0, 0, 0, 0};
  std::string common{};  ///< further items of the first half
  std::string own{};     ///< items of the second half

  std::string bytes() const {
    return item(tag, item("Ids", ints({handle, parent})) + item("_fq", raw(pose)) + item("Ali", text(alias)) + common +
                         "NXT" + own + "EOO");
  }
};

constexpr unsigned kDynamic = 0x80;

/// The second half of a cuboid of 0.1 m and 2 kg.
inline std::string cuboid(unsigned state_bits) {
  const std::string body =
      item("_as", doubles({2})) + item("Com", doubles({0, 0, 0})) + item("Imx", doubles({1, 0, 0, 0, 1, 0, 0, 0, 1}));
  const std::string mesh = item("_pr", ints({3}) + doubles({0.1, 0.1, 0.1}));
  return item("Ge2", item("Gst", body + "EOO" + mesh + "EOO") + "EOO") + item("Sss", byte(state_bits)) +
         item("Ss3", byte(1));
}

inline std::string joint(int mode, double position = 0) {
  return item("Jtt", ints({10})) + item("_rt", doubles({position})) + item("_mr", doubles({-1, 2})) +
         item("Jmd", ints({mode}));
}

/// A header for a payload that is not packed (0) or packed (1).
inline std::string header(unsigned compression, std::size_t unpacked, int serialization = 25) {
  std::string bytes = "VREP" + ints({serialization, 24}) + byte(compression) +
                      ints({static_cast<std::int32_t>(unpacked), 0}) + raw(std::uint16_t{41000});
  return bytes + std::string(1021 - bytes.size(), '\0');
}

/// A scene, or a model without the tag ENV.
inline std::string file(const std::vector<ObjectText>& objects, const std::string& others = item("ENV", "EOO")) {
  std::string content;
  for (const ObjectText& object : objects) content += object.bytes();
  content += others + "EOF";
  return header(0, content.size()) + content;
}

}  // namespace bubblesim::test::ttt_writer
