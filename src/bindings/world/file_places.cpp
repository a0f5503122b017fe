// SPDX-License-Identifier: BSD-3-Clause
#include "world/file_places.hpp"

#include <pybind11/stl.h>

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bubblesim/world.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// The place of an object in its file's tree; null if it has none.
const TreePlace* place_of(const World& world, ObjectId id) {
  const Object& object = world.tree().at(id);
  const auto of_part = [](const auto& part) { return part.place ? &*part.place : nullptr; };
  switch (object.kind) {
    case ObjectKind::kLink:
      return of_part(world.models().description(id).links[object.index]);
    case ObjectKind::kJoint:
      return of_part(world.models().description(id).joints[object.index]);
    case ObjectKind::kSensor:
      return of_part(world.models().sensor_description(id));
    case ObjectKind::kFrame:
      return world.frames().place(id);
    default:
      return nullptr;
  }
}

ObjectId find_old_name(const World& world, const std::string& name) {
  for (const ObjectId id : world.tree().objects()) {
    const TreePlace* place = place_of(world, id);
    if (place != nullptr && place->old_name == name) return id;
  }
  return kNoObject;
}

std::vector<std::tuple<std::string, std::string, std::string>> script_parameters(const World& world, ObjectId object) {
  std::vector<std::tuple<std::string, std::string, std::string>> found;
  if (const TreePlace* place = place_of(world, object)) {
    for (const ScriptParameter& each : place->parameters) found.emplace_back(each.name, each.unit, each.value);
  }
  return found;
}

std::map<std::string, py::bytes> file_data(const World& world, ObjectId object) {
  std::map<std::string, py::bytes> found;
  if (const TreePlace* place = place_of(world, object)) {
    for (const auto& [name, bytes] : place->data) found.emplace(name, py::bytes(bytes));
  }
  return found;
}

/// The name of each, and its items: object, tree, chain or all; the object, -1 for all; whether it removes them. Items
/// whose object is not there are left out.
using Collections = std::vector<std::pair<std::string, std::vector<std::tuple<std::string, ObjectId, bool>>>>;

Collections collections(const Simulation& simulation) {
  static const char* const kNames[] = {"object", "tree", "chain", "all"};
  std::map<int, ObjectId> places;
  for (const ObjectId id : simulation.world().tree().objects()) {
    if (const TreePlace* place = place_of(simulation.world(), id)) places.emplace(place->id, id);
  }
  Collections all;
  for (const CollectionDescription& described : simulation.scene().collections) {
    auto& [name, items] = all.emplace_back(described.name, std::vector<std::tuple<std::string, ObjectId, bool>>());
    for (const CollectionDescription::Item& item : described.items) {
      const auto place = places.find(item.id);
      const bool is_all = item.what == CollectionDescription::What::kAll;
      if (!is_all && place == places.end()) continue;
      items.emplace_back(kNames[static_cast<int>(item.what)], is_all ? kNoObject : place->second, item.removes);
    }
  }
  return all;
}

}  // namespace

void bind_file_places(py::class_<World>& world) {
  world
      .def(
          "old_name",
          [](const World& w, ObjectId id) {
            const TreePlace* place = place_of(w, id);
            return place == nullptr ? std::string() : place->old_name;
          },
          py::arg("object"),
          "Return the unique name of an object in an old scene, such as 'wheel#0'; '' if it has none.")
      .def("find_old_name", &find_old_name, py::arg("name"),
           "Return the object with a unique name of an old scene, -1 if there is none.")
      .def(
          "script_parameters", &script_parameters, py::arg("object"),
          "Return the parameters that the scene's file gives to the script of an object: (name, unit, value), as text.")
      .def("file_data", &file_data, py::arg("object"),
           "Return the bytes that the scene's file attaches to an object, by name.");
}

void bind_file_collections(py::class_<Simulation>& simulation) {
  simulation.def(
      "file_collections", &collections,
      "Return the collections of the scene's file: for each its name and items. An item is 'object', 'tree', "
      "'chain' or 'all', the object, and whether it removes instead of adds.");
}

}  // namespace bubblesim::bindings
