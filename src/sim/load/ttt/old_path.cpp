// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/old_path.hpp"

#include <array>
#include <cstring>

namespace bubblesim::ttt {
namespace {

void append(std::string& bytes, const Pose& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  const std::array<double, 7> numbers{p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  std::array<char, sizeof numbers> raw{};
  std::memcpy(raw.data(), numbers.data(), sizeof numbers);
  bytes.append(raw.data(), raw.size());
}

Pose between(const Pose& a, const Pose& b, double part) {
  return {a.position + part * (b.position - a.position), a.orientation.slerp(part, b.orientation)};
}

/// The curve that rounds a corner: a quadratic Bezier curve between points on the ways to both neighbours.
void append_curve(std::string& bytes, const Pose& before, const Path::Point& corner, const Pose& after) {
  const Pose begin = between(corner.pose, before, corner.before);
  const Pose end = between(corner.pose, after, corner.after);
  for (int i = 0; i < corner.count; ++i) {
    const double t = static_cast<double>(i) / (corner.count - 1);
    append(bytes, between(between(begin, corner.pose, t), between(corner.pose, end, t), t));
  }
}

}  // namespace

std::map<std::string, std::string> data_of(const Path& path) {
  const std::size_t count = path.points.size();
  if (count == 0) return {};
  std::string control;
  std::string curve;
  for (std::size_t i = 0; i < count; ++i) {
    const Path::Point& point = path.points[i];
    append(control, point.pose);
    const bool is_end = !path.is_closed && (i == 0 || i + 1 == count);
    if (is_end || point.count < 2 || count < 3) {
      append(curve, point.pose);
    } else {
      append_curve(curve, path.points[(i + count - 1) % count].pose, point, path.points[(i + 1) % count].pose);
    }
  }
  constexpr std::size_t kPose = 7 * sizeof(double);
  if (path.is_closed) curve += curve.substr(0, kPose);
  return {{"PATH", curve}, {"PATHCTRLPTS", control}};
}

}  // namespace bubblesim::ttt
