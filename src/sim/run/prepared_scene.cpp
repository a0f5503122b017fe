// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/prepared_scene.hpp"

#include <utility>

#include "physics/parts/prepared_model.hpp"
#include "rays/prepared_rays.hpp"
#include "scene/described_tree.hpp"
#include "scene/prepared.hpp"
#include "scene/scene_hash.hpp"
#include "scene/unit_rotations.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim {
namespace {

SceneDescription checked(SceneDescription description) {
  std::vector<Problem> problems = check_scene(description);
  if (!problems.empty()) throw SceneError(std::move(problems));
  return description;
}

SceneDescription with_unit_rotations(SceneDescription description) {
  for (ModelDescription& model : description.models) make_rotations_unit(model);
  for (FrameDescription& frame : description.frames) make_rotation_unit(frame.pose);
  return description;
}

}  // namespace

Scene::Scene(SceneDescription description) : Scene(Checked{}, checked(std::move(description)), {}) {}

Scene::Scene(Checked, SceneDescription description, std::vector<Problem> warnings)
    : description_(std::make_shared<const SceneDescription>(with_unit_rotations(std::move(description)))),
      warnings_(std::move(warnings)) {
  auto tree = std::make_shared<SceneTree>();
  auto prepared = std::make_unique<Prepared>();
  DescribedTree described(*tree);
  for (const ModelDescription& model : description_->models) {
    described.add(model);
    // Shares the ownership of the whole description.
    prepared->models.push_back(prepare_model({description_, &model}, &warnings_));
  }
  for (std::size_t i = 0; i < description_->frames.size(); ++i) described.add(description_->frames[i], i);
  described.arrange();
  tree_ = std::move(tree);
  prepared_ = std::move(prepared);
}

std::shared_ptr<const Scene> Scene::of_checked(SceneDescription description, std::vector<Problem> warnings) {
  return std::shared_ptr<const Scene>(new Scene(Checked{}, std::move(description), std::move(warnings)));
}

Scene::~Scene() = default;

const rays::PreparedRays& Scene::Prepared::rays(const Scene& scene) const {
  std::call_once(rays_made_, [&] {
    auto made = std::make_shared<rays::PreparedRays>();
    for (std::size_t i = 0; i < scene.description().models.size(); ++i) {
      made->models.push_back(
          rays::prepare_rays(*scene.tree(), scene.tree()->models()[i], scene.description().models[i]));
    }
    made->statics = rays::gather_statics(made->models);
    rays_ = std::move(made);
  });
  return *rays_;
}

std::uint64_t Scene::hash() const { return prepared_->hash(*this); }

std::uint64_t Scene::Prepared::hash(const Scene& scene) const {
  std::call_once(hash_made_, [&] { hash_ = hash_of(scene.description()); });
  return hash_;
}

const std::shared_ptr<const std::string>& Scene::Prepared::start(const std::function<std::string()>& save) const {
  std::call_once(start_made_, [&] { start_ = std::make_shared<const std::string>(save()); });
  return start_;
}

}  // namespace bubblesim
