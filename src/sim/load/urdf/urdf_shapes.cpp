// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/urdf_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "load/urdf/urdf_values.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// SDFormat's <diffuse>: red, green, blue and opacity. Gazebo divides URDF's colours by 0.8.
std::optional<std::string> read_color(const XmlElement& color, const std::string& path, LoadContext& context) {
  const std::string* text = color.attribute("rgba");
  if (text == nullptr) return std::nullopt;
  std::vector<double> parts;
  const bool is_read = read_numbers(*text, parts) && (parts.size() == 3 || parts.size() == 4);
  if (!is_read || std::any_of(parts.begin(), parts.end(), [](double part) { return std::isnan(part); })) {
    context.warn(color.source(), path,
                 "<color> has rgba='" + *text + "', it must be four numbers from 0 to 1: this colour is ignored");
    return std::nullopt;
  }
  std::vector<double> valid = parts;
  for (double& part : valid) part = std::clamp(part, 0.0, 1.0);
  if (valid != parts) {
    context.warn(color.source(), path,
                 "<color> has rgba='" + *text + "', the numbers must be from 0 to 1: using " + write_numbers(valid));
  }
  constexpr double kBrightness = 0.8;
  for (std::size_t i = 0; i < 3; ++i) valid[i] = std::min(valid[i] / kBrightness, 1.0);
  return write_numbers(valid);
}

/// The colour and texture of a <material>, if it has one.
std::optional<XmlElement> read_appearance(const XmlElement& material, const std::string& path, LoadContext& context) {
  XmlElement appearance = in_place_of(material, "material");
  if (const XmlElement* color = material.child("color")) {
    if (const auto rgba = read_color(*color, path, context)) appearance.add_child("diffuse", *rgba);
  }
  const XmlElement* texture = material.child("texture");
  const std::string* filename = texture != nullptr ? texture->attribute("filename") : nullptr;
  if (filename != nullptr && !filename->empty()) {
    appearance.add_child("pbr").add_child("metal").add_child("albedo_map", *filename);
  }
  return appearance.children.empty() ? std::nullopt : std::make_optional(std::move(appearance));
}

/// Reads the shape in a <geometry>.
class GeometryReader {
 public:
  GeometryReader(const XmlElement& shape, const std::string& path, LoadContext& context)
      : shape_(shape), path_(path), context_(context), geometry_(in_place_of(shape, shape.name)) {}

  /// SDFormat's element of the shape. Empty when the shape is unknown.
  std::optional<XmlElement> read() {
    if (shape_.name == "box") {
      copy_vector("size", "size");
    } else if (shape_.name == "sphere") {
      copy_number("radius");
    } else if (shape_.name == "cylinder" || shape_.name == "capsule") {
      copy_number("radius");
      copy_number("length");
    } else if (shape_.name == "mesh") {
      read_mesh();
    } else {
      const std::vector<std::string> known = {"box", "sphere", "cylinder", "capsule", "mesh"};
      context_.warn(shape_.source(), path_,
                    "<" + shape_.name + "> is not a geometry of URDF, which are box, sphere, cylinder, capsule and " +
                        "mesh: this shape is ignored" + did_you_mean(shape_.name, known));
      return std::nullopt;
    }
    return std::move(geometry_);
  }

 private:
  // The strings are copied, so that no digit is lost.
  void copy_number(const std::string& attribute) {
    if (required_number_in(shape_, attribute, path_, context_))
      geometry_.add_child(attribute, *shape_.attribute(attribute));
  }
  void copy_vector(const std::string& attribute, const std::string& name) {
    if (required_vector_in(shape_, attribute, path_, context_)) geometry_.add_child(name, *shape_.attribute(attribute));
  }

  void read_mesh() {
    const std::string* filename = shape_.attribute("filename");
    if (filename == nullptr || filename->empty()) {
      context_.report(shape_.source(), path_, "<mesh> has no filename: it must name a mesh file");
      return;
    }
    geometry_.add_child("uri", *filename);
    if (shape_.attribute("scale") != nullptr) copy_vector("scale", "scale");
  }

  const XmlElement& shape_;
  const std::string& path_;
  LoadContext& context_;
  XmlElement geometry_;
};

std::optional<XmlElement> read_geometry(const XmlElement& shape, const std::string& path, LoadContext& context) {
  const XmlElement* geometry = shape.child("geometry");
  if (geometry == nullptr || geometry->children.empty()) {
    context.warn(shape.source(), path, "<" + shape.name + "> has no geometry: this shape is ignored");
    return std::nullopt;
  }
  auto read = GeometryReader(geometry->children.front(), path, context).read();
  if (!read) return std::nullopt;
  XmlElement element = in_place_of(*geometry, "geometry");
  element.children.push_back(std::move(*read));
  return element;
}

}  // namespace

UrdfMaterials::UrdfMaterials(const XmlElement& robot, const std::string& path, LoadContext& context) {
  for (const XmlElement& material : robot.children) {
    if (material.name != "material") continue;
    const std::string& name = material.given_name();
    if (name.empty()) {
      context.warn(material.source(), path, "<material> has no name: ignored");
      continue;
    }
    auto appearance = read_appearance(material, path, context);
    if (appearance && !known_.emplace(name, std::move(*appearance)).second) {
      context.warn(material.source(), path, "the material '" + name + "' is defined twice: the first one is used");
    }
  }
}

std::optional<XmlElement> UrdfMaterials::read(const XmlElement& material, const std::string& path,
                                              LoadContext& context) {
  const std::string& name = material.given_name();
  if (const auto found = known_.find(name); found != known_.end()) {
    XmlElement element = found->second;
    element.line = material.line;
    return element;
  }
  auto appearance = read_appearance(material, path, context);
  if (appearance && !name.empty()) known_.emplace(name, *appearance);
  const bool is_reference = material.child("color") == nullptr && material.child("texture") == nullptr;
  if (is_reference && !name.empty()) {
    context.warn(material.source(), path, "the material '" + name + "' is not defined before: it has no colour");
  }
  return appearance;
}

std::optional<UrdfShape> read_shape(const XmlElement& shape, UrdfMaterials& materials, const std::string& path,
                                    LoadContext& context) {
  // An element of URDF that is left out still counts for the materials, as in Gazebo.
  std::optional<XmlElement> material;
  if (const XmlElement* given = shape.name == "visual" ? shape.child("material") : nullptr) {
    material = materials.read(*given, path, context);
  }
  auto geometry = read_geometry(shape, path, context);
  if (!geometry) return std::nullopt;
  UrdfShape read{shape.given_name(), origin_of(shape, path, context), in_place_of(shape, shape.name)};
  read.element.children.push_back(std::move(*geometry));
  if (material) read.element.children.push_back(std::move(*material));
  return read;
}

}  // namespace bubblesim
