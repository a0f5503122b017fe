// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/check_values.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// The elements of bubblesim that may occur several times in their parent.
constexpr std::string_view kRepeated[] = {"bubblesim:randomize", "bubblesim:object", "bubblesim:collection"};

bool is_repeated(std::string_view name) {
  return std::find(std::begin(kRepeated), std::end(kRepeated), name) != std::end(kRepeated);
}

std::optional<std::vector<double>> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  if (!read_numbers(text, numbers)) return std::nullopt;
  return numbers;
}

/// The count of numbers in a value; 0 for other types.
std::size_t size_of(ValueType type) {
  switch (type) {
    case ValueType::kNumber:
    case ValueType::kInteger:
      return 1;
    case ValueType::kVector2:
      return 2;
    case ValueType::kVector3:
      return 3;
    default:
      return 0;
  }
}

std::size_t count_words(const std::string& text) {
  std::istringstream words(text);
  std::string word;
  std::size_t found = 0;
  while (words >> word) ++found;
  return found;
}

/// The end of a message about a value such as 0,5; else empty.
std::string with_comma(const std::string& text) {
  const auto is_digit = [&](std::size_t at) { return std::isdigit(static_cast<unsigned char>(text[at])) != 0; };
  for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', comma + 1)) {
    if (comma > 0 && comma + 1 < text.size() && is_digit(comma - 1) && is_digit(comma + 1)) {
      return "; numbers have a decimal point, as 0.5, and spaces between them";
    }
  }
  return {};
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Checks the value of one element.
class ValueCheck {
 public:
  ValueCheck(XmlElement& element, const ElementKind& kind, const std::string& path, LoadContext& context)
      : element_(element), kind_(kind), path_(path), context_(context) {}

  void check() {
    switch (kind_.type) {
      case ValueType::kNone:
      case ValueType::kAny:
        return;
      case ValueType::kText:
        return check_text();
      case ValueType::kPose:
        return check_pose();
      default:
        break;
    }
    if (element_.text.empty()) {
      if (kind_.default_text.empty()) return;
      replace(kind_.default_text);
      return warn("is empty: using the default " + kind_.default_text);
    }
    if (kind_.type == ValueType::kFlag) return check_flag();
    if (kind_.type == ValueType::kColor) return check_color();
    check_numbers();
  }

 private:
  /// Only required strings must not be empty. Some files have three slashes after model: or package:.
  void check_text() {
    for (const std::string scheme : {"model://", "package://"}) {
      if (element_.name != "uri" || element_.text.rfind(scheme + "/", 0) != 0) continue;
      const std::size_t start = std::min(element_.text.find_first_not_of('/', scheme.size()), element_.text.size());
      const std::string fixed = scheme + element_.text.substr(start);
      warn("is '" + element_.text + "': using " + fixed);
      return replace(fixed);
    }
    if (!element_.text.empty() || !kind_.required) return;
    if (element_.name == "uri") return warn("is empty");
    report("is empty");
  }

  void check_pose() {
    const std::string* format = element_.attribute("rotation_format");
    const std::size_t wanted = format != nullptr && *format == "quat_xyzw" ? 7 : 6;
    const auto numbers = numbers_in(element_.text);
    if (element_.text.empty() || (numbers && numbers->size() == wanted)) return;
    const std::string named = wanted == 7 ? "seven numbers (x y z qx qy qz qw)" : "six numbers (x y z roll pitch yaw)";
    const std::size_t found = count_words(element_.text);
    report("needs " + named + ", it " + (found != wanted ? "has " + std::to_string(found) + ": '" : "is '") +
           element_.text + "'");
    replace(wanted == 7 ? "0 0 0 0 0 0 1" : "0 0 0 0 0 0");
  }

  void check_flag() {
    const std::string word = lower(element_.text);
    if (word == "true" || word == "1") return replace("true");
    if (word == "false" || word == "0") return replace("false");
    const auto numbers = numbers_in(element_.text);
    if (!numbers || numbers->size() != 1) return refuse_or_use_default(false);
    const std::string flag = numbers->front() != 0 ? "true" : "false";
    warn("is '" + element_.text + "': using " + flag);
    replace(flag);
  }

  void check_color() {
    const auto numbers = numbers_in(element_.text);
    if (!numbers || (numbers->size() != 3 && numbers->size() != 4)) return refuse_or_use_default(false);
    std::vector<double> parts = *numbers;
    for (double& part : parts) part = std::isnan(part) ? 0 : std::clamp(part, 0.0, 1.0);
    if (parts == *numbers) return;
    warn("is '" + element_.text + "', colour values must be from 0 to 1: using " + write_numbers(parts));
    replace(write_numbers(parts));
  }

  void check_numbers() {
    const auto numbers = numbers_in(element_.text);
    const std::size_t wanted = size_of(kind_.type);
    if (numbers && wanted == 3 && numbers->size() == 1 && element_.name == "scale") {
      const std::string all = write_numbers({numbers->front(), numbers->front(), numbers->front()});
      warn("is '" + element_.text + "': using " + all);
      return replace(all);
    }
    if (!numbers || numbers->size() != wanted) return use_leading_numbers(wanted);
    if (replace_unbounded(*numbers)) return;
    if (wanted > 1) {
      if (std::any_of(numbers->begin(), numbers->end(), [](double number) { return std::isnan(number); })) {
        refuse_or_use_default(true);
      }
      return;
    }
    const double number = numbers->front();
    if ((element_.name == "mu" || element_.name == "mu2") && number < 0) {
      warn("is " + element_.text + ": using infinite friction");
      return replace("inf");
    }
    const bool is_bounded = std::isfinite(kind_.min) || std::isfinite(kind_.max);
    if (is_bounded && !(number >= kind_.min && number <= kind_.max)) refuse_or_use_default(true);
  }

