// SPDX-License-Identifier: BSD-3-Clause
// What a program needs to draw a scene: its objects with shapes, materials, axes, sensor parameters and lights, as
// dictionaries of plain values. Poses are lists x, y, z (m) and the quaternion x, y, z, w.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "guarded.hpp"
#include "numpy_values.hpp"
#include "sensors/sensor_view.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

py::list pose_list(const Pose& pose) {
  py::list list;
  for (const double number : {pose.position.x(), pose.position.y(), pose.position.z(), pose.orientation.x(),
                              pose.orientation.y(), pose.orientation.z(), pose.orientation.w()}) {
    list.append(number);
  }
  return list;
}

std::array<float, 3> color_list(const Color& color) { return {color.r, color.g, color.b}; }

/// A number without meaning to the reader, for what is infinite.
py::object finite(double value) {
  return std::isfinite(value) ? py::object(py::float_(value)) : py::object(py::none());
}

/// Numbers meshes and textures, and keeps them for who asks for their contents. Equal contents in one object of the
/// scene have one number.
class SceneView {
 public:
  py::dict environment(const Simulation& simulation) {
    const HoldWithGil hold(lock_of(simulation));
    const Environment& surroundings = simulation.scene().environment;
    py::dict dict;
    dict["ambient"] = color_list(surroundings.ambient);
    dict["background"] = color_list(surroundings.background);
    dict["sky"] = surroundings.sky;
    dict["shadows"] = surroundings.shadows;
    py::list lights;
    for (const Light& light : surroundings.lights) lights.append(light_dict(light));
    dict["lights"] = lights;
    dict["gravity"] = to_list(simulation.world().properties().gravity());
    return dict;
  }

  /// The objects of an outermost model, outer ones first.
  py::list model(const Simulation& simulation, ObjectId model) {
    const HoldWithGil hold(lock_of(simulation));
    const World& world = simulation.world();
    const SceneTree& tree = world.tree();
    const ModelDescription& description = world.models().description(model);
    const bool visuals = std::any_of(description.links.begin(), description.links.end(),
                                     [](const LinkDescription& link) { return !link.visuals.empty(); });
    py::list objects;
    for (const ObjectId id : tree.all_parts(model)) {
      const Object& object = tree.at(id);
      py::dict dict;
      dict["handle"] = object.id;
      dict["kind"] = std::string(kind_name(object.kind));
      dict["name"] = object.name;
      dict["path"] = tree.path(object.id);
      dict["parent"] = object.parent;
      dict["hidden"] = object.is_hidden;
      dict["model"] = model;
      dict["pose"] = pose_list(world.pose(object.id));
      dict["static"] = description.is_static;
      switch (object.kind) {
        case ObjectKind::kModel:
          add_model(dict, description, object, tree);
          break;
        case ObjectKind::kLink:
          add_link(dict, description.links[object.index], visuals);
          break;
        case ObjectKind::kJoint:
          add_joint(dict, world, object.id);
          break;
        case ObjectKind::kSensor:
          add_sensor(dict, world, object);
          break;
        case ObjectKind::kFrame:
          dict["type"] = std::string(frame_kind_name(world.frames().kind(object.id)));
          dict["carrier"] = world.frames().link(object.id);
          break;
      }
      objects.append(dict);
    }
    return objects;
  }

  /// The objects of no model.
  static py::list frames(const Simulation& simulation) {
    const HoldWithGil hold(lock_of(simulation));
    const World& world = simulation.world();
    py::list objects;
    for (const ObjectId id : world.tree().objects()) {
      const Object& object = world.tree().at(id);
      if (world.tree().outermost_model_of(id) != kNoObject) continue;
      py::dict dict;
      dict["handle"] = id;
      dict["kind"] = std::string(kind_name(object.kind));
      dict["name"] = object.alias;
      dict["path"] = world.tree().path(id);
      dict["parent"] = object.parent;
      dict["pose"] = pose_list(world.pose(id));
      dict["type"] = std::string(frame_kind_name(world.frames().kind(id)));
      dict["carrier"] = world.frames().link(id);
      dict["hidden"] = false;
      dict["model"] = kNoObject;
      objects.append(dict);
    }
    return objects;
  }

