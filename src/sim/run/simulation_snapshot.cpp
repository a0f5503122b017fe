// SPDX-License-Identifier: BSD-3-Clause
// Saved states of a simulation: see docs/adr/0030.
#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/state_archive.hpp"
#include "run/sensor_slot.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

constexpr std::string_view kMagic = "bubblesim state\n";
/// Increase it when what is saved changes: tests/sim/run/test_snapshot.cpp has the sizes.
constexpr std::uint32_t kVersion = 10;

struct Header {
  std::uint32_t version = kVersion;
  std::uint64_t scene = 0;     // Scene::hash()
  std::uint64_t size = 0;      // bytes after the header
  std::uint64_t checksum = 0;  // of these

  void transfer(StateArchive& archive) { archive(version, scene, size, checksum); }
};
constexpr std::size_t kHeaderSize = kMagic.size() + sizeof(std::uint32_t) + 3 * sizeof(std::uint64_t);

std::uint64_t checksum(std::string_view bytes) {
  // Words of 8 bytes: an FNV-1a of single bytes would take longer than all the rest.
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(bytes.size() - at, 8));
    sum = (sum ^ word) * 0x100000001b3ULL;
    sum ^= sum >> 29;
  }
  return sum;
}

/// What follows the header of a usable state.
std::string_view checked(std::string_view bytes, std::uint64_t scene) {
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    throw InvalidInput("these bytes are not a saved state of a simulation");
  }
  if (bytes.size() < kHeaderSize) throw InvalidInput("the saved state was cut");
  StateArchive archive(bytes.substr(kMagic.size()));
  Header header;
  archive(header);
  if (header.version != kVersion) {
    throw InvalidInput("the saved state has version " + std::to_string(header.version) + ", this program uses " +
                       std::to_string(kVersion) + "; save it again with this program");
  }
  const std::string_view rest = archive.left();
  if (rest.size() != header.size || checksum(rest) != header.checksum) {
    throw InvalidInput("the saved state is damaged: it has " + std::to_string(rest.size()) + " of " +
                       std::to_string(header.size) + " bytes, or some of them were changed");
  }
  if (header.scene != scene) {
    throw InvalidInput("the state was saved with another scene, or the scene was changed since");
  }
  return rest;
}

}  // namespace

std::string System::state_name() const { return ""; }
std::string System::save_state() { return ""; }
void System::restore_state(std::string_view) {}

/// What restore() puts back when it fails.
struct Simulation::Backup {
  std::vector<ObjectId> models;
  std::map<std::string, std::string> systems;
  std::string state;  // empty after a divergence, which cannot be saved
};

/// The states of the systems that have one, by name.
std::map<std::string, std::string> Simulation::system_states() {
  std::map<std::string, std::string> states;
  for (System* system : systems_) {
    std::string state = system->state_name().empty() ? "" : system->save_state();
    if (!state.empty()) states[system->state_name()] = std::move(state);
  }
  return states;
}

System& Simulation::system_named(const std::string& name) {
  for (System* system : systems_) {
    if (system->state_name() == name) return *system;
  }
  throw InvalidInput("the state was saved with " + name + ", which this simulation does not have");
}

void Simulation::restore_systems(const std::map<std::string, std::string>& states) {
  for (const auto& [name, state] : states) system_named(name).restore_state(state);
}

void Simulation::transfer(StateArchive& archive) {
  archive(seed_, steps_, time_step_, steps_before_, time_before_, brightness_);
  world_.transfer(archive);
  archive.require(sensors_.size(), "number of sensors");
  for (SensorSlot& slot : sensors_) {
    archive(slot.due, slot.time, slot.wanted, slot.measured, slot.shows, slot.noise_scale);
    if (slot.measured || slot.shows) archive(*slot.sensor);
  }
}

std::string Simulation::save() {
  std::string bytes;
  save(bytes);
  return bytes;
}

void Simulation::save(std::string& bytes) {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  bytes.assign(kMagic);
  bytes.resize(kHeaderSize);
  std::vector<ObjectId> models = world_.tree().models();
  std::map<std::string, std::string> systems = system_states();
  StateArchive archive(bytes);
  archive(models, systems);
  world_.transfer_layout(archive, models);
  world_.transfer_devices(archive, models);
  transfer(archive);
  Header header;
  header.scene = scene_->hash();
  header.size = bytes.size() - kHeaderSize;
  header.checksum = checksum(std::string_view(bytes).substr(kHeaderSize));
  std::string start;
  StateArchive head(start);
  head(header);
  start.copy(bytes.data() + kMagic.size(), start.size());
}

void Simulation::restore(std::string_view bytes) {
  const AccessLock::Hold hold(world_.access());
  check_may_change();
  StateArchive archive(checked(bytes, scene_->hash()));
  std::vector<ObjectId> models;
  std::map<std::string, std::string> systems;
  archive(models, systems);
  check_models(models);
  for (const auto& [name, state] : systems) system_named(name);  // throws
  world_.transfer_layout(archive, models);
  const Backup before = make_backup();
  try {
    world_.transfer_devices(archive, models);  // before models are removed, which cannot be undone
    remove_models_except(models);
    transfer(archive);
    if (!archive.left().empty()) {
      throw InvalidInput("the saved state has " + std::to_string(archive.left().size()) + " bytes too many");
    }
    restore_systems(systems);
  } catch (...) {
    put_back(before);
    throw;
  }
}

Simulation::Backup Simulation::make_backup() {
  Backup backup{world_.tree().models(), system_states(), ""};
  try {
    StateArchive archive(backup.state);
    world_.transfer_devices(archive, backup.models);
    transfer(archive);
  } catch (const Diverged&) {
    backup.state.clear();
  }
  return backup;
}

void Simulation::put_back(const Backup& backup) {
  if (backup.state.empty() || world_.tree().models() != backup.models) return;
  StateArchive archive(std::string_view{backup.state});
  world_.transfer_devices(archive, backup.models);
  transfer(archive);
  restore_systems(backup.systems);
}

void Simulation::check_models(const std::vector<ObjectId>& saved) const {
  const std::vector<ObjectId>& present = world_.tree().models();
  for (const ObjectId model : saved) {
    if (std::find(present.begin(), present.end(), model) != present.end()) continue;
    throw InvalidInput(
        "a model of the saved state is not in this simulation: it was removed since, or is one that was added while "
        "the simulation ran; restore the state in a new simulation, or add the model first");
  }
  for (const ObjectId model : present) {
    if (std::find(saved.begin(), saved.end(), model) == saved.end()) world_.models().check_removable(model);
  }
}

void Simulation::remove_models_except(const std::vector<ObjectId>& saved) {
  const std::vector<ObjectId> present = world_.tree().models();
  for (const ObjectId model : present) {
    if (std::find(saved.begin(), saved.end(), model) == saved.end()) remove_model_now(model);
  }
}

}  // namespace bubblesim
