// SPDX-License-Identifier: BSD-3-Clause
// Which sensor kinds there are.
#include "kinds.hpp"

namespace bubblesim {
namespace {

struct SensorMaker {
  ObjectId id;
  const World& world;

  std::unique_ptr<Sensor> operator()(const SonarDescription& sonar) const { return make_sonar(sonar, id, world); }
};

}  // namespace

std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, ObjectId id, const World& world) {
  return std::visit(SensorMaker{id, world}, description.kind);
}

}  // namespace bubblesim
