// SPDX-License-Identifier: BSD-3-Clause
// One substep of all islands, each with the solver that suits it: see docs/adr/0024.
#include <algorithm>
#include <vector>

#include "physics/world_state.hpp"

namespace bubblesim {
namespace {

/// Substeps with the iterative solver after the exact solver found no solution.
constexpr int kStepsToIterate = 20;

using Bodies = std::vector<dBodyID>;

void disable(const Bodies& bodies) {
  for (dBodyID body : bodies) dBodyDisable(body);
}

void enable(const Bodies& bodies) {
  for (dBodyID body : bodies) dBodyEnable(body);
}

void step_exactly(World::State& state, double step) {
  dWorldStep(state.world.get(), step);
  if (ode::solver_warned()) state.steps_to_iterate = kStepsToIterate;
}

/// Solves the contacts of the islands without joints one by one.
void solve_free_contacts(World::State& state, double step) {
  std::vector<FreePair>& pairs = state.free_pairs;
  pairs.clear();
  Recollection recollection(state.memory);
  for (const FoundPair& pair : state.found.pairs) {
    const int island = state.islands.of(pair.first->island);
    if (!state.islands.is_jointed(island)) pairs.push_back({island, &pair, recollection.pair(pair)});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const FreePair& a, const FreePair& b) { return a.island < b.island; });
  ContactSolver& solver = state.contact_solver;
  const Vector3 up = -state.gravity.Normalized();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const FreePair& free = pairs[i];
    if (i == 0 || free.island != pairs[i - 1].island) solver.clear();
    const FoundPair& pair = *free.pair;
    const int a = solver.number_of(*pair.first->link, state.gravity, step);
    const int b = solver.number_of(*pair.second->link, state.gravity, step);
    ExpectedContacts expected;
    if (free.remembered != nullptr) {
      expected = expect(state.memory, *free.remembered, pair, &state.found.points[pair.begin], step);
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(pair.count); ++j) {
      const FoundContact& point = state.found.points[pair.begin + j];
      const Vector3 normal = to_vector(point.contact.geom.normal);
      solver.add_point(a, b, point, pair.begin + j, normal * expected[j].normal + expected[j].friction,
                       up.Dot(to_vector(point.contact.geom.pos)), step);
    }
    if (i + 1 == pairs.size() || pairs[i + 1].island != free.island) solver.solve(state.found.points, step);
  }
}

/// The awake bodies, by solver: ODE leaves disabled bodies and what is joined to them alone.
struct Split {
  Bodies exact;
  Bodies iterated;
};

Split split(World::State& state) {
  Split made;
  for (std::size_t i = 0; i < state.moving.size(); ++i) {
    const int island = state.islands.of(static_cast<int>(i));
    Bodies& bodies = state.islands.is_jointed(island) && state.iterates(island) ? made.iterated : made.exact;
    for (const Link& link : state.moving[i]->links) {
      if (dBodyIsEnabled(link.body.get()) != 0) bodies.push_back(link.body.get());
    }
  }
  return made;
}

}  // namespace

void solve(World::State& state, double step) {
  solve_free_contacts(state, step);
  if (state.steps_to_iterate == 0 && !state.islands.may_be_beyond_limit()) {
    step_exactly(state, step);
    return;
  }
  const Split bodies = split(state);
  state.steps_to_iterate = std::max(state.steps_to_iterate - 1, 0);
  if (!bodies.exact.empty()) {
    disable(bodies.iterated);
    step_exactly(state, step);
    enable(bodies.iterated);
  }
  if (!bodies.iterated.empty()) {
    disable(bodies.exact);
    ode::step_iteratively(state.world.get(), step, state.random);
    enable(bodies.exact);
  }
}

}  // namespace bubblesim
