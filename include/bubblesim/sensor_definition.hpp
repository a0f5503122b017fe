// SPDX-License-Identifier: BSD-3-Clause
// A kind of sensor, in one object: its types in SDFormat, its parameters and readings, how it is read, checked and
// made. bubblesim's own kinds are listed in src/sim/sensors/registry.cpp; a program adds others with
// add_sensor_definition().
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bubblesim/row.hpp"
#include "bubblesim/sensor.hpp"
#include "bubblesim/sensor_check.hpp"
#include "bubblesim/sensor_element.hpp"
#include "bubblesim/sensor_kinds.hpp"

namespace bubblesim {

/// Where a sensor is made.
struct SensorSite {
  ObjectId id;
  const World& world;
  const Environment& environment;
};

/// What a batch observes of the sensors of a kind.
struct ReadingQuantity {
  std::string name;
  std::string unit;
  std::string doc;
  /// Empty for sensors of the kind that do not have it; an empty list: a single number.
  std::function<std::optional<Sizes>(const SensorKind&)> shape;
  /// Appends as many numbers.
  std::function<void(const Measurement&, const World&, ObjectId sensor, Row&)> put;
};

/// Derive a kind from SensorDefinitionOf, which has the types.
class SensorDefinition {
 public:
  virtual ~SensorDefinition() = default;
  SensorDefinition(const SensorDefinition&) = delete;
  SensorDefinition& operator=(const SensorDefinition&) = delete;

  std::string name;                ///< in messages: "/Robot/Imu is a IMU, not a lidar"
  std::string id;                  ///< in the window
  std::string reader;              ///< bubblesim._core.read_READER reads sensors of this kind only; empty: none
  std::vector<std::string> types;  ///< SDFormat's, as files have them
  std::map<std::string, std::string> renamed;  ///< types that have a newer name, which is in `types`
  /// Its lines in the table of elements: those below <sensor>, indented as there, and definitions that they refer to.
  std::string elements;
  bool of_joint = false;  ///< it is mounted on a joint, not on a link
  const MemberTable* description = nullptr;
  const MemberTable* reading = nullptr;
  /// What observe() can return: the members of the reading that are quantities, then others.
  std::vector<ReadingQuantity> quantities;

  /// Empty when the element cannot be used; the reason is reported.
  virtual std::optional<SensorKind> read_kind(SensorElement& sensor) const = 0;
  /// Reports what cannot be simulated, besides the limits of the members.
  virtual void check_kind(SensorCheck& check, const SensorKind& kind) const = 0;
  virtual std::unique_ptr<Sensor> make_sensor(const SensorKind& kind, const SensorSite& site) const = 0;

 protected:
  SensorDefinition() = default;
};

/// The quantity of a member whose size is fixed; it refers to the member.
ReadingQuantity quantity_of(const Member& member);

/// A kind with its description and reading, structs that list their members (member_table.hpp).
template <class Description, class Measured>
class SensorDefinitionOf : public SensorDefinition {
 public:
  virtual std::optional<Description> read(SensorElement& sensor) const = 0;
  virtual void check(SensorCheck&, const Description&) const {}
  virtual std::unique_ptr<Sensor> make(const Description& description, const SensorSite& site) const = 0;

  std::optional<SensorKind> read_kind(SensorElement& sensor) const final {
    std::optional<Description> found = read(sensor);
    return found ? std::make_optional<SensorKind>(std::move(*found)) : std::nullopt;
  }
  void check_kind(SensorCheck& to, const SensorKind& kind) const final { check(to, kind.get<Description>()); }
  std::unique_ptr<Sensor> make_sensor(const SensorKind& kind, const SensorSite& site) const final {
    return make(kind.get<Description>(), site);
  }

 protected:
  /// `kind_types`: SDFormat's types; the first one is also the id.
  SensorDefinitionOf(std::string kind_name, std::vector<std::string> kind_types) {
    name = std::move(kind_name);
    id = kind_types.front();
    reader = id;
    types = std::move(kind_types);
    description = &Description::members();
    reading = &Measured::members();
    for (const Member& member : reading->members) {
      if (!member.quantity.empty()) quantities.push_back(quantity_of(member));
    }
  }

  /// Adds a quantity. `shape`: Sizes, or a function of the description that returns optional Sizes. `put` takes the
  /// reading and a Row; or the reading, the description and a Row.
  template <class Shape, class Put>
  void observe(std::string quantity, std::string unit, std::string doc, Shape shape, Put put) {
    ReadingQuantity made;
    made.name = std::move(quantity);
    made.unit = std::move(unit);
    made.doc = std::move(doc);
    made.shape = [shape](const SensorKind& kind) -> std::optional<Sizes> {
      if constexpr (std::is_invocable_v<Shape, const Description&>) {
        return shape(kind.get<Description>());
      } else {
        return shape;
      }
    };
    made.put = [put](const Measurement& measured, const World& world, ObjectId sensor, Row& row) {
      if constexpr (std::is_invocable_v<Put, const Measured&, Row&>) {
        put(measured.get<Measured>(), row);
      } else {
        put(measured.get<Measured>(), world.models().sensor_description(sensor).kind.template get<Description>(), row);
      }
    };
    quantities.push_back(std::move(made));
  }
};

/// Adds a kind to this process. Call it before scenes with such sensors are loaded, from any thread; kinds are never
/// removed. Throws InvalidInput when a type or name is one of another kind.
void add_sensor_definition(std::unique_ptr<SensorDefinition> definition);

/// All kinds: bubblesim's own, then those that were added.
std::vector<const SensorDefinition*> sensor_definitions();

/// Throw InvalidInput when there is no such kind, such as for an empty one.
const SensorDefinition& definition_of(const SensorKind& kind);
const SensorDefinition& definition_of(const Measurement& measurement);

/// In the hash of a scene: the place of bubblesim's own kinds in their list, the name of others.
std::uint64_t hash_number(const SensorDefinition& definition);

}  // namespace bubblesim
