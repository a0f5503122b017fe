// SPDX-License-Identifier: BSD-3-Clause
// One substep of all islands, each with the solver that suits it: see docs/adr/0024.
#include <algorithm>
#include <vector>

#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

using Bodies = std::vector<dBodyID>;

void disable(const Bodies& bodies) {
  for (dBodyID body : bodies) dBodyDisable(body);
}

void enable(const Bodies& bodies) {
  for (dBodyID body : bodies) dBodyEnable(body);
}

/// Returns whether there was a solution. If not, the bodies are as before: the forces of a solver that gave up would
/// throw them about.
bool step_exactly(World::State& state, double step) {
  std::vector<KeptBody>& kept = state.bodies_before;
  kept.clear();
  for (std::size_t i = 0; i < state.moving.size(); ++i) {
    const int island = state.islands.of(static_cast<int>(i));
    for (const Link& link : state.moving[i]->links) {
      dBodyID body = link.body.get();
      if (dBodyIsEnabled(body) != 0) kept.push_back({body, island, numbers_of(body)});
    }
  }
  dWorldStep(state.world.get(), step);
  if (!ode::solver_warned()) return true;
  for (const KeptBody& each : kept) set_numbers(each.body, each.numbers);
  return false;
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
  const Vector3 up = -state.gravity.normalized();
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
      const double height = up.dot(to_vector(point.contact.geom.pos));
      solver.add_point(a, b, point, pair.begin + j, expected[j], height, step);
    }
    if (i + 1 == pairs.size() || pairs[i + 1].island != free.island) solver.solve(state.found.points, step);
  }
}

/// The awake bodies, by solver: ODE leaves disabled bodies and what is joined to them alone.
struct Split {
  Bodies exact;
  Bodies iterated;
};

/// `iterate_all`: all islands with joints, not only those beyond the limit.
Split split(World::State& state, bool iterate_all) {
  Split made;
  for (std::size_t i = 0; i < state.moving.size(); ++i) {
    const int island = state.islands.of(static_cast<int>(i));
    Bodies& bodies = state.islands.is_jointed(island) && (iterate_all || state.islands.is_beyond_limit(island))
                         ? made.iterated
                         : made.exact;
    for (const Link& link : state.moving[i]->links) {
      if (dBodyIsEnabled(link.body.get()) != 0) bodies.push_back(link.body.get());
    }
  }
  return made;
}

/// Returns whether islands with few contacts got the exact solver.
bool step_by_islands(World::State& state, double step, bool iterate_all) {
  const Split bodies = split(state, iterate_all);
  if (!bodies.exact.empty()) {
    disable(bodies.iterated);
    const bool solved = step_exactly(state, step);
    enable(bodies.iterated);
    if (!solved) return step_by_islands(state, step, true);  // without joints there is a solution
  }
  if (!bodies.iterated.empty()) {
    disable(bodies.exact);
    ode::step_iteratively(state.world.get(), step, state.random);
    enable(bodies.exact);
  }
  return !iterate_all;
}

}  // namespace

void solve(World::State& state, double step) {
  solve_free_contacts(state, step);
  const bool is_exact = !state.islands.may_be_beyond_limit();
  if ((is_exact && step_exactly(state, step)) || step_by_islands(state, step, is_exact)) {
    state.friction_iteration.run(state, step);
  }
}

}  // namespace bubblesim
