// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/island_solvers.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

using Bodies = std::vector<dBodyID>;

void disable(const Bodies& bodies) {
  for (dBodyID body : bodies) dBodyDisable(body);
}

void enable(const Bodies& bodies) {
  for (dBodyID body : bodies) dBodyEnable(body);
}

/// The awake bodies, by solver: ODE leaves disabled bodies and what is joined to them alone.
struct Split {
  Bodies exact;
  Bodies iterated;
};

/// `iterate_all`: all islands with joints, not only those beyond the limit.
Split split(Substep& substep, bool iterate_all) {
  Islands& islands = substep.contacts.islands;
  Split made;
  for (const PlacedModel* model : substep.moving.awake) {
    const int island = islands.of(model->number);
    const bool is_iterated = islands.is_jointed(island) && (iterate_all || islands.is_beyond_limit(island));
    Bodies& bodies = is_iterated ? made.iterated : made.exact;
    for (const Link& link : model->links) {
      if (dBodyIsEnabled(link.body.get()) != 0) bodies.push_back(link.body.get());
    }
  }
  return made;
}

}  // namespace

/// Returns whether there was a solution. If not, the bodies are as before: the forces of a solver that gave up would
/// throw them about.
bool IslandSolvers::step_exactly(Substep& substep) {
  std::vector<KeptBody>& kept = bodies_before_;
  kept.clear();
  for (const PlacedModel* model : substep.moving.awake) {
    const int island = substep.contacts.islands.of(model->number);
    for (const Link& link : model->links) {
      dBodyID body = link.body.get();
      if (dBodyIsEnabled(body) != 0) kept.push_back({body, island, numbers_of(body)});
    }
  }
  dWorldStep(substep.ode.id(), substep.duration);
  if (!ode::solver_warned()) return true;
  for (const KeptBody& each : kept) set_numbers(each.body, each.numbers);
  return false;
}

/// Solves the contacts of the islands without joints one by one.
void IslandSolvers::solve_free_contacts(Substep& substep) {
  const double step = substep.duration;
  Contacts& contacts = substep.contacts;
  std::vector<FreePair>& pairs = free_pairs_;
  pairs.clear();
  ContactLookup lookup(contacts.memory);
  for (const FoundPair& pair : contacts.found.pairs) {
    const int island = contacts.islands.of(pair.first->model);
    if (!contacts.islands.is_jointed(island)) pairs.push_back({island, &pair, lookup.pair(pair)});
  }
  // By the order of the pairs within an island; a stable sort would allocate memory.
  std::sort(pairs.begin(), pairs.end(), [](const FreePair& a, const FreePair& b) {
    return std::tie(a.island, a.pair) < std::tie(b.island, b.pair);
  });
  ContactSolver& solver = contact_solver_;
  const Vector3 up = -substep.gravity.normalized();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const FreePair& free = pairs[i];
    if (i == 0 || free.island != pairs[i - 1].island) solver.clear();
    const FoundPair& pair = *free.pair;
    const int a = solver.number_of(*pair.first->link, substep.gravity, step);
    const int b = solver.number_of(*pair.second->link, substep.gravity, step);
    ExpectedContacts expected;
    if (free.remembered != nullptr) {
      expected = expect(contacts.memory, *free.remembered, pair, &contacts.found.points[pair.begin], step);
    }
    const Vector3 place = to_vector(contacts.found.points[pair.begin].contact.geom.pos);
    solver.add_pair(a, b, place, up.dot(place));
    for (std::size_t j = 0; j < static_cast<std::size_t>(pair.count); ++j) {
      solver.add_point(contacts.found.points[pair.begin + j], pair.begin + j, expected[j], step);
    }
    if (i + 1 == pairs.size() || pairs[i + 1].island != free.island) solver.solve(contacts.found.points, step);
  }
}

/// Returns whether islands with few contacts got the exact solver.
bool IslandSolvers::step_by_islands(Substep& substep, bool iterate_all) {
  const Split bodies = split(substep, iterate_all);
  if (!bodies.exact.empty()) {
    disable(bodies.iterated);
    const bool solved = step_exactly(substep);
    enable(bodies.iterated);
    if (!solved) return step_by_islands(substep, true);  // without joints there is a solution
  }
  if (!bodies.iterated.empty()) {
    disable(bodies.exact);
    ode::step_iteratively(substep.ode.id(), substep.duration, substep.ode.random);
    enable(bodies.exact);
  }
  return !iterate_all;
}

void IslandSolvers::solve_trees(Substep& substep) {
  if (substep.solver == Solver::kBubblesim) tree_solver_.solve(substep);
}

void IslandSolvers::solve_rest(Substep& substep) {
  by_trees_.clear();
  bool is_rest = false;
  Islands& islands = substep.contacts.islands;
  for (const PlacedModel* model : substep.moving.awake) {
    const bool is_by_trees = islands.is_by_trees(islands.of(model->number));
    is_rest = is_rest || !is_by_trees;
    if (!is_by_trees) continue;
    for (const Link& link : model->links) by_trees_.push_back(link.body.get());
  }
  if (!is_rest) return;
  disable(by_trees_);
  solve_without_trees(substep);
  enable(by_trees_);
}

void IslandSolvers::solve_without_trees(Substep& substep) {
  solve_free_contacts(substep);
  const bool is_exact = !substep.contacts.islands.may_be_beyond_limit();
  if ((is_exact && step_exactly(substep)) || step_by_islands(substep, is_exact)) {
    friction_iteration_.run(substep, bodies_before_);
  }
}

}  // namespace bubblesim
