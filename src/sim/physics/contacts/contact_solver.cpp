// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>

#include "physics/ode/constraint_defaults.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/parts/link.hpp"

namespace bubblesim {
namespace {

constexpr int kMostSweeps = 120;
constexpr double kSmallChange = 1e-5;  // m/s, by which solving a pair may change its velocity at a solution

SpatialVector spatial(const Vector3& first, const Vector3& second) {
  SpatialVector made;
  made << first, second;
  return made;
}

SolvedRow make_row(const SolvedPair& pair, const Vector3& direction, const Vector3& moment) {
  const auto& k = pair.effect;
  SolvedRow row;
  row.along = spatial(direction, moment);
  row.effect = spatial(k[0][0] * direction + k[0][1] * moment, k[1][0] * direction + k[1][1] * moment);
  row.admittance = row.along.dot(row.effect);
  row.inverse = 1 / row.admittance;
  return row;
}

void soften(SolvedRow& row, double softness) {
  row.softness = softness;
  row.admittance += softness;
  row.inverse = 1 / row.admittance;
}

void solve_spin(PairMotion& pair, const SolvedPoint& point, SolvedSpin& spin) {
  const auto set = [&](SolvedRow& row, double impulse) { pair.apply(row, impulse - row.impulse); };
  const double most = spin.spinning * point.normal.impulse;
  set(spin.spin, std::clamp(spin.spin.impulse - pair.speed(spin.spin) * spin.spin.inverse, -most, most));
  if (spin.rolling == 0) return;
  const double v1 = pair.speed(spin.roll[0]);
  const double v2 = pair.speed(spin.roll[1]);
  const auto [p1, p2] = stick_within(spin.roll, spin.coupling, v1, v2, spin.rolling * point.normal.impulse);
  set(spin.roll[0], p1);
  set(spin.roll[1], p2);
}

inline void solve_point(PairMotion& pair, SolvedPoint& point) {
  SolvedRow& normal = point.normal;
  const double wanted = (point.target - pair.speed(normal) - normal.softness * normal.impulse) * normal.inverse;
  pair.apply(normal, std::max(wanted, -normal.impulse));

  auto& [first, second] = point.tangent;
  const double v1 = pair.speed(first) + first.softness * first.impulse;
  const double v2 = pair.speed(second) + second.softness * second.impulse;
  std::array<double, 2> p{};
  if (point.isotropic) {
    p = stick_within(point.tangent, point.coupling, v1, v2, point.mu * normal.impulse);
  } else {
    p = stick(point.tangent, point.coupling, v1, v2);
    p[0] = std::clamp(p[0], -point.mu * normal.impulse, point.mu * normal.impulse);
    p[1] = std::clamp(p[1], -point.mu2 * normal.impulse, point.mu2 * normal.impulse);
  }
  pair.apply(first, p[0] - first.impulse);
  pair.apply(second, p[1] - second.impulse);
}

}  // namespace

void ContactSolver::clear() {
  for (const SolvedBody& body : island_.bodies) {
    if (body.body != nullptr) numbers_[static_cast<std::size_t>(body.link)] = 0;
  }
  island_.bodies.assign(1, {});
  island_.pairs.clear();
  island_.points.clear();
  island_.spins.clear();
  impacts_.clear();
}

int ContactSolver::number_of(const Link& link, const Vector3& gravity, double step) {
  if (link.body == nullptr) return 0;
  const auto at = static_cast<std::size_t>(link.number);
  if (at >= numbers_.size()) numbers_.resize(at + 1);
  if (numbers_[at] == 0) {
    numbers_[at] = static_cast<int>(island_.bodies.size());
    add_body(link, gravity, step);
  }
  return numbers_[at];
}

void ContactSolver::add_body(const Link& link, const Vector3& gravity, double step) {
  dBodyID body = link.body.get();
  SolvedBody& made = island_.bodies.emplace_back();
  made.link = link.number;
  made.body = body;
  dMass mass;
  dBodyGetMass(body, &mass);
  made.inverse_mass = 1 / mass.mass;
  const Matrix3 turn = to_matrix(dBodyGetRotation(body));
  const Matrix3 inertia = turn * to_matrix(mass.I) * turn.transpose();
  made.inverse_inertia = inertia.inverse();
  made.velocity = to_vector(dBodyGetLinearVel(body)) + to_vector(dBodyGetForce(body)) * (step * made.inverse_mass);
  if (dBodyGetGravityMode(body) != 0) made.velocity += gravity * step;
  const Vector3 spin = to_vector(dBodyGetAngularVel(body));
  const Vector3 torque = to_vector(dBodyGetTorque(body)) - spin.cross(inertia * spin);
  made.spin = spin + made.inverse_inertia * torque * step;
}

Vector3 ContactSolver::lever(int body, const Vector3& place) const {
  const SolvedBody& at = island_.bodies[static_cast<std::size_t>(body)];
  if (at.body == nullptr) return {};
  return place - to_vector(dBodyGetPosition(at.body));
}

void ContactSolver::add_pair(int a, int b, const Vector3& place, double height) {
  SolvedPair& pair = island_.pairs.emplace_back();
  pair.a = a;
  pair.b = b;
  pair.height = height;
  pair.begin = pair.end = island_.points.size();
  pair.lever_a = lever(a, place);
  pair.lever_b = lever(b, place);
  for (auto& row : pair.effect) row[0] = row[1] = Matrix3::Zero();
  const auto add = [&pair](const SolvedBody& body, const Vector3& lever) {
    const Matrix3 cross = cross_matrix(lever);
    const Matrix3 turned = body.inverse_inertia * cross;
    pair.effect[0][0] += Matrix3::Identity() * body.inverse_mass - cross * turned;
    pair.effect[0][1] -= cross * body.inverse_inertia;
    pair.effect[1][0] += turned;
    pair.effect[1][1] += body.inverse_inertia;
  };
  add(island_.bodies[static_cast<std::size_t>(a)], pair.lever_a);
  add(island_.bodies[static_cast<std::size_t>(b)], pair.lever_b);
}

void ContactSolver::add_point(const FoundContact& found, std::size_t index, const ExpectedContact& start, double step) {
  const dSurfaceParameters& surface = found.contact.surface;
  SolvedPair& pair = island_.pairs.back();
  const SolvedBody& body_a = island_.bodies[static_cast<std::size_t>(pair.a)];
  const SolvedBody& body_b = island_.bodies[static_cast<std::size_t>(pair.b)];
  const Vector3 position = to_vector(found.contact.geom.pos);
  const Vector3 n = to_vector(found.contact.geom.normal);
  const Vector3 lever_a = lever(pair.a, position);
  const Vector3 lever_b = lever(pair.b, position);
  const Vector3 place = body_a.body != nullptr ? lever_a - pair.lever_a : lever_b - pair.lever_b;  // from the origin
  pair.extent = std::max(pair.extent, place.norm());
  const auto row_along = [&](const Vector3& direction) { return make_row(pair, direction, place.cross(direction)); };
  SolvedPoint& point = island_.points.emplace_back();
  pair.end = island_.points.size();
  point.found = index;
  point.normal = row_along(n);

  Vector3 t1;
  if ((surface.mode & dContactFDir1) != 0) {
    t1 = to_vector(found.contact.fdir1);
  } else {
    dVector3 p;
    dVector3 q;
    dPlaneSpace(found.contact.geom.normal, p, q);
    t1 = to_vector(p);
  }
  point.tangent = {row_along(t1), row_along(n.cross(t1))};
  if ((surface.mode & dContactSlip1) != 0) soften(point.tangent[0], surface.slip1 / step);
  if ((surface.mode & dContactSlip2) != 0) soften(point.tangent[1], surface.slip2 / step);
  point.coupling = couple(point.tangent);
  point.mu = surface.mu;
  point.mu2 = (surface.mode & dContactMu2) != 0 ? surface.mu2 : surface.mu;
  point.isotropic = point.mu2 == point.mu;

  const double cfm = (surface.mode & dContactSoftCFM) != 0 ? surface.soft_cfm : kConstraintSoftness;
  soften(point.normal, cfm / step);
  point.target = surface.soft_erp / step * std::max(found.contact.geom.depth - kSurfaceLayer, 0.0);
  const double motion = (surface.mode & dContactMotionN) != 0 ? surface.motionN : 0;
  point.target += motion;
  if ((surface.mode & dContactBounce) != 0) {
    const auto now = [&](const SolvedBody& body, const Vector3& lever) {
      if (body.body == nullptr) return 0.0;
      const Vector3 turning = to_vector(dBodyGetAngularVel(body.body)).cross(lever);
      return n.dot(to_vector(dBodyGetLinearVel(body.body)) + turning);
    };
    const double incoming = now(body_b, lever_b) - now(body_a, lever_a);
    const auto number = static_cast<int>(island_.points.size()) - 1;
    const Impact impact{number, -incoming, surface.bounce, surface.bounce_vel, motion, point.target};
    impacts_.add(impact);
    point.target = impact.target_alone();
  }
  const Vector3 force = n * start.normal + start.friction;
  // A rigid contact yields only to what it did not bear before: a stack does not sink.
  if (!found.has_own_correction) point.target += point.normal.softness * std::max(force.dot(n), 0.0) * step;
  const Vector3 impulse = force * step;
  PairMotion pushed;
  pushed.apply(point.normal, std::max(impulse.dot(n), 0.0));
  for (SolvedRow& row : point.tangent) pushed.apply(row, impulse.dot(row.along.head<3>()));
  if ((surface.mode & dContactRolling) != 0) add_spin(pair, pushed, point, surface, start.torque * step);
  give(pair, pushed.given);
}

void ContactSolver::add_spin(const SolvedPair& pair, PairMotion& pushed, SolvedPoint& point,
                             const dSurfaceParameters& surface, const Vector3& expected) {
  point.spinning = static_cast<int>(island_.spins.size());
  SolvedSpin& made = island_.spins.emplace_back();
  made.rolling = surface.rho;
  made.spinning = surface.rhoN;
  const auto row = [&](const SolvedRow& along) { return make_row(pair, Vector3(), along.along.head<3>()); };
  made.roll = {row(point.tangent[0]), row(point.tangent[1])};
  made.spin = row(point.normal);
  made.coupling = couple(made.roll);
  for (SolvedRow* turning : {&made.roll[0], &made.roll[1], &made.spin}) {
    pushed.apply(*turning, expected.dot(turning->along.tail<3>()));
  }
}

void ContactSolver::give(const SolvedPair& pair, const SpatialVector& given) {
  const Vector3 impulse = given.head<3>();
  const Vector3 moment = given.tail<3>();
  SolvedBody& a = island_.bodies[static_cast<std::size_t>(pair.a)];
  SolvedBody& b = island_.bodies[static_cast<std::size_t>(pair.b)];
  a.velocity += impulse * a.inverse_mass;
  b.velocity -= impulse * b.inverse_mass;
  a.spin += a.inverse_inertia * (moment + pair.lever_a.cross(impulse));
  b.spin -= b.inverse_inertia * (moment + pair.lever_b.cross(impulse));
}

double ContactSolver::effect(const SolvedPair& pair, const SolvedPoint& point, const SolvedPair& other_pair,
                             const SolvedPoint& other) const {
  const auto moment = [](const SolvedPoint& at, const Vector3& lever) -> Vector3 {
    return Vector3(at.normal.along.tail<3>()) + lever.cross(Vector3(at.normal.along.head<3>()));
  };
  const double along = point.normal.along.head<3>().dot(other.normal.along.head<3>());
  const auto through = [&](int number, const Vector3& lever, const Vector3& other_lever) {
    const SolvedBody& body = island_.bodies[static_cast<std::size_t>(number)];
    return body.inverse_mass * along + moment(point, lever).dot(body.inverse_inertia * moment(other, other_lever));
  };
  double sum = 0;
  if (pair.a == other_pair.a) sum += through(pair.a, pair.lever_a, other_pair.lever_a);
  if (pair.b == other_pair.b) sum += through(pair.b, pair.lever_b, other_pair.lever_b);
  if (pair.a == other_pair.b) sum -= through(pair.a, pair.lever_a, other_pair.lever_b);
  if (pair.b == other_pair.a) sum -= through(pair.b, pair.lever_b, other_pair.lever_a);
  return sum;
}

void ContactSolver::pass_impacts_on() {
  const auto pair_of = [&](int point) -> const SolvedPair& {
    const auto after = std::upper_bound(island_.pairs.begin(), island_.pairs.end(), static_cast<std::size_t>(point),
                                        [](std::size_t at, const SolvedPair& pair) { return at < pair.begin; });
    return *std::prev(after);
  };
  const auto point_at = [&](int number) -> SolvedPoint& { return island_.points[static_cast<std::size_t>(number)]; };
  const bool travels =
      impacts_.run([&](int a, int b) { return effect(pair_of(a), point_at(a), pair_of(b), point_at(b)); });
  if (!travels) return;
  for (const Impact& impact : impacts_.impacts()) {
    if (impact.impulse == 0) continue;
    SolvedPoint& point = point_at(impact.contact);
    point.target = impact.target();
    PairMotion pushed;
    pushed.apply(point.normal, impact.impulse);
    give(pair_of(impact.contact), pushed.given);
  }
}

ContactSolver::Change ContactSolver::sweep() {
  Change change;
  for (const SolvedPair& pair : island_.pairs) {
    PairMotion motion{island_.motion_of(pair)};
    const SpatialVector before = motion.motion;
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      SolvedPoint& point = island_.points[i];
      point.before = {point.normal.impulse, point.tangent[0].impulse, point.tangent[1].impulse};
      solve_point(motion, point);
      if (point.spinning >= 0) solve_spin(motion, point, island_.spins[static_cast<std::size_t>(point.spinning)]);
      const double steps[] = {point.normal.impulse - point.before[0], point.tangent[0].impulse - point.before[1],
                              point.tangent[1].impulse - point.before[2]};
      for (const double step : steps) change.square += step * step;
    }
    const SpatialVector by = motion.motion - before;
    change.velocity = std::max(change.velocity, by.head<3>().norm() + by.tail<3>().norm() * pair.extent);
    give(pair, motion.given);
  }
  return change;
}

