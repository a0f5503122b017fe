// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/frame_work.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace bubblesim {
namespace {

using tinyxml2::XMLElement;

// Each limit takes some seconds: many frames do not fit into the processor's cache, a chain does.
constexpr std::uint64_t kMostFrames = 10'000;
constexpr std::uint64_t kMostComparisons = 2'000'000'000;

/// The frame that a frame's pose is relative to: by name, empty for the model.
using Bases = std::unordered_map<std::string_view, std::string_view>;

std::string_view or_empty(const char* found) { return found != nullptr ? std::string_view(found) : std::string_view(); }

void add_sdf(const XMLElement& element, Bases& bases) {
  const auto* pose = element.FirstChildElement("pose");
  std::string_view base = or_empty(pose != nullptr ? pose->Attribute("relative_to") : nullptr);
  const auto* child = std::string_view(element.Name()) == "joint" ? element.FirstChildElement("child") : nullptr;
  if (base.empty() && child != nullptr) base = or_empty(child->GetText());
  bases.emplace(or_empty(element.Attribute("name")), base);
}

/// A joint's pose is relative to its parent, and that of its child to the joint.
void add_urdf(const XMLElement& element, Bases& bases) {
  if (std::string_view(element.Name()) != "joint") return;
  const std::string_view name = or_empty(element.Attribute("name"));
  const auto* parent = element.FirstChildElement("parent");
  const auto* child = element.FirstChildElement("child");
  bases.emplace(name, or_empty(parent != nullptr ? parent->Attribute("link") : nullptr));
  bases.emplace(or_empty(child != nullptr ? child->Attribute("link") : nullptr), name);
}

/// The number of steps from all frames to the model.
std::uint64_t all_steps(const Bases& bases) {
  std::unordered_map<std::string_view, std::uint64_t> steps;
  std::uint64_t sum = 0;
  for (const auto& start : bases) {
    std::vector<std::string_view> way;
    std::string_view at = start.first;
    while (!at.empty() && steps.count(at) == 0 && way.size() <= bases.size()) {  // also ends in a cycle
      way.push_back(at);
      const auto found = bases.find(at);
      at = found != bases.end() ? found->second : std::string_view();
    }
    std::uint64_t length = at.empty() || steps.count(at) == 0 ? 0 : steps[at];
    for (auto frame = way.rbegin(); frame != way.rend(); ++frame) steps[*frame] = ++length;
    sum += steps[start.first];
  }
  return sum;
}

}  // namespace

std::string frame_work_problem(const XMLElement& model) {
  const std::string_view kind = model.Name();
  if (kind != "model" && kind != "robot") return {};
  Bases bases;
  std::uint64_t frames = 0;
  for (const auto* element = model.FirstChildElement(); element != nullptr; element = element->NextSiblingElement()) {
    const std::string_view name = element->Name();
    if (name != "link" && name != "joint" && name != "frame" && name != "model") continue;
    ++frames;
    kind == "robot" ? add_urdf(*element, bases) : add_sdf(*element, bases);
  }
  if (frames <= kMostFrames && frames * all_steps(bases) <= kMostComparisons) return {};
  return "has " + std::to_string(frames) +
         " links, joints and frames, too many for their chains of relative poses: SDFormat would take minutes to "
         "resolve them; divide the model, or give the poses relative to the model";
}

}  // namespace bubblesim
