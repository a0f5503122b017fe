// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf_extensions.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "bubblesim/nearest_names.hpp"

namespace bubblesim {
namespace {

constexpr const char* kPrefix = "bubblesim:";

struct OwnElement {
  const char* name;
  std::vector<std::string> parents;
};

const std::vector<OwnElement>& sdf_extensions() {
  static const std::vector<OwnElement> elements = {
      {"bubblesim:time_step", {"world"}},                                    // seconds of one simulation step
      {"bubblesim:substeps", {"physics"}},                                   // number for each <max_step_size>, or auto
      {"bubblesim:bandwidth", {"imu", "force_torque"}},                      // Hz
      {"bubblesim:alias", {"model", "include", "link", "joint", "sensor"}},  // name in paths
      {"bubblesim:axis_convention", {"world", "model", "include"}},          // sdformat or coppeliasim
      {"bubblesim:child_script", {"model", "include"}},                      // file beside the scene
      {"bubblesim:motor", {"axis", "axis2"}},                                // velocity, position or effort
      {"bubblesim:mimic", {"axis", "axis2"}},                                // as <mimic> of SDFormat 1.11
      {"bubblesim:on_divergence", {"world"}},                                // pause, reset or remove
      {kRandomize, {"world"}},                                               // see sdf_randomize.hpp; several
      {"bubblesim:volume", {"sonar"}},                                       // ray, cone, pyramid, disc or cylinder
      {"bubblesim:antialias", {"camera"}},                                   // true or false
      {"bubblesim:topic", {"sensor"}},                                       // name of a ROS topic
      {"bubblesim:frame", {"sensor"}},                                       // frame_id of its messages
      {"bubblesim:signal", {"lidar", "ray"}},                                // name of a string signal with the points
      {"bubblesim:convex", {"collision"}},                                   // hull, parts or none
      {"bubblesim:rolling", {"friction"}},                                   // metres
      {"bubblesim:checker_size", {"material"}},                              // metres
      {"bubblesim:checker_color", {"material"}},                             // red, green and blue
  };
  return elements;
}

/// `/Model/joint` from the names of an element's ancestors.
std::string object_path(sdf::ElementPtr element) {
  std::string path;
  for (; element != nullptr; element = element->GetParent()) {
    const std::string kind = element->GetName();
    if (kind == "world" || kind == "sdf") break;
    if (element->GetAttributeSet("name")) path = "/" + element->GetAttribute("name")->GetAsString() + path;
  }
  return path;
}

sdf::ElementPtr own_child(const sdf::ElementPtr& parent, const std::string& name) {
  for (sdf::ElementPtr child = parent->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    if (child->GetName() == name) return child;
  }
  return nullptr;
}

void check_element(const sdf::ElementPtr& element, std::vector<Problem>& problems) {
  const std::string name = element->GetName();
  const auto report = [&](const std::string& message) {
    problems.push_back({element->FilePath(), element->LineNumber().value_or(0), object_path(element), message});
  };
  std::vector<std::string> known;
  for (const OwnElement& own : sdf_extensions()) {
    known.emplace_back(own.name);
    if (name != own.name) continue;
    const std::string parent = element->GetParent() ? element->GetParent()->GetName() : "";
    if (std::find(own.parents.begin(), own.parents.end(), parent) == own.parents.end()) {
      report("<" + name + "> is not allowed in <" + parent + ">, it belongs in <" + own.parents.front() + ">");
    } else if (name != kRandomize && own_child(element->GetParent(), name) != element) {
      report("<" + name + "> occurs twice");
    }
    return;
  }
  report("unknown element <" + name + ">" + did_you_mean(name, known));
}

void report_text(const sdf::ElementPtr& element, const std::string& text, const std::string& wanted,
                 std::vector<Problem>& problems) {
  problems.push_back({element->FilePath(), element->LineNumber().value_or(0), object_path(element),
                      "<" + element->GetName() + "> is '" + text + "', it must be " + wanted});
}

}  // namespace

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::optional<std::vector<double>> to_numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    double number = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
    if (parsed.ec != std::errc() || parsed.ptr != word.data() + word.size()) return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

bool is_own_element(const std::string& name) { return name.rfind(kPrefix, 0) == 0; }

void check_own_elements(const sdf::ElementPtr& root, std::vector<Problem>& problems) {
  for (sdf::ElementPtr child = root->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    if (is_own_element(child->GetName())) check_element(child, problems);
    check_own_elements(child, problems);
  }
}

std::optional<std::string> own_text(const sdf::ElementPtr& parent, const std::string& name) {
  const sdf::ElementPtr child = own_child(parent, name);
  if (child == nullptr) return std::nullopt;
  return trimmed(child->Get<std::string>());
}

std::optional<double> own_number(const sdf::ElementPtr& parent, const std::string& name,
                                 std::vector<Problem>& problems) {
  const std::optional<std::string> text = own_text(parent, name);
  if (!text) return std::nullopt;
  const std::optional<std::vector<double>> numbers = to_numbers(*text);
  if (numbers && numbers->size() == 1) return numbers->front();
  report_text(own_child(parent, name), *text, "a number", problems);
  return std::nullopt;
}

std::optional<Vector3> own_vector(const sdf::ElementPtr& parent, const std::string& name,
                                  std::vector<Problem>& problems) {
  const std::optional<std::string> text = own_text(parent, name);
  if (!text) return std::nullopt;
  const std::optional<std::vector<double>> numbers = to_numbers(*text);
  if (numbers && numbers->size() == 3) return Vector3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  report_text(own_child(parent, name), *text, "three numbers", problems);
  return std::nullopt;
}

}  // namespace bubblesim
