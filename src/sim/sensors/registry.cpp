// SPDX-License-Identifier: BSD-3-Clause
// The registry of sensor kinds. A new kind is a file in kinds/ and a line here.
#include <algorithm>
#include <array>
#include <deque>
#include <mutex>

#include "bubblesim/error.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {

/// Instantiated by the file of each kind (define.hpp).
template <class Kind>
std::unique_ptr<SensorDefinition> define();

/// Their order is part of the hashes of scenes: new kinds come last.
// clang-format off
const std::array kOwnKinds = {
    &define<class SonarKind>,
    &define<class LidarKind>,
    &define<class CameraKind>,
    &define<class ImuKind>,
    &define<class NavSatKind>,
    &define<class AltimeterKind>,
    &define<class MagnetometerKind>,
    &define<class ContactKind>,
    &define<class ForceTorqueKind>,
    &define<class AirPressureKind>,
    &define<class LogicalCameraKind>,
};
// clang-format on

namespace {

class Registry {
 public:
  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  void add(std::unique_ptr<SensorDefinition> definition) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& present : kinds_) refuse_clash(*present, *definition);
    kinds_.push_back(std::move(definition));
  }

  std::vector<const SensorDefinition*> all() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<const SensorDefinition*> list;
    for (const auto& kind : kinds_) list.push_back(kind.get());
    return list;
  }

  /// The place of the kind whose `table` is this one.
  std::size_t place_of(const MemberTable* SensorDefinition::*table, const MemberTable* wanted) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return find(table, wanted);
  }

  const SensorDefinition& with(const MemberTable* SensorDefinition::*table, const MemberTable* wanted) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return *kinds_[find(table, wanted)];
  }

 private:
  Registry() {
    for (const auto make : kOwnKinds) kinds_.push_back(make());
  }

  /// The mutex is locked.
  std::size_t find(const MemberTable* SensorDefinition::*table, const MemberTable* wanted) const {
    const auto found =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const auto& kind) { return (*kind).*table == wanted; });
    if (wanted != nullptr && found != kinds_.end()) return static_cast<std::size_t>(found - kinds_.begin());
    throw InvalidInput(wanted == nullptr ? "a sensor without a kind: set SensorDescription::kind"
                                         : "there is no kind of sensor with a " + wanted->name +
                                               ": add it with add_sensor_definition()");
  }

  static void refuse_clash(const SensorDefinition& present, const SensorDefinition& added) {
    for (const std::string& type : added.types) {
      const bool is_taken = std::find(present.types.begin(), present.types.end(), type) != present.types.end();
      if (!is_taken && present.renamed.count(type) == 0) continue;
      throw InvalidInput("the sensor type '" + type + "' is one of the kind '" + present.name + "'");
    }
    if (present.name == added.name || present.id == added.id || present.description == added.description ||
        present.reading == added.reading) {
      throw InvalidInput("there is a kind of sensor '" + present.name +
                         "': a kind needs its own name, id, description and reading");
    }
  }

  std::mutex mutex_;
  std::deque<std::unique_ptr<const SensorDefinition>> kinds_;
};

}  // namespace

void add_sensor_definition(std::unique_ptr<SensorDefinition> definition) {
  Registry::instance().add(std::move(definition));
}

std::vector<const SensorDefinition*> sensor_definitions() { return Registry::instance().all(); }

const SensorDefinition& definition_of(const SensorKind& kind) {
  return Registry::instance().with(&SensorDefinition::description, kind.table());
}

const SensorDefinition& definition_of(const Measurement& measurement) {
  return Registry::instance().with(&SensorDefinition::reading, measurement.table());
}

std::uint64_t hash_number(const SensorDefinition& definition) {
  const std::size_t place = Registry::instance().place_of(&SensorDefinition::description, definition.description);
  if (place < kOwnKinds.size()) return place;
  Fnv1a hash;
  hash.add(std::string_view(definition.id));
  return hash.value();
}

}  // namespace bubblesim
