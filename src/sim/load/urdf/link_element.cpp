// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/link_element.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "load/sdf/elements/sdf_element.hpp"
#include "load/sdf/models/frames.hpp"
#include "load/urdf/urdf_values.hpp"

namespace bubblesim {
namespace {

/// The shapes of one kind of a body: their names, and which <gazebo> applies to which.
class BodyShapes {
 public:
  /// `kind` is collision or visual.
  BodyShapes(std::string body, const std::string& kind) : body_(std::move(body)), suffix_("_" + kind) {}

  /// Adds a shape of a link that is a part of the body. Returns its name, which is Gazebo's.
  std::string add(const UrdfShape& shape, const std::string& link) {
    const std::string& own = shape.name.empty() ? link : shape.name;
    std::string name = own + suffix_;
    const bool starts_as_body = name.rfind(body_, 0) == 0;
    if (!starts_as_body) name.insert(0, body_ + "_fixed_joint_lump__");
    if (count_ > 0) name += "_" + std::to_string(count_);
    assign(own, starts_as_body);
    ++count_;
    return name;
  }

  /// The numbers of the shapes that the <gazebo> of a link applies to.
  const std::vector<std::size_t>& of(const std::string& link) { return shapes_[link]; }

 private:
  /// In Gazebo, the name of a shape decides: those of a part are named after its link, or that and the kind; all that
  /// start as the body are of the body.
  void assign(const std::string& own, bool starts_as_body) {
    if (starts_as_body) {
      shapes_[body_].push_back(count_);
      return;
    }
    shapes_[own].push_back(count_);
    for (std::size_t at = own.find(suffix_); at != std::string::npos; at = own.find(suffix_, at + 1)) {
      shapes_[own.substr(0, at)].push_back(count_);
    }
  }

  std::string body_;
  std::string suffix_;
  std::size_t count_ = 0;
  std::map<std::string, std::vector<std::size_t>> shapes_;  // by link
};

class LinkElement {
 public:
  LinkElement(const LumpedLink& body, const GazeboExtensions& extensions, const std::string& path, LoadContext& context)
      : body_(body), extensions_(extensions), path_(path), context_(context) {}

  XmlElement make() {
    XmlElement element = named_element("link", body_.link().name, body_.link().place);
    add_shapes(element, "collision", &UrdfLink::collisions, &LinkExtension::collision);
    add_shapes(element, "visual", &UrdfLink::visuals, &LinkExtension::visual);
    std::optional<bool> gravity;
    each_extension([&](const LumpedPart& part, const LinkExtension& extension) {
      for (const XmlElement& child : extension.content.children) element.children.push_back(moved(child, part.pose));
      if (extension.gravity) gravity = extension.gravity;
    });
    if (gravity) {
      element.remove_children("gravity");
      element.add_child("gravity", *gravity ? "true" : "false");
    }
    for (XmlElement& child : element.children) {
      if (child.name == "sensor") rename_collisions(child);
    }
    return element;
  }

 private:
  /// Calls `visit` with each part that has one.
  template <class Visit>
  void each_extension(const Visit& visit) const {
    for (const LumpedPart& part : body_.parts) {
      const auto extension = extensions_.links.find(part.link->name);
      if (extension != extensions_.links.end()) visit(part, extension->second);
    }
  }

  void add_shapes(XmlElement& element, const std::string& kind, std::vector<UrdfShape> UrdfLink::*shapes,
                  XmlElement LinkExtension::*added) {
    BodyShapes body(body_.link().name, kind);
    const std::size_t first = element.children.size();
    for (const LumpedPart& part : body_.parts) {
      for (const UrdfShape& shape : part.link->*shapes) {
        XmlElement made = shape.element;
        made.set_attribute("name", body.add(shape, part.link->name));
        made.children.push_back(pose_element(part.pose * shape.pose, made));
        if (kind == "collision") remember(shape, part.link->name, made.given_name());
        element.children.push_back(std::move(made));
      }
    }
    each_extension([&](const LumpedPart& part, const LinkExtension& extension) {
      for (const std::size_t i : body.of(part.link->name)) {
        XmlElement& shape = element.children[first + i];
        merge(extension.*added, shape, *link_kind().child(kind));
        if (kind == "collision") add_contact(shape);
      }
      const bool is_used = !body.of(part.link->name).empty() || (part.link->*shapes).empty();
      if (is_used || (extension.*added).children.empty()) return;
      context_.warn((extension.*added).source(), path_,
                    "values of <gazebo reference=\"" + part.link->name + "\"> for the " + kind +
                        "s have no effect: as in Gazebo, they are for those without a name; remove the names");
    });
  }

  /// Collisions with a <contact>, which each <gazebo> adds, have other masks than those without.
  static void add_contact(XmlElement& collision) {
    if (collision.child("surface") == nullptr) collision.add_child("surface");
    XmlElement& surface = *collision.child("surface");
    if (surface.child("contact") == nullptr) surface.add_child("contact");
  }

  /// Gazebo moves sensors with the part that they are on.
  static XmlElement moved(const XmlElement& child, const Pose& part) {
    if (child.name != "sensor" && child.name != "light") return child;
    XmlElement moved = child;
    const SdfElement element(&child, *link_kind().child(child.name));
    if (!base_of(element).empty()) return moved;
    moved.replace_child(pose_element(part * element.child("pose").as_pose(), child));
    return moved;
  }

  /// The names by which a contact sensor may refer to a collision: that in its own link, which lumping changes.
  void remember(const UrdfShape& shape, const std::string& link, const std::string& name) {
    const int number = counts_[link]++;
    collisions_.emplace(name, name);
    const std::string own = (shape.name.empty() ? link : shape.name) + "_collision";
    collisions_.emplace(number > 0 ? own + "_" + std::to_string(number) : own, name);
    if (!shape.name.empty()) collisions_.emplace(shape.name, name);
  }

  void rename_collisions(XmlElement& sensor) const {
    XmlElement* contact = sensor.child("contact");
    if (contact == nullptr) return;
    for (XmlElement& child : contact->children) {
      const auto found = collisions_.find(child.text);
      if (child.name == "collision" && found != collisions_.end()) child.text = found->second;
    }
  }

  const LumpedLink& body_;
  const GazeboExtensions& extensions_;
  const std::string& path_;
  LoadContext& context_;
  std::map<std::string, int> counts_;              // of collisions, by link
  std::map<std::string, std::string> collisions_;  // final names
};

}  // namespace

XmlElement link_element(const LumpedLink& body, const GazeboExtensions& extensions, const std::string& path,
                        LoadContext& context) {
  return LinkElement(body, extensions, path, context).make();
}

}  // namespace bubblesim
