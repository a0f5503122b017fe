// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/documents/documents.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "files/file_text.hpp"
#include "load/converted_scene.hpp"
#include "load/find/model_folders.hpp"
#include "load/sdf/documents/unique_names.hpp"
#include "load/sdf/documents/upgrade.hpp"
#include "load/sdf/elements/check_values.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/urdf/urdf_model.hpp"
#include "load/xml/xml_parser.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMegabyte = 1ULL << 20U;
constexpr std::uint64_t kLargestFile = 100 * kMegabyte;
constexpr std::size_t kMostElements = 1'000'000;
constexpr std::size_t kDeepestInclude = 20;

[[noreturn]] void fail(const Source& source, const std::string& message) {
  throw SceneError({{source.file, source.line, "", message}});
}

/// The file of a document as the <include>s of others name it; the name of a string without a file stays.
std::string canonical(const std::string& file) {
  std::error_code not_a_file;
  const fs::path found = fs::canonical(file, not_a_file);
  return not_a_file ? file : found.string();
}

/// The file that a model.config names for the newest version of SDFormat.
std::string file_for_newest_version(const XmlElement& config) {
  std::string newest;
  double newest_version = -1;
  for (const XmlElement& sdf : config.children) {
    if (sdf.name != "sdf" || sdf.text.empty()) continue;
    const std::string* text = sdf.attribute("version");
    const double version =
        text != nullptr ? std::strtod(text->c_str() + std::min<std::size_t>(2, text->size()), nullptr) : 0;
    if (version <= newest_version) continue;
    newest_version = version;
    newest = sdf.text;
  }
  return newest;
}

/// The first child that an <include> can stand for.
const XmlElement* included_part(const XmlElement& root) {
  for (const char* kind : {"model", "actor", "light"}) {
    if (const XmlElement* found = root.child(kind)) return found;
  }
  return nullptr;
}

/// The attributes that an <include> gives to a model.
void set_attributes_by(const XmlElement& include, XmlElement& model) {
  for (const char* name : {"name", "placement_frame"}) {
    if (!include.child_text(name).empty()) model.set_attribute(name, include.child_text(name));
  }
}

/// What an <include> changes of a model.
void override_by(const XmlElement& include, XmlElement& model) {
  set_attributes_by(include, model);
  for (const XmlElement& child : include.children) {
    if (child.name == "plugin") model.children.push_back(child);
    if (child.name == "pose" || child.name == "static" || is_own_element(child.name)) model.replace_child(child);
  }
  // Scripts do not see such a model itself: its name is that of the object at its top.
  const bool is_object =
      model.child("bubblesim:is_object") == nullptr || is_true(model.child_text("bubblesim:is_object"));
  const std::string& name = include.child_text("name");
  if (!is_object && !name.empty() && include.child("bubblesim:alias") == nullptr) {
    model.add_child("bubblesim:alias", name);
  }
}

}  // namespace

XmlElement Documents::read(const std::string& text, const std::string& file) {
  XmlElement root = parse_xml(text, file, context_.warnings());
  elements_ += count_elements(root);
  if (root.name == "robot") return root;
  // <gazebo> is the name of <sdf> before version 1.3.
  if (root.name != "sdf" && root.name != "gazebo") {
    fail(root.source(), "is not an SDFormat file: the root element is <" + root.name + ">, expected <sdf>");
  }
  open_.push_back(canonical(file));
  prepare(root);
  open_.pop_back();
  return root;
}

void Documents::prepare(XmlElement& sdf) {
  upgrade(sdf, context_);
  check_values(sdf, sdf_kind(), "", context_);
  expand_includes(sdf, "");
  make_names_unique(sdf, "", context_);
}

void Documents::expand_includes(XmlElement& parent, const std::string& path) {
  const auto has_models = [](const XmlElement& child) {
    return child.name == "world" || child.name == "model" || child.name == "include";
  };
  if (std::none_of(parent.children.begin(), parent.children.end(), has_models)) return;  // most models
  std::vector<XmlElement> expanded;
  std::vector<Source> places;
  for (XmlElement& child : parent.children) {
    const Source place = child.source();
    if (child.name == "world") expand_includes(child, path);
    if (child.name == "model") expand_includes(child, path + "/" + child.given_name());
    if (child.name == "include" && is_foreign_scene(child.child_text("uri"))) {
      expanded.push_back(foreign(child, parent));
    } else if (child.name == "include") {
      expand(child, expanded);
    } else {
      expanded.push_back(std::move(child));
    }
    places.resize(expanded.size(), place);
  }
  parent.children = std::move(expanded);
  if (parent.name != "sdf") number_models(parent.children, places, path, context_);
}

void Documents::expand(const XmlElement& include, std::vector<XmlElement>& into) {
  const Included* found = find(include);
  if (found == nullptr) return;
  elements_ += found->elements;
  if (elements_ > kMostElements) {
    fail(include.source(),
         "too many elements: more than " + std::to_string(kMostElements) + ", including those of all included files");
  }
  if (found->model.name == "robot") {
    XmlElement robot = include;
    robot.set_attribute("name", found->model.given_name());
    set_attributes_by(include, robot);
    robot.child("uri")->text = *found->model.file;
    into.push_back(std::move(robot));
    return;
  }
  const std::string* merges = include.attribute("merge");
  if (merges != nullptr && is_true(*merges)) return merge(include, found->model, into);
  into.push_back(found->model);
  override_by(include, into.back());
}

