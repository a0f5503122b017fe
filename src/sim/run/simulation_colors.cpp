// SPDX-License-Identifier: BSD-3-Clause
// The colours of objects and the brightness of lights, which can be changed while the simulation exists.
#include <cmath>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "rays/ray_scene.hpp"
#include "run/sensor_slot.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

/// The links of a model, or the link itself.
std::vector<ObjectId> coloured_links(const SceneTree& tree, ObjectId object) {
  const ObjectKind kind = tree.at(object).kind;
  if (kind == ObjectKind::kLink) return {object};
  if (kind == ObjectKind::kModel) return tree.parts(object, ObjectKind::kLink);
  throw WrongObject(tree.short_path(object) + " is a " + std::string(kind_name(kind)) +
                    ", which has no colour: links and models have one");
}

}  // namespace

void Simulation::set_color(ObjectId object, const Color& color) {
  const std::vector<ObjectId> links = coloured_links(world_.tree(), object);
  for (const float part : {color.r, color.g, color.b}) {
    if (part >= 0 && part <= 1) continue;
    throw InvalidInput(world_.tree().short_path(object) + ": red, green and blue must be from 0 to 1, found " +
                       std::to_string(part));
  }
  for (const ObjectId link : links) rays_->set_color(link, color);
}

void Simulation::set_brightness(double brightness) {
  if (!(brightness >= 0 && std::isfinite(brightness))) {
    throw InvalidInput("the brightness " + text(brightness) + " is not usable: it must be 0 or more");
  }
  brightness_ = brightness;
}

Color Simulation::color(ObjectId object) const {
  const SceneTree& tree = world_.tree();
  for (const ObjectId link : coloured_links(tree, object)) {
    if (const Color* own = rays_->color(link)) return *own;
    const LinkDescription& description = world_.models().description(link).links[tree.at(link).index];
    if (!description.visuals.empty()) return description.visuals.front().material.diffuse;
  }
  return Material().diffuse;
}

}  // namespace bubblesim
