// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/gazebo_extensions.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/check_values.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/urdf/urdf_values.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// A number of Gazebo and the place of the element of SDFormat that it is.
struct NumberOfShapes {
  std::string name;
  std::vector<std::string> way;  // below <collision>
  std::size_t count = 1;
};

const std::vector<NumberOfShapes> kNumbersOfShapes = {
    {"mu1", {"surface", "friction", "ode", "mu"}},
    {"mu2", {"surface", "friction", "ode", "mu2"}},
    {"fdir1", {"surface", "friction", "ode", "fdir1"}, 3},
    {"kp", {"surface", "contact", "ode", "kp"}},
    {"kd", {"surface", "contact", "ode", "kd"}},
    {"maxVel", {"surface", "contact", "ode", "max_vel"}},
    {"minDepth", {"surface", "contact", "ode", "min_depth"}},
    {"maxContacts", {"max_contacts"}},
    {"laserRetro", {"laser_retro"}},
};

/// Parameters of other physics engines and of ODE's joints, which have no effect here.
const std::vector<std::string> kWithoutEffect = {"selfCollide",          "fudgeFactor",     "stopCfm",   "stopErp",
                                                 "implicitSpringDamper", "provideFeedback", "cfmDamping"};

/// Sets the text of the element at a way of names.
void set(XmlElement& element, const std::vector<std::string>& way, const XmlElement& place, const std::string& text) {
  XmlElement* at = &element;
  for (const std::string& name : way) {
    XmlElement* child = at->child(name);
    at = child != nullptr ? child : &at->add_child(name);
    at->line = place.line;
  }
  at->text = text;
}

const ElementKind& collision_kind() { return *link_kind().child("collision"); }
const ElementKind& visual_kind() { return *link_kind().child("visual"); }

class ExtensionReader {
 public:
  ExtensionReader(const XmlElement& robot, const UrdfRobot& parts, LoadContext& context)
      : path_("/" + parts.name), context_(context) {
    read_.model = in_place_of(robot, "model");
    for (const UrdfLink& link : parts.links) links_.insert(link.name);
    for (const UrdfJoint& joint : parts.joints) joints_.insert(joint.name);
  }

  void read(const XmlElement& gazebo) {
    const std::string* reference = gazebo.attribute("reference");
    if (reference == nullptr || reference->empty()) {
      read_model(gazebo);
      return;
    }
    const bool is_link = links_.count(*reference) > 0;
    const bool is_joint = joints_.count(*reference) > 0;
    if (is_link) read_link(gazebo, *reference);
    if (is_joint) read_joint(gazebo, *reference);
    if (is_link || is_joint) return;
    if ("/" + *reference == path_) {
      context_.warn(
          gazebo.source(), path_,
          "<gazebo> has reference='" + *reference + "', the robot: ignored; without reference it is for the robot");
      return;
    }
    std::vector<std::string> known(links_.begin(), links_.end());
    known.insert(known.end(), joints_.begin(), joints_.end());
    constexpr std::size_t kMost = 1000;  // comparing with more takes too long
    context_.warn(gazebo.source(), path_,
                  "<gazebo> has reference='" + *reference + "', which is not a link or joint: ignored" +
                      (known.size() > kMost ? "" : did_you_mean(*reference, known)));
  }

  GazeboExtensions result() && { return std::move(read_); }

 private:
  void read_model(const XmlElement& gazebo) {
    XmlElement content = in_place_of(gazebo, "model");
    for (const XmlElement& child : gazebo.children) {
      if (child.name == "static") {
        if (const auto flag = flag_in(with_value(child), path_))
          content.add_child(child.name, *flag ? "true" : "false");
      } else if (child.name == "include") {
        context_.warn(child.source(), path_, "<include> in a <gazebo> is not supported: ignored");
      } else if (!is_for_links_or_joints(child.name)) {
        content.children.push_back(child);
      }
    }
    check_values(content, model_kind(), path_, context_);
    std::move(content.children.begin(), content.children.end(), std::back_inserter(read_.model.children));
  }

  /// Old files have values as attributes: <mu1 value="1"/>.
  static XmlElement with_value(XmlElement element) {
    if (const std::string* value = element.attribute("value")) element.text = trimmed(*value);
    return element;
  }