  py::dict mesh(std::size_t number) const {
    const TriangleMesh& mesh = *at(meshes_, number, "mesh");
    py::dict dict;
    dict["vertices"] = bytes_of(mesh.vertices);
    dict["triangles"] = bytes_of(mesh.triangles);
    dict["normals"] = bytes_of(mesh.normals);
    dict["texture_coordinates"] = bytes_of(mesh.texture_coordinates);
    dict["material_of"] = bytes_of(mesh.material_of);
    return dict;
  }

  py::dict texture(std::size_t number) const {
    const Texture& texture = *at(textures_, number, "texture");
    py::dict dict;
    dict["width"] = texture.width;
    dict["height"] = texture.height;
    dict["rgb"] = bytes_of(texture.rgb);
    return dict;
  }

 private:
  template <class Kind>
  using Numbered = std::pair<std::map<const Kind*, std::size_t>, std::vector<std::shared_ptr<const Kind>>>;

  template <class Kind>
  static std::size_t number_of(Numbered<Kind>& known, const std::shared_ptr<const Kind>& value) {
    const auto [place, is_new] = known.first.emplace(value.get(), known.second.size());
    if (is_new) known.second.push_back(value);
    return place->second;
  }

  template <class Kind>
  static const std::shared_ptr<const Kind>& at(const Numbered<Kind>& known, std::size_t number, const char* what) {
    if (number < known.second.size()) return known.second[number];
    throw InvalidInput(std::string("there is no ") + what + " " + std::to_string(number));
  }

