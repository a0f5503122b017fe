// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_values.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sdf/Param.hh>
#include <sdf/parser.hh>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "load/sdf/sdf_document.hpp"
#include "load/sdf_extensions.hpp"
#include "load/xml_lines.hpp"

namespace bubblesim {
namespace {

using tinyxml2::XMLElement;

/// Null when SDFormat does not know the element.
sdf::ElementPtr description_below(const sdf::ElementPtr& parent, const std::string& name) {
  for (std::size_t i = 0; i < parent->GetElementDescriptionCount(); ++i) {
    sdf::ElementPtr found = parent->GetElementDescription(static_cast<unsigned int>(i));
    if (found->GetName() == name) return found;
  }
  return nullptr;
}

/// A nested model is described by a reference only.
sdf::ElementPtr description_of(const sdf::ElementPtr& parent, const std::string& name) {
  if (name == "model" && parent->GetName() == "model") return parent;
  return description_below(parent, name);
}

/// The numbers in a text, infinite beyond the range of double; empty when the text has other content.
std::optional<std::vector<double>> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0') return std::nullopt;
  }
  return numbers;
}

/// The number of values of a numeric type; 0 for other types.
std::size_t size_of(const std::string& type) {
  if (type == "double") return 1;
  if (type == "vector2d") return 2;
  if (type == "vector3") return 3;
  return 0;
}

std::string joined(const std::vector<double>& numbers) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < numbers.size(); ++i) text << (i > 0 ? " " : "") << numbers[i];
  return text.str();
}

std::string default_of(const sdf::Param& value) {
  const std::string text = value.GetDefaultAsString();
  if (value.GetTypeName() != "bool") return text;
  return text == "1" || text == "true" ? "true" : "false";
}

class ValueCheck {
 public:
  ValueCheck(const std::string& file, LoadContext& reading) : file_(file), reading_(reading) {}

  void check_below(XMLElement& parent, const sdf::ElementPtr& description) {
    for (auto* child = parent.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string name = child->Name();
      if (name == "plugin" || is_own_element(name)) continue;  // they may have any content
      if (const auto known = description_of(description, name)) check(*child, known);
    }
  }

  void check(XMLElement& element, const sdf::ElementPtr& description) {
    if (description->GetValue() != nullptr) check_value(element, *description);
    check_below(element, description);
  }

  bool changed() const { return changed_; }

 private:
  void check_value(XMLElement& element, const sdf::Element& description) {
    const sdf::Param& value = *description.GetValue();
    const std::string& type = value.GetTypeName();
    const std::string text = trimmed(element.GetText() != nullptr ? element.GetText() : "");
    if (type == "string") return check_text(element, description, text);
    if (type == "pose") return check_pose(element, text);
    if (text.empty()) {
      const std::string standard = default_of(value);
      if (standard.empty()) return;
      replace(element, standard);
      return warn(element, "is empty: using the default " + standard);
    }
    const bool bounded = value.GetMinValueAsString().has_value() || value.GetMaxValueAsString().has_value();
    const auto numbers = numbers_in(text);
    const bool fits = numbers && numbers->size() == size_of(type);
    if (fits && replace_unbounded(element, text, *numbers)) return;
    if (fits && !bounded) return;
    if (const auto copy = value.Clone(); copy->SetFromString(text)) return;
    refuse_or_replace(element, description, text, numbers);
  }

  /// Only required elements must not be empty.
  void check_text(XMLElement& element, const sdf::Element& description, const std::string& text) {
    if (!text.empty() || description.GetRequired() != "1") return;
    const std::string name = element.Name();
    replace(element, description.GetValue()->GetDefaultAsString());
    if (name == "uri") return warn(element, "is empty");
    report(element, "<" + name + "> is empty");
  }

