// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/quantity.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "run/quantity_kinds.hpp"

namespace bubblesim {
namespace {

using Kind = Quantities::Kind;
using Use = Quantities::Use;

/// The parts of `PATH.QUANTITY@PATH`.
struct Parts {
  std::string path;
  std::string quantity;
  std::string relative_to;
};

Parts parts_of(const std::string& name) {
  Parts parts;
  const std::size_t at = name.find('@');
  if (at != std::string::npos) parts.relative_to = name.substr(at + 1);
  const std::string left = name.substr(0, at);
  const std::size_t dot = left.rfind('.');
  if (dot == std::string::npos) {
    throw InvalidInput("'" + name + "' is not a quantity: write PATH.QUANTITY, such as /Tricycle.pose");
  }
  parts.path = left.substr(0, dot);
  parts.quantity = left.substr(dot + 1);
  return parts;
}

bool can(const Kind& kind, Use use) { return use == Use::kObserve ? kind.observe != nullptr : kind.command != nullptr; }

/// The quantities of a sensor's readings; those of all kinds for kNoObject.
std::vector<const ReadingQuantity*> of_readings(const World& world, ObjectId object) {
  std::vector<const SensorDefinition*> kinds;
  if (object == kNoObject) {
    kinds = sensor_definitions();
  } else if (world.tree().at(object).kind == ObjectKind::kSensor) {
    kinds = {&definition_of(world.models().sensor_description(object).kind)};
  }
  std::vector<const ReadingQuantity*> all;
  for (const SensorDefinition* kind : kinds) {
    for (const ReadingQuantity& quantity : kind->quantities) {
      if (object == kNoObject || quantity.shape(world.models().sensor_description(object).kind))
        all.push_back(&quantity);
    }
  }
  return all;
}

/// Null when there is none.
const ReadingQuantity* of_reading(const World& world, ObjectId object, const std::string& name) {
  for (const ReadingQuantity* quantity : of_readings(world, object)) {
    if (quantity->name == name) return quantity;
  }
  return nullptr;
}

std::string names_of(const World& world, ObjectId object, Use use) {
  std::vector<std::string> names;
  for (const Kind& kind : quantity_kinds()) {
    if (can(kind, use) && (object == kNoObject || kind.shape(world, object))) names.emplace_back(kind.name);
  }
  if (use == Use::kObserve) {
    for (const ReadingQuantity* quantity : of_readings(world, object)) names.push_back(quantity->name);
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Null when it is a quantity of readings. Throws InvalidInput when there is none of that name.
const Kind* kind_named(const World& world, const std::string& name, const std::string& quantity, Use use) {
  for (const Kind& kind : quantity_kinds()) {
    if (kind.name == quantity && can(kind, use)) return &kind;
  }
  if (use == Use::kObserve && of_reading(world, kNoObject, quantity) != nullptr) return nullptr;
  throw InvalidInput("'" + name + "': there is no " + (use == Use::kObserve ? "observation" : "action") + " '" +
                     quantity + "'; there are " + names_of(world, kNoObject, use));
}

/// All objects that a path stands for; one without wildcards.
std::vector<ObjectId> objects_at(const SceneTree& tree, const std::string& path) {
  std::vector<ObjectId> found{tree.find(path)};
  if (path.find('*') == std::string::npos) return found;
  try {
    while (true) found.push_back(tree.find(path, kNoObject, found.size()));
  } catch (const NoSuchObject&) {
    // These are all.
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Quantities::Quantities(Simulation& example, const std::vector<std::string>& names, Use use) {
  for (const std::string& name : names) add(example, name, use);
}

void Quantities::add(Simulation& example, const std::string& name, Use use) {
  const World& world = example.world();
  for (const Kind& kind : world_quantity_kinds()) {
    if (kind.name == name && can(kind, use)) return add({&kind}, *kind.shape(world, kNoObject), name);
  }
  const Parts parts = parts_of(name);
  const Kind* kind = kind_named(world, name, parts.quantity, use);
  ObjectId relative_to = kNoObject;
  if (!parts.relative_to.empty()) {
    if (kind == nullptr || !kind->relative || use == Use::kCommand) {
      throw InvalidInput("'" + name + "': " + parts.quantity + " cannot be relative to another object");
    }
    relative_to = world.tree().find(parts.relative_to);
  }
  const std::vector<ObjectId> objects = objects_at(world.tree(), parts.path);
  const std::size_t before = list_.size();
  for (const ObjectId object : objects) {
    const ReadingQuantity* reading = kind == nullptr ? of_reading(world, object, parts.quantity) : nullptr;
    if (kind == nullptr && reading == nullptr) continue;
    const auto shape =
        kind != nullptr ? kind->shape(world, object) : reading->shape(world.models().sensor_description(object).kind);
    if (!shape || (use == Use::kCommand && kind->relative && world.models().description(object).is_static)) continue;
    std::string full = world.tree().path(object) + "." + parts.quantity;
    if (relative_to != kNoObject) full += "@" + world.tree().path(relative_to);
    add({kind, reading, object, relative_to}, *shape, full);
  }
  if (list_.size() > before) return;
  const ObjectId object = objects.front();
  throw WrongObject("'" + name + "': " + world.tree().short_path(object) + " is a " +
                    std::string(kind_name(world.tree().at(object).kind)) + " without " + parts.quantity + "; it has " +
                    names_of(world, object, use));
}

void Quantities::add(const Target& target, std::vector<std::size_t> shape, std::string name) {
  const std::size_t size = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  list_.push_back({std::move(name), std::move(shape), width_, size});
  targets_.push_back(target);
  width_ += size;
}

void Quantities::observe(Simulation& simulation, Row row) const {
  for (const Target& target : targets_) {
    if (target.of_reading != nullptr) {
      const std::shared_ptr<const Reading> reading = simulation.read(target.object);
      target.of_reading->put(reading->measurement, simulation.world(), target.object, row);
    } else {
      target.kind->observe(simulation, {target.object, target.relative_to}, row);
    }
  }
}

void Quantities::command(Simulation& simulation, Row row) const {
  for (const Target& target : targets_) target.kind->command(simulation, target.object, row);
}

}  // namespace bubblesim
