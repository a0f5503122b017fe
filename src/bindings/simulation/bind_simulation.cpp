// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Simulation, the errors of the core and the shapes of a scene.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>

#include "bindings.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "bubblesim/warnings.hpp"
#include "devices/attached.hpp"
#include "guarded.hpp"
#include "numpy_values.hpp"
#include "object_view.hpp"
#include "scene/loaded_scene.hpp"
#include "simulation/random_quantities.hpp"
#include "step_count.hpp"
#include "world/file_places.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// A shape with its pose, for tools that draw a scene.
struct CollisionShape {
  std::string object_path;
  std::string kind;
  std::vector<double> size;
  Pose pose;
  bool is_static;
  std::shared_ptr<const TriangleMesh> mesh;  // null for other kinds
};

struct ShapeText {
  std::string kind;
  std::vector<double> size;
};

struct ShapeDescriber {
  ShapeText operator()(const Box& box) const { return {"box", {box.size.x(), box.size.y(), box.size.z()}}; }
  ShapeText operator()(const Sphere& sphere) const { return {"sphere", {sphere.radius}}; }
  ShapeText operator()(const Cylinder& cylinder) const { return {"cylinder", {cylinder.radius, cylinder.length}}; }
  ShapeText operator()(const Capsule& capsule) const { return {"capsule", {capsule.radius, capsule.length}}; }
  ShapeText operator()(const Ellipsoid& ellipsoid) const {
    return {"ellipsoid", {ellipsoid.radii.x(), ellipsoid.radii.y(), ellipsoid.radii.z()}};
  }
  ShapeText operator()(const Mesh& mesh) const {
    const Vector3 size = mesh.triangles->high - mesh.triangles->low;
    return {"mesh", {size.x(), size.y(), size.z()}};
  }
  ShapeText operator()(const Plane& plane) const {
    return {"plane", {plane.normal.x(), plane.normal.y(), plane.normal.z()}};
  }
};

std::vector<CollisionShape> collisions(const Simulation& simulation) {
  std::vector<CollisionShape> shapes;
  for (const PlacedShape& shape : simulation.world().geometry().shapes()) {
    ShapeText text = std::visit(ShapeDescriber{}, shape.geometry);
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    shapes.push_back({simulation.world().tree().path(shape.link), std::move(text.kind), std::move(text.size),
                      shape.pose, shape.is_static, mesh != nullptr ? mesh->triangles : nullptr});
  }
  return shapes;
}

py::array_t<float> vertices(const CollisionShape& shape) {
  const std::vector<TriangleMesh::Point> points =
      shape.mesh != nullptr ? shape.mesh->vertices : std::vector<TriangleMesh::Point>();
  const std::vector<py::ssize_t> size = {static_cast<py::ssize_t>(points.size()), 3};
  return py::array_t<float>(size, reinterpret_cast<const float*>(points.data()));
}

/// Steps without the GIL, but checks Python's signals regularly so that Ctrl-C ends a long call.
void step_simulation(Simulation& simulation, StepCount steps) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kBetweenSignals{50};
  Clock::time_point look = Clock::now() + kBetweenSignals;
  for (std::uint64_t done = 0; done < steps.value; ++done) {
    simulation.step();
    if (Clock::now() < look) continue;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    look = Clock::now() + kBetweenSignals;
  }
}

ObjectView find_object(const py::object& simulation, const std::string& path) {
  return {simulation, simulation.cast<Simulation&>().world().tree().find(path)};
}

std::vector<ObjectView> all_objects(const py::object& simulation) {
  std::vector<ObjectView> views;
  for (const ObjectId id : simulation.cast<Simulation&>().world().tree().objects()) views.emplace_back(simulation, id);
  return views;
}

/// Adds the parameters that a plugin does not have yet.
void complete(PluginDescription& plugin, const std::map<std::string, std::string>& parameters) {
  for (const auto& [name, text] : parameters) {
    const auto is_it = [&name = name](const PluginParameter& parameter) { return parameter.name == name; };
    if (std::any_of(plugin.parameters.begin(), plugin.parameters.end(), is_it)) continue;
    plugin.parameters.push_back({name, text, {}, plugin.source});
  }
}

void complete_plugins(ModelDescription& model, const std::map<std::string, std::string>& parameters) {
  for (PluginDescription& plugin : model.plugins) complete(plugin, parameters);
  for (LinkDescription& link : model.links) {
    for (SensorDescription& sensor : link.sensors) {
      for (PluginDescription& plugin : sensor.plugins) complete(plugin, parameters);
    }
  }
}