  template <class Item>
  static py::bytes bytes_of(const std::vector<Item>& items) {
    return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)};
  }

  py::dict shape_dict(const Geometry& geometry) {
    py::dict dict;
    if (const auto* box = std::get_if<Box>(&geometry)) {
      dict["type"] = "box";
      dict["size"] = to_list(box->size);
    } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
      dict["type"] = "sphere";
      dict["radius"] = sphere->radius;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
      dict["type"] = "cylinder";
      dict["radius"] = cylinder->radius;
      dict["length"] = cylinder->length;
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
      dict["type"] = "capsule";
      dict["radius"] = capsule->radius;
      dict["length"] = capsule->length;
    } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry)) {
      dict["type"] = "ellipsoid";
      dict["radii"] = to_list(ellipsoid->radii);
    } else if (const auto* plane = std::get_if<Plane>(&geometry)) {
      dict["type"] = "plane";
      dict["normal"] = to_list(plane->normal);
    } else {
      const auto& mesh = std::get<Mesh>(geometry).triangles;
      dict["type"] = "mesh";
      dict["mesh"] = number_of(meshes_, mesh);
      dict["low"] = to_list(mesh->low);
      dict["high"] = to_list(mesh->high);
    }
    return dict;
  }

  py::dict material_dict(const Material& material) {
    py::dict dict;
    dict["diffuse"] = color_list(material.diffuse);
    dict["emissive"] = color_list(material.emissive);
    if (material.texture) dict["texture"] = number_of(textures_, material.texture);
    if (material.checker_size > 0) {
      dict["checker_size"] = material.checker_size;
      dict["checker_color"] = color_list(material.checker_color);
    }
    return dict;
  }

  py::dict visual_dict(const VisualDescription& visual) {
    py::dict dict;
    dict["name"] = visual.name;
    dict["pose"] = pose_list(visual.pose);
    dict["shape"] = shape_dict(visual.geometry);
    dict["material"] = material_dict(visual.material);
    dict["cast_shadows"] = visual.cast_shadows;
    const auto* mesh = std::get_if<Mesh>(&visual.geometry);
    if (mesh != nullptr && visual.keeps_mesh_materials && !mesh->triangles->materials.empty()) {
      py::list materials;
      for (const Material& material : mesh->triangles->materials) materials.append(material_dict(material));
      dict["materials"] = materials;
    }
    return dict;
  }

  static py::dict light_dict(const Light& light) {
    py::dict dict;
    dict["kind"] = light.kind == LightKind::kDirectional ? "directional"
                   : light.kind == LightKind::kPoint     ? "point"
                                                         : "spot";
    dict["diffuse"] = color_list(light.diffuse);
    dict["cast_shadows"] = light.cast_shadows;
    dict["direction"] = to_list(light.direction);
    dict["position"] = to_list(light.position);
    dict["range"] = light.range;
    dict["attenuation"] =
        std::array<double, 3>{light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation};
    dict["inner_angle"] = light.inner_angle;
    dict["outer_angle"] = light.outer_angle;
    dict["falloff"] = light.falloff;
    return dict;
  }

  static void add_model(const py::dict& dict, const ModelDescription& description, const Object& object,
                        const SceneTree& tree) {
    const bool outermost = object.is_outermost_model();
    const std::string& canonical =
        outermost ? description.canonical_link : description.nested[object.index].canonical_link;
    for (const ObjectId link : tree.parts(tree.outermost_model_of(object.id), ObjectKind::kLink)) {
      const bool is_first = canonical.empty() && !dict.contains("canonical_link");
      if (is_first || description.links[tree.at(link).index].name == canonical) dict["canonical_link"] = link;
    }
    const auto& script = outermost ? description.child_script : description.nested[object.index].child_script;
    const Source& source = outermost ? description.source : description.nested[object.index].source;
    dict["script"] = script.string();
    dict["file"] = source.file;
    dict["line"] = source.line;
  }

  void add_link(const py::dict& dict, const LinkDescription& link, bool visuals) {
    dict["mass"] = link.mass;
    dict["centre_of_mass"] = to_list(link.centre_of_mass);
    dict["inertia_diagonal"] = to_list(link.inertia_diagonal);
    dict["inertia_products"] = to_list(link.inertia_products);
    dict["gravity"] = link.gravity_enabled;
    py::list collisions;
    py::list shown;
    for (const CollisionDescription& collision : link.collisions) {
      py::dict shape;
      shape["name"] = collision.name;
      shape["pose"] = pose_list(collision.pose);
      shape["shape"] = shape_dict(collision.geometry);
      shape["friction"] = collision.surface.mu;
      shape["restitution"] = collision.surface.restitution;
      collisions.append(shape);
      if (visuals) continue;
      shown.append(visual_dict({collision.name, collision.pose, collision.geometry, Material{}, false, true, 0, {}}));
    }
    for (const VisualDescription& visual : link.visuals) shown.append(visual_dict(visual));
    py::list lights;
    for (const Light& light : link.lights) lights.append(light_dict(light));
    dict["collisions"] = collisions;
    dict["visuals"] = shown;
    dict["lights"] = lights;
  }

  static void add_joint(const py::dict& dict, const World& world, ObjectId joint) {
    const JointDescription& description = world.joints().description(joint);
    const auto [parent, child] = world.joints().links(joint);
    dict["type"] = description.type;
    dict["parent_link"] = parent;
    dict["child_link"] = child;
    dict["pose"] = pose_list(world.joints().child_pose(joint));  // the axes are fixed in the child
    py::list axes;
    const int axis_count = world.joints().axes(joint);
    for (int i = 0; i < axis_count && i < static_cast<int>(description.axes.size()); ++i) {
      const AxisDescription& axis = description.axes[static_cast<std::size_t>(i)];
      py::dict of_axis;
      of_axis["direction"] = to_list(axis.direction);
      of_axis["lower"] = finite(axis.lower);
      of_axis["upper"] = finite(axis.upper);
      of_axis["max_velocity"] = finite(axis.max_velocity);
      of_axis["max_force"] = finite(axis.max_force);
      of_axis["damping"] = axis.damping;
      of_axis["friction"] = axis.friction;
      axes.append(of_axis);
    }
    dict["axes"] = axes;
  }

  static void add_sensor(const py::dict& dict, const World& world, const Object& sensor) {
    const SensorDescription& description = world.models().sensor_description(sensor.id);
    dict["type"] = description.type;
    dict["carrier"] = sensor.carrier;
    dict["pose_in_parent"] = pose_list(description.pose);
    dict["update_rate"] = description.update_rate;
    dict["topic"] = description.topic;
    dict["parameters"] = sensor_parameters(description.kind);
  }

  Numbered<TriangleMesh> meshes_;
  Numbered<Texture> textures_;
};

}  // namespace

void bind_scene_view(py::module_& module) {
  py::class_<SceneView>(module, "SceneView",
                        "The objects of a simulation as plain values, for a program that draws them.")
      .def(py::init<>())
      .def("environment", &SceneView::environment, py::arg("simulation"))
      .def("model", &SceneView::model, py::arg("simulation"), py::arg("model"),
           "Return the objects of a top-level model, outer ones before inner ones.")
      .def_static("frames", &SceneView::frames, py::arg("simulation"), "Return the frames that are of no model.")
      .def("mesh", &SceneView::mesh, py::arg("number"), "Return the arrays of a mesh as bytes.")
      .def("texture", &SceneView::texture, py::arg("number"), "Return the size and RGB bytes of an image.");
}

}  // namespace bubblesim::bindings
