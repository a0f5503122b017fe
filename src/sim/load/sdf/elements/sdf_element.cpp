// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/sdf_element.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "scene/describe.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  read_numbers(text, numbers);
  return numbers;
}

template <std::size_t N>
std::array<double, N> numbers_of(const SdfElement& element) {
  std::array<double, N> values{};
  const std::vector<double> given = numbers_in(element.as_text());
  for (std::size_t i = 0; i < N && i < given.size(); ++i) values[i] = given[i];
  return values;
}

}  // namespace

Source SdfElement::source(std::string_view child) const {
  const XmlElement* found = xml_ != nullptr ? xml_->child(child) : nullptr;
  return found != nullptr ? found->source() : source();
}

const ElementKind& SdfElement::kind_of(std::string_view child) const {
  const ElementKind* found = kind_->child(child);
  if (found == nullptr) {
    throw std::logic_error("the table of elements has no <" + std::string(child) + "> in <" + kind_->name + ">");
  }
  return *found;
}

SdfElement SdfElement::child(std::string_view name) const {
  return {xml_ != nullptr ? xml_->child(name) : nullptr, kind_of(name)};
}

std::vector<SdfElement> SdfElement::children(std::string_view name) const {
  const ElementKind& kind = kind_of(name);
  std::vector<SdfElement> found;
  if (xml_ == nullptr) return found;
  for (const XmlElement& each : xml_->children) {
    if (each.name == name) found.emplace_back(&each, kind);
  }
  return found;
}

std::string SdfElement::attribute(std::string_view name) const {
  const AttributeKind* known = kind_->attribute(name);
  if (known == nullptr) {
    throw std::logic_error("the table of elements has no attribute " + std::string(name) + " of <" + kind_->name + ">");
  }
  const std::string* given = xml_ != nullptr ? xml_->attribute(name) : nullptr;
  return given != nullptr ? trimmed(*given) : known->default_text;
}

const std::string& SdfElement::as_text() const { return xml_ != nullptr ? xml_->text : kind_->default_text; }

double SdfElement::as_number() const { return numbers_of<1>(*this)[0]; }

bool SdfElement::as_flag() const { return is_true(as_text()); }

Vector3 SdfElement::as_vector() const {
  const auto [x, y, z] = numbers_of<3>(*this);
  return {x, y, z};
}

Eigen::Vector2d SdfElement::as_vector2() const {
  const auto [x, y] = numbers_of<2>(*this);
  return {x, y};
}

Color SdfElement::as_color() const {
  const auto [r, g, b] = numbers_of<3>(*this);
  return {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)};
}

Pose SdfElement::as_pose() const {
  const auto [x, y, z, a, b, c, w] = numbers_of<7>(*this);
  const std::string* format = xml_ != nullptr ? xml_->attribute("rotation_format") : nullptr;
  if (format != nullptr && *format == "quat_xyzw") {
    const Quaternion rotation(w, a, b, c);
    return {{x, y, z}, rotation.norm() > 0 ? Quaternion(rotation.normalized()) : Quaternion()};
  }
  const std::string* degrees = xml_ != nullptr ? xml_->attribute("degrees") : nullptr;
  const double unit = degrees != nullptr && is_true(*degrees) ? M_PI / 180 : 1;
  return {x, y, z, a * unit, b * unit, c * unit};
}

bool is_true(std::string_view text) { return text == "true" || text == "1"; }

std::string write_numbers(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + exact(number);
  return text;
}

}  // namespace bubblesim