XmlElement Documents::foreign(const XmlElement& include, const XmlElement& parent) {
  const std::string& uri = include.child_text("uri");
  if (parent.name != "world") {
    fail(include.source(), "includes " + uri + ", a file of CoppeliaSim, in a model: include it in the <world>");
  }
  const fs::path file = file_of(uri, include);
  if (file.empty()) {
    fail(include.source(), "includes " + uri + ", which does not exist" + context_.where_models_are(uri));
  }
  XmlElement left = include;
  left.name = kForeignInclude;
  left.set_attribute("name", include.child_text("name").empty() ? file.stem().string() : include.child_text("name"));
  left.child("uri")->text = file.string();
  return left;
}

/// The parts of the model become parts of the including one. Their poses are relative to a frame that takes the place
/// of the model.
void Documents::merge(const XmlElement& include, const XmlElement& given, std::vector<XmlElement>& into) {
  XmlElement model = given;
  override_by(include, model);
  const std::string frame_name = "_merged__" + model.given_name() + "__model__";
  XmlElement frame = include;
  frame.name = "frame";
  frame.attributes = {{"name", frame_name}};
  frame.children.clear();
  if (const XmlElement* pose = model.child("pose")) frame.children.push_back(*pose);
  into.push_back(std::move(frame));
  const auto is_of_model = [](const std::string* name) {
    return name == nullptr || name->empty() || *name == "__model__";
  };
  for (XmlElement& child : model.children) {
    const bool is_placed =
        child.name == "link" || child.name == "model" || child.name == "frame" || child.name == "include";
    if (is_placed) {
      if (child.child("pose") == nullptr) child.add_child("pose");
      XmlElement& pose = *child.child("pose");
      const std::string* attached = child.attribute("attached_to");
      const bool is_attached = attached != nullptr && !attached->empty() && *attached != "__model__";
      if (is_of_model(pose.attribute("relative_to")) && !is_attached) pose.set_attribute("relative_to", frame_name);
    }
    if (child.name == "joint") {
      for (const char* end : {"parent", "child"}) {
        XmlElement* named = child.child(end);
        if (named != nullptr && named->text == "__model__") named->text = frame_name;
      }
      for (const char* axis : {"axis", "axis2"}) {
        XmlElement* direction = child.child(axis) != nullptr ? child.child(axis)->child("xyz") : nullptr;
        const std::string* frame_of_axis = direction != nullptr ? direction->attribute("expressed_in") : nullptr;
        if (frame_of_axis != nullptr && *frame_of_axis == "__model__")
          direction->set_attribute("expressed_in", frame_name);
      }
    }
    if (is_placed || child.name == "joint" || child.name == "plugin" || child.name == "gripper") {
      into.push_back(std::move(child));
    }
  }
}

const Documents::Included* Documents::find(const XmlElement& include) {
  const std::string& uri = include.child_text("uri");
  if (uri.empty()) {
    context_.warn(include.source(), "", "<include> has no <uri>: ignored");
    return nullptr;
  }
  const fs::path named = file_of(uri, include);
  if (named.empty()) {
    context_.warn(include.source(), include.child_text("name").empty() ? "" : "/" + include.child_text("name"),
                  "model not found: '" + uri + "', ignored" + context_.where_models_are(uri));
    return nullptr;
  }
  const std::string file = canonical(named.string());
  if (!open_.empty() && file == open_.back()) fail(include.source(), "the file includes itself");
  if (std::find(open_.begin(), open_.end(), file) != open_.end()) {
    fail(include.source(), "includes " + file + ", which includes this file, directly or through other files");
  }
  if (open_.size() > kDeepestInclude) {
    fail(include.source(), "more than " + std::to_string(kDeepestInclude) + " levels of includes");
  }
  if (const auto known = included_.find(file); known != included_.end()) return &known->second;
  XmlElement root = read(read_file(file), file);
  if (root.name == "robot") {
    context_.included_robots().emplace(file, read_urdf(root, context_));
    return &(included_[file] = {std::move(root), 1});
  }
  const XmlElement* part = included_part(root);
  if (part == nullptr) {
    context_.warn(include.source(), "", file + " contains no <model>: ignored");
    return nullptr;
  }
  return &(included_[file] = {*part, count_elements(*part)});
}

fs::path Documents::file_of(const std::string& uri, const XmlElement& include) {
  const fs::path found = find_model(uri, context_.folder());
  if (found.empty()) return {};
  std::error_code unreadable;
  const fs::path file = fs::is_directory(found, unreadable) ? file_in(found, include) : found;
  if (!file.empty() && !fs::is_regular_file(file, unreadable)) {
    fail(include.source(), "includes " + file.string() + ", which is not a regular file");
  }
  return file;
}

/// The file of a model's folder, or an empty path.
fs::path Documents::file_in(const fs::path& folder, const XmlElement& include) {
  for (const char* name : {"model.config", "manifest.xml"}) {
    const fs::path file = folder / name;
    if (!fs::exists(file)) continue;
    if (!fs::is_regular_file(file)) {
      fail(include.source(), "includes " + file.string() + ", which is not a regular file");
    }
    const std::string model = file_for_newest_version(parse_xml(read_file(file), file.string(), context_.warnings()));
    if (!model.empty()) return folder / model;
  }
  const fs::path usual = folder / "model.sdf";
  return fs::exists(usual) ? usual : fs::path();
}

std::string Documents::read_file(const fs::path& file) {
  check_size(file);
  return read_text(file);
}

void check_size(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size <= kLargestFile) return;
  fail({file.string(), 0}, "is " + std::to_string(size / kMegabyte) + " MB large; the maximum is " +
                               std::to_string(kLargestFile / kMegabyte) + " MB");
}

}  // namespace bubblesim
