// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/frames.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "bubblesim/nearest_names.hpp"

namespace bubblesim {
namespace {

constexpr const char* kModel = "__model__";
constexpr const char* kSeparator = "::";

std::string or_default(std::string text, const std::string& by_default) { return text.empty() ? by_default : text; }

}  // namespace

std::string base_of(const SdfElement& element) {
  const SdfElement pose = element.child("pose");
  return or_default(pose.attribute("relative_to"), pose.attribute("frame"));
}

Frames::Frames(const SdfElement& owner, const std::string& path, LoadContext& context) {
  for (const XmlElement& child : owner.xml().children) {
    const bool is_model = child.name == "model" || child.name == "include";
    if (!is_model && child.name != "link" && child.name != "joint" && child.name != "frame") continue;
    if (owner.kind().child("link") == nullptr && child.name == "joint") continue;  // of a world: not simulated
    const SdfElement element(&child, *owner.kind().child(child.name));
    is_model ? add_model(element, path, context) : add_element(element);
  }
  canonical_link_ = owner.xml().attribute("canonical_link") != nullptr ? *owner.xml().attribute("canonical_link") : "";
  if (!has(canonical_link_)) canonical_link_.clear();  // the check of the scene reports it
  check_bases(path, context);
}

Frames::Frames(const ModelDescription& model) {
  for (const LinkDescription& link : model.links) add(link.name, {link.pose, "", "", true, link.source, false, {}});
  for (const JointDescription& joint : model.joints) {
    if (frames_.count(joint.name) == 0) add(joint.name, {joint.pose, "", joint.child, false, joint.source, false, {}});
  }
  canonical_link_ = model.canonical_link;
}

void Frames::add(const std::string& name, Frame frame) {
  if (frames_.emplace(name, std::move(frame)).second) order_.push_back(name);
}

void Frames::add_element(const SdfElement& element) {
  const std::string kind = element.xml().name;
  Frame frame;
  frame.raw = element.child("pose").as_pose();
  frame.is_link = kind == "link";
  frame.source = element.source();
  if (kind == "joint") frame.attached = element.text("child");
  if (kind == "frame") frame.attached = element.attribute("attached_to");
  frame.base = or_default(base_of(element), frame.attached);
  frame.tolerant =
      kind == "joint" || element.child("pose").has_attribute("frame");  // a joint without child is reported
  if (frame.base == kModel) frame.base.clear();
  add(element.name(), std::move(frame));
}

void Frames::add_model(const SdfElement& model, const std::string& path, LoadContext& context) {
  const std::string name = model.name();
  auto inner = model.xml().name == "include" ? std::make_unique<Frames>(context.included_robots().at(model.text("uri")))
                                             : std::make_unique<Frames>(model, path + "/" + name, context);
  Frame frame;
  frame.raw = model.child("pose").as_pose();
  frame.base = base_of(model);
  frame.source = model.source();
  frame.tolerant = model.child("pose").has_attribute("frame");
  const std::string placed = model.attribute("placement_frame");
  if (!placed.empty() && inner->has(placed)) {
    frame.raw = frame.raw * inner->pose(placed).inverse();
  } else if (!placed.empty()) {
    context.report(model.source(), path + "/" + name,
                   "the placement_frame '" + placed + "' is not a frame of it" + did_you_mean(placed, inner->names()));
  }
  if (frame.base == kModel) frame.base.clear();
  add(name, std::move(frame));
  inner_.emplace(name, std::move(inner));
}

/// Frames that do not exist are replaced by the model, so that the rest can be read.
void Frames::check_bases(const std::string& path, LoadContext& context) {
  for (const std::string& name : order_) {
    Frame& frame = frames_.at(name);
    if (frame.base.empty() || has(frame.base)) continue;
    const std::string message = "is relative to '" + frame.base +
                                "', which is not a link, joint, frame or model there" +
                                did_you_mean(frame.base, names());
    if (!frame.tolerant) context.report(frame.source, path + "/" + name, message);
    if (frame.tolerant && frame.attached != frame.base) {
      context.warn(frame.source, path + "/" + name, message + ": using the model's frame");
    }
    frame.base.clear();
  }
  // A cycle leads back to a frame that was met on the same way.
  std::set<const Frame*> without_cycle;
  for (const std::string& name : order_) {
    std::vector<Frame*> way;
    std::set<const Frame*> met;
    for (Frame* at = &frames_.at(name); at != nullptr && without_cycle.count(at) == 0;) {
      if (!met.insert(at).second) {
        context.report(at->source, path, "the frame '" + name + "' is relative to itself through '" + at->base + "'");
        at->base.clear();
        break;
      }
      way.push_back(at);
      const auto place = locate(at->base);
      at = place && place->frame != nullptr ? &frames_.at(place->name) : nullptr;
    }
    without_cycle.insert(way.begin(), way.end());
  }
}

std::optional<Frames::Place> Frames::locate(const std::string& name) const {
  if (name.empty() || name == kModel || name == "world") return Place{};
  if (const auto found = frames_.find(name); found != frames_.end()) return Place{&found->second, name, ""};
  for (std::size_t at = name.find(kSeparator); at != std::string::npos; at = name.find(kSeparator, at + 2)) {
    const std::string first = name.substr(0, at);
    const std::string rest = name.substr(at + 2);
    const auto inner = inner_.find(first);
    if (inner != inner_.end() && inner->second->has(rest)) return Place{&frames_.at(first), first, rest};
  }
  return std::nullopt;
}

Pose Frames::pose(const std::string& name) const {
  struct Step {
    const Frame* frame;
    Pose further;  // from the frame to the one in its nested model
  };
  std::vector<Step> way;
  Pose pose;
  for (std::string at = name;;) {
    const auto place = locate(at);
    if (!place || place->frame == nullptr) break;
    way.push_back({place->frame, place->rest.empty() ? Pose() : inner_.at(place->name)->pose(place->rest)});
    if (place->frame->resolved) break;
    at = place->frame->base;
  }
  for (auto step = way.rbegin(); step != way.rend(); ++step) {
    if (!step->frame->resolved) step->frame->resolved = pose * step->frame->raw;
    pose = *step->frame->resolved * step->further;
  }
  return pose;
}

Pose Frames::pose_of(const SdfElement& element, const std::string& carrier, const std::string& path,
                     LoadContext& context) const {
  const Pose raw = element.child("pose").as_pose();
  const std::string base = base_of(element);
  if (base.empty() || base == carrier) return raw;
  if (has(base)) return pose(carrier).inverse() * pose(base) * raw;
  const std::string message =
      "is relative to '" + base + "', which is not a link, joint, frame or model there" + did_you_mean(base, names());
  if (element.child("pose").has_attribute("frame")) {
    context.warn(element.source(), path, message + ": using the default frame");
  } else {
    context.report(element.source(), path, message);
  }
  return raw;
}

std::string Frames::link_of(const std::string& name) const { return link_of(name, frames_.size() + 1); }

std::string Frames::link_of(const std::string& name, std::size_t steps) const {
  if (steps == 0) return "";  // a cycle
  const auto place = locate(name);
  if (!place) return "";
  if (place->frame == nullptr) {
    if (!canonical_link_.empty()) return link_of(canonical_link_, steps - 1);
    for (const std::string& each : order_) {
      if (frames_.at(each).is_link) return each;
    }
    for (const std::string& each : order_) {
      if (inner_.count(each) > 0) return link_of(each, steps - 1);
    }
    return "";
  }
  if (const auto inner = inner_.find(place->name); inner != inner_.end()) {
    const std::string link = inner->second->link_of(place->rest);
    return link.empty() ? "" : place->name + kSeparator + link;
  }
  return place->frame->is_link ? place->name : link_of(place->frame->attached, steps - 1);
}

std::vector<std::string> Frames::names() const {
  std::vector<std::string> all = order_;
  for (const auto& [name, inner] : inner_) {
    for (const std::string& each : inner->names()) all.push_back(name + kSeparator + each);
  }
  return all;
}

}  // namespace bubblesim
