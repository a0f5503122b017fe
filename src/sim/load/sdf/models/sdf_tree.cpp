// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_tree.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"

namespace bubblesim {
namespace {

constexpr const char* kPlace = "bubblesim:place";
constexpr const char* kObject = "bubblesim:object";
constexpr FrameKind kKinds[] = {FrameKind::kDummy, FrameKind::kShape,  FrameKind::kCamera, FrameKind::kLight,
                                FrameKind::kGraph, FrameKind::kScript, FrameKind::kJoint};
constexpr double kNoLimit = 1e15;  // SDFormat has +-1e16

FrameKind read_kind(const SdfElement& object, const std::string& path, LoadContext& context) {
  const std::string given = object.text("kind");
  std::vector<std::string> known;
  for (const FrameKind kind : kKinds) {
    known.emplace_back(frame_kind_name(kind));
    if (given == known.back()) return kind;
  }
  context.report(object.source("kind"), path,
                 "<kind> is '" + given + "', it must be " + joined(known, " or ") + did_you_mean(given, known));
  return FrameKind::kDummy;
}

/// The bytes of a string in base64; signs that are not of base64 are skipped.
std::string from_base64(const std::string& text) {
  static const std::string kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char sign : text) {
    const std::size_t value = kSigns.find(sign);
    if (value == std::string::npos) continue;
    bits = (bits << 6U | static_cast<unsigned>(value)) & 0xffffU;
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU));
  }
  return bytes;
}

/// The joint of an object without physics.
void read_joint(const SdfElement& object, const std::string& path, LoadContext& context, FrameDescription& frame) {
  const SdfElement element = object.child("joint");
  JointDescription joint;
  joint.name = frame.name;
  joint.source = frame.source;
  joint.type = element.attribute("type");
  joint.screw_lead = element.number("screw_thread_pitch");
  const std::vector<std::string> known = {"revolute", "continuous", "prismatic", "screw", "ball"};
  if (std::find(known.begin(), known.end(), joint.type) == known.end()) {
    context.report(element.source(), path,
                   "the joint's type is '" + joint.type + "', it must be " + joined(known, " or ") +
                       did_you_mean(joint.type, known));
  }
  if (joint.type == "ball") {
    frame.joint = std::move(joint);
    return;
  }
  AxisDescription axis;
  if (const double lower = element.number("lower"); lower > -kNoLimit) axis.lower = lower;
  if (const double upper = element.number("upper"); upper < kNoLimit) axis.upper = upper;
  if (const SdfElement mimic = element.child("mimic")) {
    axis.mimic = MimicDescription{mimic.attribute("joint"), 0, mimic.number("multiplier"), mimic.number("offset"), 0};
  }
  joint.axes.push_back(axis);
  frame.joint_position = element.number("position");
  frame.joint = std::move(joint);
}

}  // namespace

std::optional<TreePlace> read_place(const SdfElement& element) {
  if (!element.has(kPlace)) return std::nullopt;
  const SdfElement place = element.child(kPlace);
  TreePlace read{static_cast<int>(place.number("id")), static_cast<int>(place.number("parent")),
                 static_cast<int>(place.number("order")), place.flag("model")};
  if (const std::string script = place.text("script"); !script.empty()) {
    read.child_script = std::filesystem::path(element.source().file).parent_path() / script;
  }
  read.old_name = place.text("old_name");
  for (const SdfElement& parameter : place.children("parameter")) {
    read.parameters.push_back({parameter.name(), parameter.attribute("unit"), parameter.as_text()});
  }
  for (const SdfElement& data : place.children("data")) read.data[data.name()] = from_base64(data.as_text());
  return read;
}

std::vector<FrameDescription> read_objects(const SdfElement& owner, const std::string& path, LoadContext& context) {
  std::vector<FrameDescription> frames;
  for (const SdfElement& object : owner.children(kObject)) {
    const std::string of_object = path + "/" + object.name();
    FrameDescription frame;
    frame.name = object.name();
    frame.alias = read_alias(object, of_object, context);
    frame.kind = read_kind(object, of_object, context);
    frame.link = object.text("link");
    frame.pose = object.child("pose").as_pose();
    frame.source = object.source();
    if (frame.kind == FrameKind::kJoint) read_joint(object, of_object, context, frame);
    frame.place = read_place(object);
    if (frame.name.empty()) context.report(frame.source, path, "<bubblesim:object> has no name");
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::vector<CollectionDescription> read_collections(const SdfElement& world, LoadContext& context) {
  const std::vector<std::string> known = {"object", "tree", "chain", "all"};
  std::vector<CollectionDescription> collections;
  for (const SdfElement& element : world.children("bubblesim:collection")) {
    CollectionDescription collection{element.name(), {}};
    for (const SdfElement& item : element.children("item")) {
      const std::string what = item.text("what");
      const auto found = std::find(known.begin(), known.end(), what);
      if (found == known.end()) {
        context.report(item.source("what"), "",
                       "<what> is '" + what + "', it must be " + joined(known, " or ") + did_you_mean(what, known));
        continue;
      }
      collection.items.push_back({static_cast<CollectionDescription::What>(found - known.begin()),
                                  static_cast<int>(item.number("id")), item.flag("removes")});
    }
    collections.push_back(std::move(collection));
  }
  return collections;
}

}  // namespace bubblesim
