// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/friction_iteration.hpp"

#include <algorithm>
#include <cmath>

#include "physics/contacts/contact_cone.hpp"
#include "physics/contacts/contact_joints.hpp"
#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

constexpr int kMostSolutions = 6;     // of an island in a substep
constexpr double kAgreement = 0.05;   // of the friction of a pair of shapes
constexpr double kSmallPair = 0.1;    // of the load of an island: a pair that bears less is as exact as one with this
constexpr double kAtLimit = 0.95;     // of a limit
constexpr double kFirstChange = 0.5;  // of the difference, as long as there is one solution only
constexpr double kMostChange = 2;     // factor of a load from solution to solution

double greatest_mu(const FoundContact& point) { return std::max(point.limit.mu, point.limit.mu2); }

bool is_exact(Islands& islands, int island) {
  return islands.is_jointed(island) && !islands.is_by_trees(island) && !islands.is_beyond_limit(island);
}

/// Whether a greater limit would give more friction.
bool is_limited(const FoundPair& pair, const FoundContact& point, double relied) {
  if (greatest_mu(point) == 0) return false;
  if (point.limit.normal != FrictionLimit::kNone) return relied >= kAtLimit * point.limit.normal;
  return (point.limit.mode & (dContactSlip1 | dContactSlip2)) == 0 && slides(pair, point);
}

double normal_force(const FoundContact& point) {
  return std::max(to_vector(point.feedback.f1).dot(to_vector(point.contact.geom.normal)), 0.0);
}

/// Whether the friction of a point is clearly below both limits: by the normal force that acts and by the one expected.
bool sticks(const FoundContact& point, double normal) {
  const double mu = point.limit.mu;
  if (mu != point.limit.mu2 || point.limit.normal < 0) return false;
  const double limit = kAtLimit * mu * std::min(normal, point.limit.normal);
  return mu == 0 || to_vector(point.feedback.f1).squaredNorm() - normal * normal <= limit * limit;
}

/// The normal force in N that the friction of a point relies on: that which acts, unless the friction is greater, or
/// could be.
double relied_on(const FoundPair& pair, const FoundContact& point, double normal) {
  if (sticks(point, normal)) return normal;
  const double needed = needed_normal(point);
  return needed > normal || (needed < (1 - kAgreement) * normal && is_limited(pair, point, needed)) ? needed : normal;
}

struct Loads {
  double act = 0;     // N, sum of the normal forces
  double relied = 0;  // N, of those that the friction relies on
};

/// Of a pair in the last solution.
Loads compare(const FoundPair& pair, FoundContact* points) {
  Loads loads;
  for (int i = 0; i < pair.count; ++i) {
    const double normal = normal_force(points[i]);
    points[i].limit.relied = relied_on(pair, points[i], normal);
    loads.act += normal;
    loads.relied += points[i].limit.relied;
  }
  return loads;
}

}  // namespace

void FrictionIteration::run(Substep& substep, const std::vector<KeptBody>& before) {
  FoundContacts& found = substep.contacts.found;
  const auto disagrees = [&](const FoundPair& pair) {
    Islands& islands = substep.contacts.islands;
    if (!is_exact(islands, islands.of(pair.first->model))) return false;
    const Loads loads = compare(pair, &found.points[pair.begin]);
    return std::abs(loads.act - loads.relied) > kAgreement * loads.act;
  };
  if (std::none_of(found.pairs.begin(), found.pairs.end(), disagrees)) return;
  collect(substep);
  for (solutions_ = 1; judge(found) && solutions_ < kMostSolutions; ++solutions_) {
    limit(found, before);
    if (solve(substep, before)) continue;
    judge(found);
    break;
  }
}

void FrictionIteration::collect(Substep& substep) {
  Islands& islands = substep.contacts.islands;
  pairs_.clear();
  for (const FoundPair& found : substep.contacts.found.pairs) {
    const int island = islands.of(found.first->model);
    if (is_exact(islands, island)) pairs_.push_back({&found, island});
  }
  islands_.assign(substep.moving.all.size(), {true});
}