/// Calls `load` with a list for its warnings, and prints them, also when it fails.
template <class Load>
void print_warnings_of(const Load& load) {
  std::vector<Problem> warnings;
  try {
    load(warnings);
  } catch (const SceneError& error) {
    print_warnings(warnings);
    print_warnings(error.warnings);
    throw;
  }
  print_warnings(warnings);
}

std::unique_ptr<Simulation> simulate_named(const std::string& scene, std::uint64_t seed,
                                           const NamedArguments& arguments) {
  std::shared_ptr<const Scene> loaded;
  print_warnings_of([&](std::vector<Problem>& warnings) {
    const py::gil_scoped_release others_may_run;
    loaded = loaded_scene(scene, arguments);
    warnings = loaded->warnings();
  });
  return std::make_unique<Simulation>(std::move(loaded), seed);
}

/// What no name of a model ends with.
std::string free_suffix(const World& world) {
  for (int number = 1;; ++number) {
    std::string suffix = "_added" + std::to_string(number);
    const std::vector<ObjectId> models = world.tree().models();
    const auto is_taken = [&](ObjectId id) {
      const std::string& name = world.tree().at(id).name;
      return name.size() >= suffix.size() && name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
    };
    if (std::none_of(models.begin(), models.end(), is_taken)) return suffix;
  }
}

ObjectView add_model(const py::object& owner, const std::string& text, const std::string& name,
                     const NumpyArray& position, const NumpyArray& orientation,
                     const std::map<std::string, std::string>& plugin_parameters) {
  auto& simulation = owner.cast<Simulation&>();
  const Pose pose(to_vector(position, "position"), to_quaternion(orientation, "orientation"));
  ObjectId id = kNoObject;
  {
    const py::gil_scoped_release others_may_run;
    print_warnings_of([&](std::vector<Problem>& warnings) {
      ModelDescription model = load_model(text, simulation.scene().file.parent_path(), &warnings);
      if (!name.empty()) model.name = name;
      complete_plugins(model, plugin_parameters);
      model.pose = pose * model.pose;
      id = simulation.add_model(std::move(model), &warnings);
    });
  }
  return {owner, id};
}

std::vector<ObjectView> add_foreign_models(const py::object& owner, const std::string& file) {
  auto& simulation = owner.cast<Simulation&>();
  std::vector<ObjectId> ids;
  {
    const py::gil_scoped_release others_may_run;
    print_warnings_of([&](std::vector<Problem>& warnings) {
      ids = simulation.add_models(load_foreign_models(file, free_suffix(simulation.world()), &warnings), &warnings);
    });
  }
  std::vector<ObjectView> views;
  for (const ObjectId id : ids) views.push_back({owner, id});
  return views;
}

py::bytes save(Simulation& simulation) {
  std::string state;
  {
    const py::gil_scoped_release others_may_run;
    simulation.save(state);
  }
  return py::bytes(state);
}

void restore(Simulation& simulation, const py::bytes& state) {
  const std::string_view bytes = state;
  const py::gil_scoped_release others_may_run;
  simulation.restore(bytes);
}

/// Not py::set_error, which pybind11 2.10 lacks, nor the call of a py::exception, which 2.13 deprecates.
void set_error(const py::handle& type, const std::exception& error) { PyErr_SetString(type.ptr(), error.what()); }

