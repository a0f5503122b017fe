// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/urdf_values.hpp"

#include <algorithm>
#include <cmath>

#include "load/sdf/elements/sdf_element.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// The finite numbers in an attribute that is there.
std::optional<std::vector<double>> numbers_in(const XmlElement& element, const std::string& attribute,
                                              std::size_t count, const std::string& path, LoadContext& context) {
  const std::string& text = *element.attribute(attribute);
  std::vector<double> numbers;
  const bool is_read = read_numbers(text, numbers) && numbers.size() == count;
  if (is_read && std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); })) {
    return numbers;
  }
  const std::string wanted =
      count == 1 ? "a finite number" : (count == 3 ? "three" : "four") + std::string(" finite numbers");
  context.report(element.source(), path,
                 "<" + element.name + "> has " + attribute + "='" + text + "', it must be " + wanted);
  return std::nullopt;
}

bool has_required(const XmlElement& element, const std::string& attribute, const std::string& path,
                  LoadContext& context) {
  if (element.attribute(attribute) != nullptr) return true;
  context.report(element.source(), path, "<" + element.name + "> has no attribute " + attribute + ": URDF requires it");
  return false;
}

/// The orientation of an <origin> in URDF 1.1.
Quaternion read_quaternion(const XmlElement& origin, const std::string& path, LoadContext& context) {
  const auto numbers = numbers_in(origin, "quat_xyzw", 4, path, context);
  if (!numbers) return {};
  const Quaternion rotation((*numbers)[3], (*numbers)[0], (*numbers)[1], (*numbers)[2]);
  if (rotation.norm() > 0) return rotation.normalized();
  context.report(origin.source(), path,
                 "<origin> has quat_xyzw='" + *origin.attribute("quat_xyzw") + "', it must not be 0");
  return {};
}

}  // namespace

std::optional<double> number_in(const XmlElement& element, const std::string& attribute, const std::string& path,
                                LoadContext& context) {
  if (element.attribute(attribute) == nullptr) return std::nullopt;
  const auto numbers = numbers_in(element, attribute, 1, path, context);
  return numbers ? std::make_optional(numbers->front()) : std::nullopt;
}

std::optional<double> required_number_in(const XmlElement& element, const std::string& attribute,
                                         const std::string& path, LoadContext& context) {
  if (!has_required(element, attribute, path, context)) return std::nullopt;
  return number_in(element, attribute, path, context);
}

std::optional<Vector3> vector_in(const XmlElement& element, const std::string& attribute, const std::string& path,
                                 LoadContext& context) {
  if (element.attribute(attribute) == nullptr) return std::nullopt;
  const auto numbers = numbers_in(element, attribute, 3, path, context);
  return numbers ? std::make_optional(Vector3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

std::optional<Vector3> required_vector_in(const XmlElement& element, const std::string& attribute,
                                          const std::string& path, LoadContext& context) {
  if (!has_required(element, attribute, path, context)) return std::nullopt;
  return vector_in(element, attribute, path, context);
}

Pose origin_of(const XmlElement& element, const std::string& path, LoadContext& context) {
  const XmlElement* origin = element.child("origin");
  if (origin == nullptr) return {};
  const Vector3 position = vector_in(*origin, "xyz", path, context).value_or(Vector3());
  if (origin->attribute("quat_xyzw") != nullptr) return {position, read_quaternion(*origin, path, context)};
  const Vector3 rpy = vector_in(*origin, "rpy", path, context).value_or(Vector3());
  return {position, from_rpy(rpy.x(), rpy.y(), rpy.z())};
}

XmlElement in_place_of(const XmlElement& other, const std::string& name) {
  XmlElement element;
  element.name = name;
  element.file = other.file;
  element.line = other.line;
  return element;
}

XmlElement named_element(const std::string& kind, const std::string& name, const XmlElement& place) {
  XmlElement element = in_place_of(place, kind);
  element.set_attribute("name", name);
  return element;
}

XmlElement pose_element(const Pose& pose, const XmlElement& place) {
  const Vector3& p = pose.position;
  const Quaternion& q = pose.orientation;
  XmlElement element = in_place_of(place, "pose");
  element.text = write_numbers({p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
  element.set_attribute("rotation_format", "quat_xyzw");
  return element;
}

}  // namespace bubblesim