  /// Gazebo takes them without effect.
  static bool is_for_links_or_joints(const std::string& name) {
    const auto is_it = [&name](const NumberOfShapes& number) { return number.name == name; };
    return std::any_of(kNumbersOfShapes.begin(), kNumbersOfShapes.end(), is_it) || is_without_effect(name) ||
           name == "turnGravityOff" || name == "dampingFactor" || name == "material" || name == "springStiffness" ||
           name == "springReference" || name == "preserveFixedJoint" || name == "disableFixedJointLumping";
  }

  static bool is_without_effect(const std::string& name) {
    return std::find(kWithoutEffect.begin(), kWithoutEffect.end(), name) != kWithoutEffect.end();
  }

  void read_link(const XmlElement& gazebo, const std::string& link) {
    const std::string path = path_ + "/" + link;
    LinkExtension extension;
    extension.content = in_place_of(gazebo, "link");
    extension.collision = in_place_of(gazebo, "collision");
    extension.visual = in_place_of(gazebo, "visual");
    for (const XmlElement& child : gazebo.children) read_shapes(child, path, extension);
    for (const XmlElement& child : gazebo.children) read_of_link(with_value(child), path, extension);
    check_values(extension.content, link_kind(), path, context_);
    add(std::move(extension), link);
  }

  /// Later values for shapes replace earlier ones. Of the content, SDFormat takes the first of elements with one name.
  void add(LinkExtension extension, const std::string& link) {
    const auto [known, is_new] = read_.links.emplace(link, extension);
    if (is_new) return;
    LinkExtension& all = known->second;
    merge(extension.collision, all.collision, collision_kind());
    merge(extension.visual, all.visual, visual_kind());
    if (extension.gravity) all.gravity = extension.gravity;
    std::vector<XmlElement>& content = extension.content.children;
    std::move(content.begin(), content.end(), std::back_inserter(all.content.children));
  }

  /// SDFormat for the shapes. Gazebo's own elements for them come after it, wherever they are.
  void read_shapes(const XmlElement& child, const std::string& path, LinkExtension& extension) {
    if (child.name != "collision" && child.name != "visual") return;
    XmlElement content = child;
    for (const char* name : {"pose", "geometry"}) {
      if (content.child(name) == nullptr) continue;
      context_.warn(
          content.child(name)->source(), path,
          "<" + std::string(name) + "> in a <gazebo> is ignored: it is that of the <" + child.name + "> of the link");
      content.remove_children(name);
    }
    const bool is_visual = child.name == "visual";
    const ElementKind& kind = is_visual ? visual_kind() : collision_kind();
    check_values(content, kind, path, context_);
    merge(content, is_visual ? extension.visual : extension.collision, kind);
  }

  void read_of_link(const XmlElement& child, const std::string& path, LinkExtension& extension) {
    const std::string& name = child.name;
    if (read_number_of_shapes(child, path, extension.collision)) return;
    if (name == "collision" || name == "visual" || is_without_effect(name) || keeps_fixed_joint(name)) return;
    if (name == "material") {
      set(extension.visual, {"material", "script", "name"}, child, child.text);
      set(extension.visual, {"material", "script", "uri"}, child, "file://media/materials/scripts/gazebo.material");
    } else if (name == "turnGravityOff") {
      if (const auto off = flag_in(child, path)) extension.gravity = !*off;
    } else if (name == "dampingFactor") {
      if (!numbers_in(child, 1, path)) return;
      XmlElement decay = in_place_of(child, "velocity_decay");
      for (const char* which : {"linear", "angular"}) decay.add_child(which, child.text);
      extension.content.children.insert(extension.content.children.begin(), std::move(decay));  // it comes first
    } else {
      extension.content.children.push_back(child);
    }
  }

  static bool keeps_fixed_joint(const std::string& name) {
    return name == "preserveFixedJoint" || name == "disableFixedJointLumping";
  }

  /// Returns whether the element is such a number.
  bool read_number_of_shapes(const XmlElement& element, const std::string& path, XmlElement& collision) {
    for (const NumberOfShapes& known : kNumbersOfShapes) {
      if (known.name != element.name) continue;
      const auto numbers = numbers_in(element, known.count, path);
      if (!numbers) return true;
      std::string text = element.text;
      if (known.way.back().rfind("mu", 0) == 0 && numbers->front() < 0) {
        context_.warn(element.source(), path, "<" + known.name + "> is below 0: using infinite friction");
        text = "inf";
      }
      set(collision, known.way, element, text);
      return true;
    }
    return false;
  }

