// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/main_script.hpp"

#include <algorithm>
#include <cctype>

namespace bubblesim::ttt {
namespace {

/// Of default main scripts of V2.6 to V4.10, without `sim.`: they call scripts, physics and sensors, or ask for the
/// time.
const std::set<std::string>& phases() {
  static const std::set<std::string> names = {"handleSimulationStart",
                                              "handleSensingStart",
                                              "handleDynamics",
                                              "handleChildScript",
                                              "handleChildScripts",
                                              "handleMainScript",
                                              "handleCustomizationScripts",
                                              "handleAddOnScripts",
                                              "handleSandboxScript",
                                              "handleSimulationScripts",
                                              "handleEmbeddedScripts",
                                              "handleExtCalls",
                                              "handleModule",
                                              "handleMechanism",
                                              "handleIkGroup",
                                              "handleJoint",
                                              "handleJointMotion",
                                              "handlePath",
                                              "handleMill",
                                              "handleCollision",
                                              "handleDistance",
                                              "handleProximitySensor",
                                              "handleVisionSensor",
                                              "handleGraph",
                                              "handleVarious",
                                              "openModule",
                                              "closeModule",
                                              "resumeThreads",
                                              "launchThreadedChildScripts",
                                              "resetCollision",
                                              "resetDistance",
                                              "resetGraph",
                                              "resetMill",
                                              "resetMilling",
                                              "resetProximitySensor",
                                              "resetVisionSensor",
                                              "getScriptExecutionCount",
                                              "getSimulationState",
                                              "getSimulationTime",
                                              "getSimulationTimeStep"};
  return names;
}

bool is_of_name(char sign) { return std::isalnum(static_cast<unsigned char>(sign)) != 0 || sign == '_'; }

/// The place after a comment that begins here; the same place if none does.
std::size_t after_comment(const std::string& text, std::size_t i) {
  if (text.compare(i, 2, "--") != 0) return i;
  const bool is_long = text.compare(i, 4, "--[[") == 0;
  const std::size_t end = is_long ? text.find("]]", i) : text.find('\n', i);
  return end == std::string::npos ? text.size() : end + (is_long ? 2 : 1);
}

/// `sim.setX` of `sim.setX` and `simSetX`; empty for names that are not of the API.
std::string function_of(const std::string& name) {
  if (name.compare(0, 3, "sim") != 0 || name.size() < 5) return {};
  if (name[3] == '.') return name;
  if (std::isupper(static_cast<unsigned char>(name[3])) == 0) return {};
  const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(name[3])));
  return name.find('.') == std::string::npos ? "sim." + std::string(1, lower) + name.substr(4) : name;
}

}  // namespace

std::set<std::string> calls_beside_phases(const std::string& text) {
  std::set<std::string> calls;
  for (std::size_t i = 0; i < text.size();) {
    if (const std::size_t after = after_comment(text, i); after != i) {
      i = after;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && (is_of_name(text[end]) || (text[end] == '.' && end > i))) ++end;
    const std::size_t next = text.find_first_not_of(" \t", end);
    if (end > i && next != std::string::npos && text[next] == '(') {
      const std::string function = function_of(text.substr(i, end - i));
      if (!function.empty() && phases().count(function.substr(4)) == 0) calls.insert(function);
    }
    i = std::max(end, i + 1);
  }
  return calls;
}

}  // namespace bubblesim::ttt