  /// Replaces numbers beyond the range of double by infinity or zero. Returns whether there was one.
  bool replace_unbounded(XMLElement& element, const std::string& text, const std::vector<double>& numbers) {
    if (text.find_first_of("eE") == std::string::npos) return false;
    errno = 0;
    std::istringstream words(text);
    for (std::string word; words >> word;) std::strtod(word.c_str(), nullptr);
    if (errno != ERANGE) return false;
    replace(element, joined(numbers));
    warn(element, "is '" + text + "', out of the range of numbers: using " + joined(numbers));
    return true;
  }

  void check_pose(XMLElement& element, const std::string& text) {
    const auto format = [&](const char* name) { return element.Attribute("rotation_format", name) != nullptr; };
    const std::size_t wanted = format("quat_xyzw") ? 7 : 6;
    const auto numbers = numbers_in(text);
    if (text.empty() || (numbers && numbers->size() == wanted)) return;
    std::istringstream words(text);
    std::string word;
    std::size_t found = 0;
    while (words >> word) ++found;
    const std::string named = wanted == 7 ? "seven numbers (x y z qx qy qz qw)" : "six numbers (x y z roll pitch yaw)";
    report(element, "<pose> needs " + named + ", it " +
                        (found != wanted ? "has " + std::to_string(found) + ": '" : "is '") + text + "'");
    replace(element, wanted == 7 ? "0 0 0 0 0 0 1" : "0 0 0 0 0 0");
  }

  void refuse_or_replace(XMLElement& element, const sdf::Element& description, const std::string& text,
                         const std::optional<std::vector<double>>& numbers) {
    const sdf::Param& value = *description.GetValue();
    const std::string& type = value.GetTypeName();
    const std::string name = element.Name();
    if ((name == "mu" || name == "mu2") && numbers && numbers->size() == 1 && numbers->front() < 0) {
      replace(element, "inf");
      return warn(element, "is " + text + ": using infinite friction");
    }
    if (type == "color" && numbers && (numbers->size() == 3 || numbers->size() == 4)) {
      std::vector<double> parts = *numbers;
      for (double& part : parts) part = std::isnan(part) ? 0 : std::clamp(part, 0.0, 1.0);
      replace(element, joined(parts));
      return warn(element, "is '" + text + "', colour values must be from 0 to 1: using " + joined(parts));
    }
    if (type == "bool" && numbers && numbers->size() == 1) {
      const std::string flag = numbers->front() != 0 ? "true" : "false";
      replace(element, flag);
      return warn(element, "is '" + text + "': using " + flag);
    }
    // A default mass would change the motion.
    const bool has_default = description.GetRequired() != "1" && !value.GetDefaultAsString().empty() && name != "mass";
    const std::string standard = default_of(value);
    replace(element, standard);
    // A number out of range shows what was intended.
    if (!has_default || (numbers && numbers->size() == size_of(type))) {
      return report(element, "<" + name + "> has the invalid value '" + text + "' (wrong type or out of range)");
    }
    warn(element, "is '" + text + "', which cannot be read: using the default " + standard);
  }

  void replace(XMLElement& element, const std::string& text) {
    element.SetText(text.c_str());
    changed_ = true;
  }
  void report(const XMLElement& element, std::string message) {
    reading_.report({file_, element.GetLineNum()}, object_path(element), std::move(message));
  }
  void warn(const XMLElement& element, const std::string& message) {
    reading_.warn({file_, element.GetLineNum()}, object_path(element),
                  "<" + std::string(element.Name()) + "> " + message);
  }

  const std::string& file_;
  LoadContext& reading_;
  bool changed_ = false;
};

}  // namespace

bool replace_bad_values(XMLElement& sdf, const std::string& file, LoadContext& reading) {
  ValueCheck check(file, reading);
  check.check_below(sdf, root_description());
  return check.changed();
}

bool replace_bad_values(XMLElement& element, const std::string& parent, const std::string& file, LoadContext& reading) {
  sdf::ElementPtr description = description_below(root_description(), "model");
  if (parent == "link") description = description_below(description, "link");
  const sdf::ElementPtr known = description_below(description, element.Name());
  if (known == nullptr) return false;
  ValueCheck check(file, reading);
  check.check(element, known);
  return check.changed();
}

}  // namespace bubblesim