void bind_errors(py::module_& module) {
  static py::exception<SceneError> scene_error(module, "SceneError", PyExc_ValueError);
  static py::exception<NoSuchObject> no_such_object(module, "NoSuchObject", PyExc_LookupError);
  static py::exception<WrongObject> wrong_object(module, "WrongObject", PyExc_ValueError);
  static py::exception<Diverged> diverged(module, "Diverged", PyExc_RuntimeError);
  static py::exception<NotCarriedOut> not_carried_out(module, "NotCarriedOut", PyExc_RuntimeError);
  for (const py::handle error : {py::handle(scene_error), py::handle(no_such_object), py::handle(wrong_object),
                                 py::handle(diverged), py::handle(not_carried_out)}) {
    error.attr("__module__") = "bubblesim";  // where users import it from
  }
  // NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 requires this signature
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const SceneError& error) {
      set_error(scene_error, error);
    } catch (const NoSuchObject& error) {
      set_error(no_such_object, error);
    } catch (const WrongObject& error) {
      set_error(wrong_object, error);
    } catch (const Diverged& error) {
      set_error(diverged, error);
    } catch (const NotCarriedOut& error) {
      set_error(not_carried_out, error);
    }
  });
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_errors(module);

  py::class_<CollisionShape>(module, "CollisionShape", "A collision shape and its pose.")
      .def_readonly("object_path", &CollisionShape::object_path, "Path of its link.")
      .def_readonly("kind", &CollisionShape::kind,
                    "'box', 'sphere', 'cylinder', 'capsule', 'ellipsoid', 'mesh' or 'plane'.")
      .def_property_readonly("vertices", &vertices,
                             "Vertices of a mesh in the shape's frame, n x 3; empty for other kinds.")
      .def_readonly("size", &CollisionShape::size,
                    "Metres. box: x, y, z; sphere: radius; cylinder: radius, length; plane: its normal.")
      .def_property_readonly("position", [](const CollisionShape& s) { return to_numpy(s.pose.position); })
      .def_property_readonly(
          "orientation", [](const CollisionShape& s) { return to_numpy(s.pose.orientation); }, "Quaternion x, y, z, w.")
      .def_readonly("is_static", &CollisionShape::is_static);

  py::class_<Simulation> simulation(module, "Simulation", R"(A running scene.

Equal seeds and equal commands give bitwise equal states in every process.

:param scene: scene name ("tricycle"), path of an .sdf file, or a Scene, which several simulations may share. The
    warnings of a file that is given by name or path are printed on stderr.
:param seed: random seed of the simulation.
:param arguments: xacro arguments by name, for a .xacro file.
:raises SceneError: lists all problems of the file, each with file:line and object.)");
  // These lock the simulation themselves, or are thread-safe.
  simulation
      .def(py::init(&simulate_named), py::arg("scene"), py::kw_only(), py::arg("seed") = 0,
           py::arg("arguments") = NamedArguments())
      .def(py::init([](const std::shared_ptr<Scene>& scene, std::uint64_t seed) {
             return std::make_unique<Simulation>(scene, seed);
           }),
           py::arg("scene").none(false), py::kw_only(), py::arg("seed") = 0)
      .def(
          "step", &step_simulation, py::arg("steps") = 1, py::call_guard<py::gil_scoped_release>(),
          "Run `steps` simulation steps of `time_step` seconds, without holding the GIL.\n\n"
          ":raises Diverged: if a body's state is no longer finite; then reset the simulation or load the scene again.")
      .def("reset_world", &Simulation::reset_world, py::call_guard<py::gil_scoped_release>(),
           "Move all current models back to their initial poses; time continues, handles stay valid.\n\n"
           "Call it between steps, or in a callback for messages or service calls: there it takes effect at\n"
           "once. It also makes a diverged simulation usable again.\n\n"
           ":raises RuntimeError: in sysCall_actuation and sysCall_sensing. It waits for a step that another thread "
           "runs.")
      .def("reset", &Simulation::reset, py::call_guard<py::gil_scoped_release>(),
           "Like `reset_world`, and time starts at 0 again: the following steps bitwise equal those of a\n"
           "new simulation of these models. Mass, friction and gravity are put back too, and what the\n"
           "scene randomizes is drawn again by the seed.")
      .def("save", &save, R"(Return the state as bytes, which a file may keep.

After `restore`, this simulation or another one of the same scene, in any process, continues bit by bit as this one
did after `save`: with sensors, devices, random numbers and the seed, without child scripts.

:raises Diverged: after a divergence.)")
      .def("restore", &restore, py::arg("state"), R"(Restore a state that `save` returned.

Models that were added since are removed. Call it where `reset_world` may be called.

:raises ValueError: if the bytes are not a state of this version and scene or are damaged; nothing is changed then.
    Also if models or devices (such as plugins) are missing.)")
      .def("randomize", &randomize, py::arg("distributions"), R"(Draw quantities by the seed, and set them.

What is drawn depends on the seed, the quantity and the distribution alone: the same again after `reset`, and the same in
world i of a Batch with this seed.

:param distributions: a Distribution for each quantity that can be set, such as {"/Robot.mass": Distribution.uniform(1,
    2)}; see Batch.
:raises ValueError: if the scene does not have a quantity, or a drawn value cannot be used.)")
      .def("add_model", &add_model, py::arg("text"), py::kw_only(), py::arg("name") = "",
           py::arg("position") = py::make_tuple(0, 0, 0), py::arg("orientation") = py::make_tuple(0, 0, 0, 1),
           py::arg("plugin_parameters") = py::dict(),
           R"(Add a model and return it. Call it where `reset_world` may be called.

:param text: content of an SDFormat or URDF file with one model. Its child script is in the folder of the scene.
:param name: replaces the name in the text.
:param position: m, of the frame in which the text places the model.
:param orientation: quaternion x, y, z, w of that frame.
:param plugin_parameters: defaults for the parameters of its <plugin> elements.
:raises SceneError: lists all problems of the model, including a name that is in use.)")
      .def("add_foreign_models", &add_foreign_models, py::arg("file"),
           R"(Add the models of a file of CoppeliaSim (.ttm, .ttt) and return them: one for all that is connected.

They stand where the file has them, without a floor. Call it where `reset_world` may be called.

:raises SceneError: if the file cannot be read.)")
      .def("remove_model", &Simulation::remove_model, py::arg("handle"), py::call_guard<py::gil_scoped_release>(),
           "Remove a model and all its objects. Call it where `reset_world` may be called.\n\n"
           "Handles of its objects become invalid.")
      .def_property("brightness", &Simulation::brightness, &Simulation::set_brightness,
                    "Factor of all lights that cameras see, until the simulation is reset.")
      .def_property_readonly("seed", &Simulation::seed)
      .def_property_readonly(
          "scene", [](const Simulation& s) { return std::const_pointer_cast<Scene>(s.shared_scene()); },
          "The Scene, for other simulations of it.")
      .def_property_readonly("scene_name", [](const Simulation& s) { return s.scene().name; })
      .def_property_readonly("world_name", [](const Simulation& s) { return s.scene().world_name; })
      .def_property_readonly(
          "is_model_file", [](const Simulation& s) { return s.scene().is_model_file; },
          "Whether the scene is a single model, placed on a ground plane.")
      .def_property_readonly("scene_file", [](const Simulation& s) { return s.scene().file; })
      .def_property_readonly("world", py::overload_cast<>(&Simulation::world),
                             "The same objects by handle, as child scripts use them.");
  Guarded(simulation)
      .def_property_readonly("time", &Simulation::time, "Simulated seconds at the start of the current step.")
      .def_property_readonly("state_time", &Simulation::state_time,
                             "Simulated seconds of the state that the world shows: `time`, and after the physics of a\n"
                             "step its end. Time stamps of readings and messages.")
      .def_property_readonly("time_step", &Simulation::time_step, "Seconds per step.")
      .def_property_readonly(
          "substep", [](const Simulation& s) { return s.scene().substep; }, "Seconds per physics substep of the scene.")
      .def("set_time_step", &Simulation::set_time_step, py::arg("seconds"),
           "Set the seconds per step, 1e-4 to 10, until `reset`.")
      .def_property_readonly(
          "plugins", [](const Simulation& s) { return s.scene().plugins; },
          "The PluginDescriptions of the world itself.")
      .def_part(
          "wind",
          [](Simulation& s) {
            return Attached<Wind>{s.world(), s.wind()};
          },
          "The Wind of the simulation.")
      .def(
          "set_color",
          [](Simulation& s, ObjectId object, const std::array<float, 3>& rgb) {
            s.set_color(object, {rgb[0], rgb[1], rgb[2]});
          },
          py::arg("handle"), py::arg("color"),
          "Give all visuals of a link or model one colour: red, green, blue from 0 to 1.")
      .def(
          "color",
          [](const Simulation& s, ObjectId object) {
            const Color color = s.color(object);
            return std::array<float, 3>{color.r, color.g, color.b};
          },
          py::arg("handle"), "Return the colour that was set, or that of the first visual.")
      .def("state_hash", &Simulation::state_hash,
           "Return a 64 bit hash of the physical state; world.hpp lists what it covers.")
      .def_property_readonly("collisions", &collisions, "All collision shapes with their current poses.")
      .def("object", &find_object, py::arg("path"),
           "Return the object at a path such as /Tricycle/FrontMotor, or /FrontMotor if the name is unique.\n\n"
           ":raises NoSuchObject: with a list of similar objects.")
      .def_property_readonly("objects", &all_objects, "All objects of the scene.");

  bind_file_collections(simulation);
  module.def("scene_names", &scene_names, "Return the names of all scenes.");
  module.def("scene_folders", &scene_folders, "Return the folders that are searched for scenes.");
}

}  // namespace bubblesim::bindings