  /// Like Gazebo: 2 of "2 kg".
  void use_leading_numbers(std::size_t wanted) {
    std::vector<double> numbers;
    read_numbers(element_.text, numbers);
    if (numbers.size() < wanted) return refuse_or_use_default(false);
    numbers.resize(wanted);
    warn("is '" + element_.text + "': using " + write_numbers(numbers) + with_comma(element_.text));
    replace(write_numbers(numbers));
  }

  /// Replaces numbers beyond the range of double by infinity or zero. Returns whether there was one.
  bool replace_unbounded(const std::vector<double>& numbers) {
    if (element_.text.find_first_of("eE") == std::string::npos) return false;
    errno = 0;
    std::istringstream words(element_.text);
    for (std::string word; words >> word;) std::strtod(word.c_str(), nullptr);
    if (errno != ERANGE) return false;
    warn("is '" + element_.text + "', out of the range of numbers: using " + write_numbers(numbers));
    replace(write_numbers(numbers));
    return true;
  }

  /// A number out of range shows what was intended, so the default would be wrong.
  void refuse_or_use_default(bool shows_intention) {
    const std::string given = element_.text;
    replace(kind_.default_text);
    if (kind_.required || kind_.default_text.empty() || shows_intention) {
      return report("has the invalid value '" + given + "': it must be " + wanted_value() + with_comma(given));
    }
    warn("is '" + given + "', which cannot be read: using the default " + kind_.default_text);
  }

  std::string wanted_value() const {
    switch (kind_.type) {
      case ValueType::kFlag:
        return "true or false";
      case ValueType::kColor:
        return "three or four numbers from 0 to 1";
      case ValueType::kVector2:
        return "two numbers, separated by spaces";
      case ValueType::kVector3:
        return "three numbers, separated by spaces";
      default:
        break;
    }
    const std::string kind = kind_.type == ValueType::kInteger ? "a whole number" : "a number";
    if (std::isfinite(kind_.min) && std::isfinite(kind_.max)) {
      return kind + " from " + write_numbers({kind_.min}) + " to " + write_numbers({kind_.max});
    }
    if (std::isfinite(kind_.min)) return kind + ", at least " + write_numbers({kind_.min});
    return std::isfinite(kind_.max) ? kind + ", at most " + write_numbers({kind_.max}) : kind;
  }

  void replace(const std::string& text) { element_.text = text; }
  void report(const std::string& message) {
    context_.report(element_.source(), path_, "<" + element_.name + "> " + message);
  }
  void warn(const std::string& message) {
    context_.warn(element_.source(), path_, "<" + element_.name + "> " + message);
  }

  XmlElement& element_;
  const ElementKind& kind_;
  const std::string& path_;
  LoadContext& context_;
};

/// An element of bubblesim that its parent must not have.
std::string own_problem(const XmlElement& element, const XmlElement& parent) {
  const std::vector<std::string> parents = parents_of_own(element.name);
  if (parents.empty()) return "unknown element <" + element.name + ">" + did_you_mean(element.name, own_elements());
  return "<" + element.name + "> is not allowed in <" + parent.name + ">, it belongs in <" + parents.front() + ">";
}

std::vector<std::string> names_of_children(const ElementKind& kind) {
  std::vector<std::string> names;
  for (const ElementKind* child : kind.children) names.push_back(child->name);
  return names;
}

/// Flags and numbers are left out where they have another value than the default.
bool asks_for_something(const XmlElement& element, const ElementKind& kind) {
  return kind.type == ValueType::kNone || kind.type == ValueType::kAny || element.text != kind.default_text;
}

std::string path_of(const XmlElement& element, const std::string& parent_path) {
  if (element.name == "world" || element.given_name().empty()) return parent_path;
  return parent_path + "/" + element.given_name();
}

}  // namespace

void check_values(XmlElement& element, const ElementKind& kind, const std::string& path, LoadContext& context) {
  ValueCheck(element, kind, path, context).check();
  if (kind.type == ValueType::kAny) return;
  for (XmlElement& child : element.children) {
    const ElementKind* known = kind.child(child.name);
    const std::string child_path = path_of(child, path);
    if (is_own_element(child.name)) {
      if (known == nullptr) {
        context.report(child.source(), path, own_problem(child, element));
      } else if (!is_repeated(child.name) && element.child(child.name) != &child) {
        context.report(child.source(), path, "<" + child.name + "> occurs twice");
      }
      continue;
    }
    if (known == nullptr) {
      // Elements with a prefix are those of other programs.
      if (child.name.find(':') != std::string::npos) continue;
      context.warn(child.source(), path,
                   "<" + child.name + "> is not an element of <" + element.name + ">: ignored" +
                       did_you_mean(child.name, names_of_children(kind)));
      continue;
    }
    check_values(child, *known, child_path, context);
    if (known->effect == Effect::kLeftOut && asks_for_something(child, *known)) {
      context.warn(child.source(), child_path, "<" + child.name + "> is ignored: " + known->reason);
    }
  }
}

}  // namespace bubblesim