template <class MoreOf>
void ContactSolver::change_impulses(const MoreOf& more_of) {
  for (const SolvedPair& pair : island_.pairs) {
    SpatialVector given = SpatialVector::Zero();
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      for (std::size_t row = 0; row < 3; ++row) {
        SolvedRow& along = *island_.points[i].rows()[row];
        const double more = more_of(i, row);
        along.impulse += more;
        given += along.along * more;
      }
    }
    give(pair, given);
  }
}

bool ContactSolver::solve_stack() {
  if (!stack_solver_.solve(island_)) return false;
  change_impulses([this](std::size_t i, std::size_t row) { return stack_solver_.change(i)[row]; });
  return true;
}

void ContactSolver::accelerate(double part) {
  change_impulses([this, part](std::size_t i, std::size_t row) {
    SolvedPoint& point = island_.points[i];
    const double swept = point.rows()[row]->impulse - point.before[row];
    const double more = part * point.search[row];
    point.search[row] = more + swept;
    return more;
  });
}

void ContactSolver::push(const SolvedPair& pair, const SpatialVector& given, double step) const {
  const Vector3 force = given.head<3>() / step;
  const Vector3 moment = given.tail<3>() / step;
  const auto add = [&](int number, double sign, const Vector3& lever) {
    dBodyID body = island_.bodies[static_cast<std::size_t>(number)].body;
    if (body == nullptr) return;
    const Vector3 torque = (moment + lever.cross(force)) * sign;
    dBodyAddForce(body, force.x() * sign, force.y() * sign, force.z() * sign);
    dBodyAddTorque(body, torque.x(), torque.y(), torque.z());
  };
  add(pair.a, 1, pair.lever_a);
  add(pair.b, -1, pair.lever_b);
}

