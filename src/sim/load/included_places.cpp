// SPDX-License-Identifier: BSD-3-Clause
#include "load/included_places.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace bubblesim {
namespace {

/// Calls `visit` for the place of each part of the model that has one, with the part's alias.
template <class Model, class Visit>
void visit_places(Model& model, const Visit& visit) {
  const auto visit_all = [&visit](auto& parts) {
    for (auto& part : parts) {
      if (part.place) visit(*part.place, part.alias);
    }
  };
  for (auto& link : model.links) visit_all(link.sensors);
  for (auto& joint : model.joints) visit_all(joint.sensors);
  visit_all(model.links);
  visit_all(model.joints);
  visit_all(model.frames);
}

std::set<int> ids_of(const ModelDescription& model) {
  std::set<int> ids;
  visit_places(model, [&ids](const TreePlace& place, const std::string&) { ids.insert(place.id); });
  return ids;
}

/// The first number above those of all places of a scene.
int free_place(const SceneDescription& scene) {
  int next = 0;
  const auto above = [&next](const TreePlace& place, const std::string&) { next = std::max(next, place.id + 1); };
  for (const ModelDescription& model : scene.models) visit_places(model, above);
  for (const FrameDescription& frame : scene.frames) {
    if (frame.place) above(*frame.place, frame.alias);
  }
  return next;
}

}  // namespace

void renumber_places(const std::vector<ModelDescription*>& included, const SceneDescription& scene) {
  std::map<int, int> numbers{{-1, -1}};
  int next = free_place(scene);
  for (const ModelDescription* model : included) {
    for (const int id : ids_of(*model)) numbers.emplace(id, next++);
  }
  for (ModelDescription* model : included) {
    visit_places(*model, [&](TreePlace& place, const std::string&) {
      place.id = numbers.at(place.id);
      const auto parent = numbers.find(place.parent);
      place.parent = parent == numbers.end() ? -1 : parent->second;
    });
  }
}

void set_top_alias(const std::vector<ModelDescription*>& included, const std::string& alias) {
  std::set<int> ids;
  for (const ModelDescription* model : included) ids.merge(ids_of(*model));
  for (ModelDescription* model : included) {
    visit_places(*model, [&](const TreePlace& place, std::string& its_alias) {
      if (ids.count(place.parent) == 0) its_alias = alias;
    });
  }
}

void give_to_top(ModelDescription& model) {
  if (!model.alias.empty()) set_top_alias({&model}, model.alias);
  if (model.child_script.empty()) return;
  const std::set<int> ids = ids_of(model);
  visit_places(model, [&](TreePlace& place, const std::string&) {
    const bool is_first = !model.child_script.empty() && ids.count(place.parent) == 0;
    if (is_first) place.child_script = std::exchange(model.child_script, {});
  });
}

void separate_included_places(SceneDescription& scene) {
  std::set<int> taken;
  for (const FrameDescription& frame : scene.frames) {
    if (frame.place) taken.insert(frame.place->id);
  }
  for (ModelDescription& model : scene.models) {
    const std::set<int> ids = ids_of(model);
    const bool is_included = model.source.file != scene.source.file;
    const auto is_taken = [&taken](int id) { return taken.count(id) > 0; };
    if (is_included && std::any_of(ids.begin(), ids.end(), is_taken)) renumber_places({&model}, scene);
    taken.merge(ids_of(model));
  }
}

}  // namespace bubblesim