bool FrictionIteration::judge(FoundContacts& found) {
  for (Pair& pair : pairs_) {
    if (!is_again(pair.island)) continue;
    pair.relied_before = pair.relied;
    pair.missing_before = pair.missing;
    const Loads loads = compare(*pair.found, &found.points[pair.found->begin]);
    pair.load = loads.act;
    pair.relied = loads.relied;
    pair.missing = loads.act - loads.relied;
    island_of(pair).load += pair.load;
  }
  bool again = false;
  for (const Pair& pair : pairs_) {
    if (!is_again(pair.island)) continue;
    const double mu = greatest_mu(found.points[pair.found->begin]);
    const double least = kSmallPair * island_of(pair).load * std::min(mu, 1.0);
    if (mu * std::abs(pair.missing) <= kAgreement * std::max(mu * pair.load, least)) continue;
    again = island_of(pair).disagrees = true;
  }
  for (Island& island : islands_) island = {island.disagrees};
  return again;
}

void FrictionIteration::limit(FoundContacts& found, const std::vector<KeptBody>& before) {
  for (const Pair& pair : pairs_) {
    const double change = pair.missing - pair.missing_before;
    island_of(pair).change += pair.missing * change;
    island_of(pair).square += change * change;
  }
  for (const Pair& pair : pairs_) {
    if (!is_again(pair.island)) continue;
    FoundContact* points = &found.points[pair.found->begin];
    for (int i = 0; i < pair.found->count; ++i) take_force(*pair.found, points[i]);
  }
  put_back(before);
  for (const Pair& pair : pairs_) {
    if (!is_again(pair.island)) continue;
    const Island& island = island_of(pair);
    double load = pair.relied + kFirstChange * pair.missing;
    if (solutions_ > 1 && island.square > 0) {
      const double part = island.change / island.square;
      load =
          pair.relied + pair.missing - part * (pair.relied - pair.relied_before + pair.missing - pair.missing_before);
    }
    load = std::clamp(load, 0.0, kMostChange * std::max(pair.relied, pair.load));
    FoundContact* points = &found.points[pair.found->begin];
    for (int i = 0; i < pair.found->count; ++i) {
      FoundContact& point = points[i];
      // Points of a pair exchange loads without end: their shares change by half.
      double share = pair.load > 0 ? normal_force(point) / pair.load : 0;
      if (pair.relied > 0) {
        const double before = point.limit.relied / pair.relied;
        share = pair.load > 0 ? (share + before) / 2 : before;
      }
      limit_friction(*pair.found, load * share, point);
    }
  }
}

void FrictionIteration::put_back(const std::vector<KeptBody>& before) const {
  for (const KeptBody& kept : before) {
    if (is_again(kept.island)) set_numbers(kept.body, kept.numbers);
  }
}

bool FrictionIteration::solve(Substep& substep, const std::vector<KeptBody>& before) {
  dJointGroupEmpty(substep.ode.contact_joints.get());
  join_holds(substep);
  for (const Pair& pair : pairs_) {
    if (!is_again(pair.island)) continue;
    FoundContact* points = &substep.contacts.found.points[pair.found->begin];
    for (int i = 0; i < pair.found->count; ++i) join(substep.ode, *pair.found, points[i]);
  }
  others_.clear();
  for (const PlacedModel* model : substep.moving.awake) {
    if (is_again(substep.contacts.islands.of(model->number))) continue;
    for (const Link& link : model->links) {
      if (dBodyIsEnabled(link.body.get()) != 0) others_.push_back(link.body.get());
    }
  }
  for (dBodyID body : others_) dBodyDisable(body);
  dWorldStep(substep.ode.id(), substep.duration);
  const bool solved = !ode::solver_warned();
  if (!solved) {
    put_back(before);
    ode::step_iteratively(substep.ode.id(), substep.duration, substep.ode.random);
  }
  for (dBodyID body : others_) dBodyEnable(body);
  return solved;
}

}  // namespace bubblesim
