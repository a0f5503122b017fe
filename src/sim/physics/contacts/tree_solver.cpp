// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/tree_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "physics/ode/constraint_defaults.hpp"
#include "physics/ode/ode_math.hpp"
#include "scene/simd.hpp"

namespace bubblesim {
namespace {

Vector3 velocity_at(const Link& link, const dReal* point) {
  if (link.body == nullptr) return {};
  dVector3 velocity;
  dBodyGetPointVel(link.body.get(), point[0], point[1], point[2], velocity);
  return to_vector(velocity);
}

/// A direction across a normal, as ODE's dPlaneSpace().
BUBBLESIM_INLINE Four tangent_of(const dReal* n) {
  const bool is_steep = std::abs(n[2]) > M_SQRT1_2;
  const double part = is_steep ? n[2] : n[0];
  const double factor = 1 / std::sqrt(part * part + n[1] * n[1]);
  return is_steep ? Four{0, -n[2] * factor, n[1] * factor, 0} : Four{-n[1] * factor, n[0] * factor, 0, 0};
}

}  // namespace

void TreeSolver::choose(Substep& substep) {
  Islands& islands = substep.contacts.islands;
  for (const PlacedModel* model : substep.moving.awake) {
    const int island = islands.of(model->number);
    islands.set_by_trees(island, islands.is_jointed(island) && !islands.is_beyond_limit(island));
  }
  for (PlacedModel* model : substep.moving.awake) {
    const int island = islands.of(model->number);
    if (!islands.is_by_trees(island)) continue;
    std::shared_ptr<TreeModel>& trees = model->trees;
    if (trees == nullptr && TreeModel::knows_joints_of(*model)) trees = std::make_shared<TreeModel>(*model);
    if (trees == nullptr || !trees->knows_parts() || trees->turns_too_far(substep.duration)) {
      islands.set_by_trees(island, false);
    }
  }
}

TreeBody TreeSolver::body_of(const Collider& collider, const Substep& substep) const {
  if (collider.model == Collider::kNoModel) return {};
  return substep.moving.at(collider.model).trees->body(*collider.link);
}

void TreeSolver::solve(Substep& substep) {
  gather(substep);
  next_model_ = next_pair_ = 0;
  while (next_model_ < models_.size()) solve_island(substep);
}

void TreeSolver::gather(Substep& substep) {
  Contacts& contacts = substep.contacts;
  models_.clear();
  pairs_.clear();
  for (const PlacedModel* model : substep.moving.awake) {
    const int island = contacts.islands.of(model->number);
    if (contacts.islands.is_by_trees(island)) models_.push_back({island, models_.size(), model->trees.get()});
  }
  ContactLookup lookup(contacts.memory);
  for (const FoundPair& pair : contacts.found.pairs) {
    const int island = contacts.islands.of(pair.first->model);
    if (contacts.islands.is_by_trees(island)) pairs_.push_back({island, &pair, lookup.pair(pair)});
  }
  // In their order within an island; a stable sort would allocate memory.
  std::sort(models_.begin(), models_.end(), [](const IslandModel& a, const IslandModel& b) {
    return std::tie(a.island, a.turn) < std::tie(b.island, b.turn);
  });
  std::sort(pairs_.begin(), pairs_.end(), [](const IslandPair& a, const IslandPair& b) {
    return std::tie(a.island, a.pair) < std::tie(b.island, b.pair);
  });
}

/// Solves the next island.
void TreeSolver::solve_island(Substep& substep) {
  const double step = substep.duration;
  const int island = models_[next_model_].island;
  const std::size_t first = next_model_;
  while (next_model_ < models_.size() && models_[next_model_].island == island) ++next_model_;
  const auto each_model = [&](const auto& act) {
    for (std::size_t i = first; i < next_model_; ++i) act(*models_[i].model);
  };
  rows_.clear();
  points_.clear();
  each_model([&](TreeModel& model) { model.begin(substep.gravity, step); });
  each_model([&](TreeModel& model) { model.add_rows(rows_, step); });
  for (const Hold& hold : substep.holds) {
    const PlacedModel& model = *hold.model;
    if (model.rest.is_awake() && substep.contacts.islands.of(model.number) == island) add_hold(hold, step);
  }
  while (next_pair_ < pairs_.size() && pairs_[next_pair_].island < island) ++next_pair_;  // of sleeping models
  for (; next_pair_ < pairs_.size() && pairs_[next_pair_].island == island; ++next_pair_) {
    add_pair(pairs_[next_pair_], substep);
  }
  rows_.solve();
  const bool is_refused = std::any_of(models_.begin() + static_cast<std::ptrdiff_t>(first),
                                      models_.begin() + static_cast<std::ptrdiff_t>(next_model_),
                                      [&](const IslandModel& each) { return each.model->would_turn_too_far(step); });
  if (is_refused) return substep.contacts.islands.set_by_trees(island, false);
  report_forces(step);
  each_model([&](TreeModel& model) { model.end(rows_, step); });
}

BUBBLESIM_SIMD void TreeSolver::report_forces(double step) {
  for (const PointRows& at : points_) {
    const auto sum = [&](int normal, int tangent1, int tangent2) -> Vector3 {
      return vector_of((at.axes[0] * rows_.impulse(normal) + at.axes[1] * rows_.impulse(tangent1) +
                        at.axes[2] * rows_.impulse(tangent2)) *
                       (1 / step));
    };
    at.point->force = sum(at.normal, at.normal + 1, at.normal + 2);
    if (at.spin >= 0) at.point->torque = sum(at.spin + 2, at.spin, at.spin + 1);
  }
}

void TreeSolver::add_hold(const Hold& hold, double step) {
  const TreeBody link = hold.model->trees->body(*hold.link);
  const TreeBody holder = hold.holder == nullptr ? TreeBody{} : hold.holder_model->trees->body(*hold.holder);
  const Pose here = link_pose(*hold.link);
  const Pose wanted = held_pose(hold);
  const Vector3 apart = here.position - wanted.position;
  const Quaternion turn = here.orientation * wanted.orientation.conjugate();
  const Vector3 turned = Vector3(turn.vec()) * (turn.w() < 0 ? -2 : 2);  // rad, while it is small
  for (const Vector3& direction : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY()), Vector3(Vector3::UnitZ())}) {
    rows_.hold(rows_.add_force(link, holder, here.position, direction), direction.dot(apart), step);
    rows_.hold(rows_.add_torque(link, holder, direction), direction.dot(turned), step);
  }
}