  void read_joint(const XmlElement& gazebo, const std::string& joint) {
    const std::string path = path_ + "/" + joint;
    XmlElement content = in_place_of(gazebo, "joint");
    for (const XmlElement& child : gazebo.children) read_of_joint(with_value(child), joint, path, content);
    check_values(content, joint_kind(), path, context_);
    const auto [known, is_new] = read_.joints.emplace(joint, content);
    if (is_new) return;
    for (XmlElement& child : content.children) {
      if (child.name == "axis") {
        merge_axis(child, known->second);
      } else {
        known->second.children.push_back(std::move(child));
      }
    }
  }

  static void merge_axis(const XmlElement& axis, XmlElement& joint) {
    XmlElement one = in_place_of(axis, joint.name);
    one.children.push_back(axis);
    merge(one, joint, joint_kind());
  }

  void read_of_joint(const XmlElement& child, const std::string& joint, const std::string& path, XmlElement& content) {
    const std::string& name = child.name;
    if (is_without_effect(name)) return;
    if (keeps_fixed_joint(name)) {
      const auto keep = flag_in(child, path);
      if (keep && *keep) (name == "preserveFixedJoint" ? read_.preserved_joints : read_.unlumped_joints).insert(joint);
    } else if (name == "springStiffness" || name == "springReference") {
      const bool is_read = numbers_in(child, 1, path).has_value();
      const std::string target = name == "springStiffness" ? "spring_stiffness" : "spring_reference";
      if (is_read) set(content, {"axis", "dynamics", target}, child, child.text);
    } else if (name == "axis") {
      merge_axis(child, content);
    } else if (!is_for_links_or_joints(name)) {
      content.children.push_back(child);
    }
  }

  /// The text of an element as numbers. Empty when it has others, which is reported.
  std::optional<std::vector<double>> numbers_in(const XmlElement& element, std::size_t count, const std::string& path) {
    std::vector<double> numbers;
    const bool is_read = read_numbers(element.text, numbers) && numbers.size() == count;
    const auto is_nan = [](double number) { return std::isnan(number); };
    if (is_read && std::none_of(numbers.begin(), numbers.end(), is_nan)) return numbers;
    context_.report(
        element.source(), path,
        "<" + element.name + "> is '" + element.text + "', it must be " + (count == 1 ? "a number" : "three numbers"));
    return std::nullopt;
  }

  /// The text of an element as true or false. Empty when it is neither, which is reported.
  std::optional<bool> flag_in(const XmlElement& element, const std::string& path) {
    std::string word = element.text;
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char sign) { return std::tolower(sign); });
    for (const char* yes : {"true", "yes", "1"}) {
      if (word == yes) return true;
    }
    for (const char* no : {"false", "no", "0"}) {
      if (word == no) return false;
    }
    context_.report(element.source(), path,
                    "<" + element.name + "> is '" + element.text + "', it must be true or false");
    return std::nullopt;
  }

  std::string path_;
  LoadContext& context_;
  std::set<std::string> links_;
  std::set<std::string> joints_;
  GazeboExtensions read_;
};

}  // namespace

GazeboExtensions read_extensions(const XmlElement& robot, const UrdfRobot& parts, LoadContext& context) {
  ExtensionReader reader(robot, parts, context);
  for (const XmlElement& child : robot.children) {
    if (child.name == "gazebo") reader.read(child);
  }
  return std::move(reader).result();
}

// Bounded: elements are nested at most 256 deep (xml_parser.hpp).
void merge(const XmlElement& from, XmlElement& into, const ElementKind& kind) {
  for (const XmlElement& child : from.children) {
    const ElementKind* child_kind = kind.child(child.name);
    if (child_kind == nullptr) continue;
    XmlElement* known = into.child(child.name);
    if (known != nullptr && !child.children.empty() && !known->children.empty()) {
      merge(child, *known, *child_kind);
    } else {
      into.replace_child(child);
    }
  }
}

}  // namespace bubblesim
