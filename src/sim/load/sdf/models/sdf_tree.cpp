// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_tree.hpp"

#include <string>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/models/sdf_names_and_axes.hpp"

namespace bubblesim {
namespace {

constexpr const char* kPlace = "bubblesim:place";
constexpr const char* kObject = "bubblesim:object";
constexpr FrameKind kKinds[] = {FrameKind::kDummy, FrameKind::kShape, FrameKind::kCamera,
                                FrameKind::kLight, FrameKind::kGraph, FrameKind::kScript};

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

}  // namespace

std::optional<TreePlace> read_place(const SdfElement& element) {
  if (!element.has(kPlace)) return std::nullopt;
  const SdfElement place = element.child(kPlace);
  TreePlace read{static_cast<int>(place.number("id")), static_cast<int>(place.number("parent")),
                 static_cast<int>(place.number("order")), place.flag("model")};
  if (const std::string script = place.text("script"); !script.empty()) {
    read.child_script = std::filesystem::path(element.source().file).parent_path() / script;
  }
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
    frame.place = read_place(object);
    if (frame.name.empty()) context.report(frame.source, path, "<bubblesim:object> has no name");
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace bubblesim