void TreeSolver::add_pair(const IslandPair& island_pair, Substep& substep) {
  const FoundPair& pair = *island_pair.pair;
  std::vector<FoundContact>& found = substep.contacts.found.points;
  const ExpectedContacts expected =
      island_pair.remembered == nullptr
          ? ExpectedContacts()
          : expect(substep.contacts.memory, *island_pair.remembered, pair, &found[pair.begin], substep.duration);
  const TreeBody a = body_of(*pair.first, substep);
  const TreeBody b = body_of(*pair.second, substep);
  for (std::size_t i = 0; i < static_cast<std::size_t>(pair.count); ++i) {
    add_point(a, b, pair, found[pair.begin + i], expected[i], substep.duration);
  }
}

BUBBLESIM_SIMD void TreeSolver::add_point(const TreeBody& a, const TreeBody& b, const FoundPair& pair,
                                          FoundContact& found, const ExpectedContact& start, double step) {
  const dSurfaceParameters& surface = found.contact.surface;
  const Vector3 position = to_vector(found.contact.geom.pos);
  PointRows& point = points_.emplace_back();
  point.point = &found;
  const Four normal = lanes_of(found.contact.geom.normal);
  const Four tangent =
      (surface.mode & dContactFDir1) != 0 ? lanes_of(found.contact.fdir1) : tangent_of(found.contact.geom.normal);
  point.axes[0] = normal;
  point.axes[1] = tangent;
  point.axes[2] = cross(normal, tangent);
  const Four force = normal * start.normal + lanes_of(start.friction);

  // As in ContactSolver::add_point().
  const double cfm = (surface.mode & dContactSoftCFM) != 0 ? surface.soft_cfm : kConstraintSoftness;
  const double motion = (surface.mode & dContactMotionN) != 0 ? surface.motionN : 0;
  double target = surface.soft_erp / step * std::max(found.contact.geom.depth - kSurfaceLayer, 0.0) + motion;
  if ((surface.mode & dContactBounce) != 0) {
    const dReal* at = found.contact.geom.pos;
    const double incoming = to_vector(found.contact.geom.normal)
                                .dot(velocity_at(*pair.second->link, at) - velocity_at(*pair.first->link, at));
    const Impact impact{rows_.count(), -incoming, surface.bounce, surface.bounce_vel, motion, target};
    rows_.add_impact(impact);
    target = impact.target_alone();
  }
  // A rigid contact yields only to what it did not bear before: a robot does not sink.
  if (!found.has_own_correction) target += cfm * std::max(start.normal, 0.0);

  SpatialLanes forces[3];
  for (int i = 0; i < 3; ++i) forces[i].linear = point.axes[i];
  point.normal = rows_.add_forces(a, b, position, forces, 3);
  const auto set = [&](int number, double wanted, double softness) {
    const int row = point.normal + number;
    const double expected = lanes_dot(force, point.axes[number]);
    rows_.set(row, wanted, softness / step, expected * step);
    rows_.set_of_contact(row);
  };
  set(0, target, cfm);
  set(1, (surface.mode & dContactMotion1) != 0 ? surface.motion1 : 0,
      (surface.mode & dContactSlip1) != 0 ? surface.slip1 : 0);
  set(2, (surface.mode & dContactMotion2) != 0 ? surface.motion2 : 0,
      (surface.mode & dContactSlip2) != 0 ? surface.slip2 : 0);
  rows_.bound(point.normal, 0, std::numeric_limits<double>::infinity());
  const double mu2 = (surface.mode & dContactMu2) != 0 ? surface.mu2 : surface.mu;
  if (mu2 == surface.mu) {
    rows_.bound_by(point.normal, surface.mu, point.normal + 1, 2);
  } else {
    rows_.bound_by(point.normal, surface.mu, point.normal + 1, 1);
    rows_.bound_by(point.normal, mu2, point.normal + 2, 1);
  }
  if ((surface.mode & dContactRolling) == 0) return;
  const Four torque = lanes_of(start.torque);
  SpatialLanes torques[3];
  for (int i = 0; i < 3; ++i) torques[i].angular = point.axes[(i + 1) % 3];  // the normal comes last
  point.spin = rows_.add_forces(a, b, position, torques, 3);
  for (int i = 0; i < 3; ++i) {
    rows_.set(point.spin + i, 0, 0, lanes_dot(torque, torques[i].angular) * step);
    rows_.set_of_contact(point.spin + i);
  }
  rows_.bound_by(point.normal, surface.rho, point.spin, 2);
  rows_.bound_by(point.normal, surface.rhoN, point.spin + 2, 1);
}

}  // namespace bubblesim
