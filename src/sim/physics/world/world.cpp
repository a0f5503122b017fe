// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/world.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"
#include "physics/world/state.hpp"
#include "scene/prepared.hpp"

namespace bubblesim {
namespace {

/// Moves the static models, whose places in the list are free, with their spaces.
void take_statics(WorldState& state, WorldState& from) {
  state.spaces.statics = std::move(from.spaces.statics);
  state.spaces.planes = std::move(from.spaces.planes);
  state.model_at.resize(state.tree().places());
  for (std::size_t i = 0; i < state.models.size(); ++i) {
    if (state.models[i] != nullptr) continue;
    state.models[i] = std::move(from.models[i]);
    for (Collider& collider : state.models[i]->colliders) collider.own_surface.reset();
    for (std::size_t k = 0; k < state.models[i]->sensors.size(); ++k) {
      state.models[i]->sensors[k] = state.models[i]->described_sensors[k]->pose;
    }
    state.model_at[SceneTree::index_of(state.models[i]->object)] = state.models[i].get();
    for (std::size_t k = 0; k < state.models[i]->links.size(); ++k) {
      Link& link = state.models[i]->links[k];
      link.carrier = kNoObject;
      if (state.moved_statics.count(link.object) == 0) continue;
      place_static(state, link.object, state.models[i]->description.pose * state.models[i]->description.links[k].pose);
    }
    place_frames(state, *state.models[i]);
  }
}

}  // namespace

void check_not_diverged(const WorldState& state) {
  if (state.diverged) throw Diverged("the physics diverged earlier; reset the world or load the scene again");
}

void DiscardWorldState::operator()(WorldState* state) const {
  // When ODE was left in the middle of a step, its spaces may be locked, and destroying them would fail its assertions.
  if (!state->interrupted) std::default_delete<WorldState>()(state);
}

World::World(const Scene& scene, std::uint64_t seed) {
  build(scene, seed);
  start_ = scene.prepared().start([&] {
    std::string saved;
    StateArchive archive(saved);
    transfer_physics(archive, *state_);
    return saved;
  });
}

void World::build(const Scene& scene, std::uint64_t seed) {
  state_.reset(std::make_unique<WorldState>(scene.description().gravity, seed).release());
  state_->shared_tree = scene.tree();
  state_->solver = scene.description().solver;
  state_->scene_frames = scene.shared_frames();
  place_frames(*state_, *state_->scene_frames);
  for (std::size_t i = 0; i < scene.prepared().models.size(); ++i) {
    place_model(*state_, scene.tree()->models()[i], scene.prepared().models[i]);
  }
  gather_statics(*state_);
  list_moving(*state_);
  for (const auto& model : state_->models) attach_statics(*state_, *model);
  find_leaders(*state_);
}

void World::rebuild(const Scene& scene) {
  std::vector<DeviceSlot> devices = std::move(state_->devices);
  ContactFilter filter = std::move(state_->contacts.filter);
  const std::uint64_t revision = state_->revision + 1;
  build(scene, state_->seed);
  const auto is_left_over = [&](const DeviceSlot& slot) {  // of a model that is not of the scene
    return slot.model != kNoObject && !tree().contains(slot.model);
  };
  devices.erase(std::remove_if(devices.begin(), devices.end(), is_left_over), devices.end());
  state_->devices = std::move(devices);
  state_->contacts.filter = std::move(filter);
  state_->revision = revision;
}

void World::set_seed(std::uint64_t seed) {
  state_->seed = seed;
  state_->ode.random = static_cast<std::uint32_t>(seed);
}

World::World(SceneDescription scene, std::uint64_t seed) : World(Scene(std::move(scene)), seed) {}

World::~World() = default;

void World::reset() {
  if (state_->has_scene_models && !state_->interrupted) {
    state_->ode.random = static_cast<std::uint32_t>(state_->seed);
    StateArchive archive(std::string_view{*start_});
    transfer_physics(archive, *state_);
    reset_devices(*this, std::move(state_->devices), *state_);
    return;
  }
  // Moving models are rebuilt, because ODE keeps more state than poses and velocities: forces of the last step, the
  // order of its lists. Static models have no state.
  const bool keeps_statics = !state_->interrupted;
  WorldStateHandle built(std::make_unique<WorldState>(state_->first_gravity, state_->seed).release());
  built->solver = state_->solver;
  built->shared_tree = state_->shared_tree;
  built->own_tree = state_->own_tree;
  built->frames = std::move(state_->frames);
  built->revision = state_->revision;
  built->has_scene_models = state_->has_scene_models;
  built->moved_statics = state_->moved_statics;
  built->contacts.filter = std::move(state_->contacts.filter);
  for (const auto& model : state_->models) {
    if (keeps_statics && model->space == nullptr) {
      built->models.push_back(nullptr);
    } else {
      place_model(*built, model->object, model->prepared);
    }
  }
  if (keeps_statics) take_statics(*built, *state_);
  place_frames(*built, *state_->scene_frames);
  built->scene_frames = std::move(state_->scene_frames);
  if (!keeps_statics || state_->statics_stale) gather_statics(*built);
  list_moving(*built);
  for (const auto& model : built->models) attach_statics(*built, *model);
  find_leaders(*built);
  std::vector<DeviceSlot> devices = std::move(state_->devices);
  state_ = std::move(built);
  reset_devices(*this, std::move(devices), *state_);
}

const SceneTree& World::tree() const { return state_->tree(); }

const std::set<ObjectId>& World::moved_statics() const { return state_->moved_statics; }

std::uint64_t World::revision() const { return state_->revision; }

bool World::has_scene_models() const { return state_->has_scene_models; }

}  // namespace bubblesim
