// SPDX-License-Identifier: BSD-3-Clause
#include "load/substeps.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "load/sdf/elements/own_elements.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"
#include "validation/needed_substep.hpp"

namespace bubblesim {
namespace {

constexpr const char* kSubsteps = "bubblesim:substeps";
constexpr double kMaxSubsteps = 1000;

}  // namespace

std::optional<double> read_substeps(const SdfElement& physics, LoadContext& context) {
  if (own_text(physics, kSubsteps) == "auto") return std::nullopt;
  const double number = own_number(physics, kSubsteps, "", context).value_or(1);
  if (number >= 1 && number <= kMaxSubsteps && number == std::floor(number)) return number;
  context.report(physics.source(kSubsteps), "",
                 "<" + std::string(kSubsteps) + "> must be auto or a whole number from 1 to 1000");
  return 1;
}

void divide_substep(SceneDescription& scene, const std::optional<double>& substeps, LoadContext& context) {
  const double whole = scene.substep;
  const double most = std::min(kMaxSubsteps, std::floor(whole / kMinPhysicsStep + 1e-6));
  if (substeps) {
    scene.substep /= *substeps;
    if (*substeps > most) {
      context.report(scene.source, "",
                     "<" + std::string(kSubsteps) + "> makes the physics substep " + text(scene.substep) +
                         " s, it must be from 1e-5 to 1 s");
    }
  }
  for (const ModelDescription& model : scene.models) {
    const std::optional<NeededSubstep> needed = needed_substep(model, scene.gravity.norm());
    if (!needed || needed->step >= scene.substep) continue;
    if (!substeps) {
      scene.substep = whole / std::min(std::ceil(whole / needed->step), most);
      continue;
    }
    context.warn(model.source, "/" + model.name + "/" + needed->link,
                 "carries " + text(needed->load) +
                     " kg between its joints: its chain may break with physics substeps above " + text(needed->step) +
                     " s; set <" + kSubsteps + "> to auto in <physics>");
  }
}

}  // namespace bubblesim