void ContactSolver::solve(std::vector<FoundContact>& points, double step) {
  pass_impacts_on();
  // In their order at equal heights; a stable sort would allocate memory.
  std::sort(island_.pairs.begin(), island_.pairs.end(), [](const SolvedPair& a, const SolvedPair& b) {
    return std::tie(a.height, a.begin, a.end) < std::tie(b.height, b.begin, b.end);
  });
  double before = 0;
  for (int i = 0; i < kMostSweeps; ++i) {
    const Change change = sweep();
    if (change.velocity < kSmallChange) break;
    if (i + 1 == kMostSweeps) break;  // a sweep comes last, since it leaves the impulses within their limits
    if (i == 0 && solve_stack()) continue;
    accelerate(change.square < before ? change.square / before : 0);
    before = change.square;
  }
  for (const SolvedPair& pair : island_.pairs) {
    SpatialVector given = SpatialVector::Zero();
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      SolvedPoint& point = island_.points[i];
      SpatialVector whole = SpatialVector::Zero();
      for (const SolvedRow* row : point.rows()) whole += row->along * row->impulse;
      FoundContact& found = points[point.found];
      found.force = whole.head<3>() / step;
      if (point.spinning >= 0) {
        const SolvedSpin& spin = island_.spins[static_cast<std::size_t>(point.spinning)];
        SpatialVector turn = SpatialVector::Zero();
        for (const SolvedRow* row : {&spin.roll[0], &spin.roll[1], &spin.spin}) turn += row->along * row->impulse;
        found.torque = turn.tail<3>() / step;
        whole += turn;
      }
      given += whole;
    }
    push(pair, given, step);
  }
}

}  // namespace bubblesim
