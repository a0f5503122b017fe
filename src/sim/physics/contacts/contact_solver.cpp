// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/ode/constraint_defaults.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/parts/link.hpp"

namespace bubblesim {
namespace {

constexpr int kMostSweeps = 120;
constexpr double kSmallChange = 2e-6;  // m/s, by which a sweep may change velocities at a solution

void soften(SolvedRow& row, double softness) {
  row.softness = softness;
  row.admittance += softness;
}

}  // namespace

void ContactSolver::clear() {
  for (const SolvedBody& body : bodies_) {
    if (body.body != nullptr) numbers_[static_cast<std::size_t>(body.link)] = 0;
  }
  bodies_.assign(1, {});
  points_.clear();
  spins_.clear();
}

int ContactSolver::number_of(const Link& link, const Vector3& gravity, double step) {
  if (link.body == nullptr) return 0;
  const auto at = static_cast<std::size_t>(link.number);
  if (at >= numbers_.size()) numbers_.resize(at + 1);
  if (numbers_[at] == 0) {
    numbers_[at] = static_cast<int>(bodies_.size());
    add_body(link, gravity, step);
  }
  return numbers_[at];
}

void ContactSolver::add_body(const Link& link, const Vector3& gravity, double step) {
  dBodyID body = link.body.get();
  SolvedBody& made = bodies_.emplace_back();
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

void ContactSolver::finish_row(int a, int b, SolvedRow& row) const {
  const SolvedBody& first = bodies_[static_cast<std::size_t>(a)];
  const SolvedBody& second = bodies_[static_cast<std::size_t>(b)];
  row.turned_a = first.inverse_inertia * row.arm_a;
  row.turned_b = second.inverse_inertia * row.arm_b;
  row.admittance = row.direction.squaredNorm() * (first.inverse_mass + second.inverse_mass) +
                   row.arm_a.dot(row.turned_a) + row.arm_b.dot(row.turned_b);
}

SolvedRow ContactSolver::make_row(int a, int b, const Vector3& direction, const Vector3& lever_a,
                                  const Vector3& lever_b) const {
  SolvedRow row;
  row.direction = direction;
  row.arm_a = lever_a.cross(direction);
  row.arm_b = lever_b.cross(direction);
  finish_row(a, b, row);
  return row;
}

SolvedRow ContactSolver::make_turning_row(int a, int b, const Vector3& axis) const {
  SolvedRow row;
  row.arm_a = row.arm_b = axis;
  finish_row(a, b, row);
  return row;
}

void ContactSolver::add_point(int a, int b, const FoundContact& found, std::size_t index, const ExpectedContact& start,
                              double height, double step) {
  const dSurfaceParameters& surface = found.contact.surface;
  const Vector3 position = to_vector(found.contact.geom.pos);
  const Vector3 n = to_vector(found.contact.geom.normal);
  const auto lever = [&](int body) -> Vector3 {
    const SolvedBody& at = bodies_[static_cast<std::size_t>(body)];
    if (at.body == nullptr) return {};
    return position - to_vector(dBodyGetPosition(at.body));
  };
  const Vector3 lever_a = lever(a);
  const Vector3 lever_b = lever(b);
  SolvedPoint& point = points_.emplace_back();
  point.a = a;
  point.b = b;
  point.height = height;
  point.found = index;
  point.normal = make_row(a, b, n, lever_a, lever_b);

  Vector3 t1;
  if ((surface.mode & dContactFDir1) != 0) {
    t1 = to_vector(found.contact.fdir1);
  } else {
    dVector3 p;
    dVector3 q;
    dPlaneSpace(found.contact.geom.normal, p, q);
    t1 = to_vector(p);
  }
  point.tangent = {make_row(a, b, t1, lever_a, lever_b), make_row(a, b, n.cross(t1), lever_a, lever_b)};
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
    const auto now = [&](const SolvedBody& body, const Vector3& arm) {
      if (body.body == nullptr) return 0.0;
      return n.dot(to_vector(dBodyGetLinearVel(body.body))) + arm.dot(to_vector(dBodyGetAngularVel(body.body)));
    };
    const double incoming = now(bodies_[static_cast<std::size_t>(b)], point.normal.arm_b) -
                            now(bodies_[static_cast<std::size_t>(a)], point.normal.arm_a);
    if (incoming > surface.bounce_vel) point.target = std::max(point.target, surface.bounce * incoming + motion);
  }
  const Vector3 force = n * start.normal + start.friction;
  // A rigid contact yields only to what it did not bear before: a stack does not sink.
  if (!found.has_own_correction) point.target += point.normal.softness * std::max(force.dot(n), 0.0) * step;
  const Vector3 impulse = force * step;
  apply(point, point.normal, std::max(impulse.dot(n), 0.0));
  for (SolvedRow& row : point.tangent) apply(point, row, impulse.dot(row.direction));
  if ((surface.mode & dContactRolling) != 0) add_spin(point, surface, start.torque * step);
}

void ContactSolver::add_spin(SolvedPoint& point, const dSurfaceParameters& surface, const Vector3& expected) {
  point.spinning = static_cast<int>(spins_.size());
  SolvedSpin& made = spins_.emplace_back();
  made.rolling = surface.rho;
  made.spinning = surface.rhoN;
  const auto row = [&](const SolvedRow& along) { return make_turning_row(point.a, point.b, along.direction); };
  made.roll = {row(point.tangent[0]), row(point.tangent[1])};
  made.spin = row(point.normal);
  made.coupling = couple(made.roll);
  for (SolvedRow* turning : {&made.roll[0], &made.roll[1], &made.spin}) {
    apply(point, *turning, expected.dot(turning->arm_a));
  }
}

double ContactSolver::speed(const SolvedPoint& point, const SolvedRow& row) const {
  const SolvedBody& a = bodies_[static_cast<std::size_t>(point.a)];
  const SolvedBody& b = bodies_[static_cast<std::size_t>(point.b)];
  return row.direction.dot(a.velocity - b.velocity) + row.arm_a.dot(a.spin) - row.arm_b.dot(b.spin);
}

void ContactSolver::apply(const SolvedPoint& point, SolvedRow& row, double impulse) {
  SolvedBody& a = bodies_[static_cast<std::size_t>(point.a)];
  SolvedBody& b = bodies_[static_cast<std::size_t>(point.b)];
  row.impulse += impulse;
  a.velocity += row.direction * (impulse * a.inverse_mass);
  b.velocity -= row.direction * (impulse * b.inverse_mass);
  a.spin += row.turned_a * impulse;
  b.spin -= row.turned_b * impulse;
}

double ContactSolver::solve_spin(const SolvedPoint& point, SolvedSpin& spin) {
  double change = 0;
  const auto set = [&](SolvedRow& row, double impulse) {
    const double more = impulse - row.impulse;
    apply(point, row, more);
    // At most this much, in m/s, at the point.
    change = std::max(change, std::abs(more) * std::sqrt(row.admittance * point.tangent[0].admittance));
  };
  const double most = spin.spinning * point.normal.impulse;
  set(spin.spin, std::clamp(spin.spin.impulse - speed(point, spin.spin) / spin.spin.admittance, -most, most));
  if (spin.rolling == 0) return change;
  const double v1 = speed(point, spin.roll[0]);
  const double v2 = speed(point, spin.roll[1]);
  const auto [p1, p2] = stick_within(spin.roll, spin.coupling, v1, v2, spin.rolling * point.normal.impulse);
  set(spin.roll[0], p1);
  set(spin.roll[1], p2);
  return change;
}

double ContactSolver::solve_point(SolvedPoint& point) {
  SolvedRow& normal = point.normal;
  const double wanted = (point.target - speed(point, normal) - normal.softness * normal.impulse) / normal.admittance;
  const double pressed = std::max(normal.impulse + wanted, 0.0) - normal.impulse;
  apply(point, normal, pressed);
  double change = std::abs(pressed) * normal.admittance;

  auto& [first, second] = point.tangent;
  const double v1 = speed(point, first) + first.softness * first.impulse;
  const double v2 = speed(point, second) + second.softness * second.impulse;
  std::array<double, 2> p{};
  if (point.isotropic) {
    p = stick_within(point.tangent, point.coupling, v1, v2, point.mu * normal.impulse);
  } else {
    p = stick(point.tangent, point.coupling, v1, v2);
    p[0] = std::clamp(p[0], -point.mu * normal.impulse, point.mu * normal.impulse);
    p[1] = std::clamp(p[1], -point.mu2 * normal.impulse, point.mu2 * normal.impulse);
  }
  change = std::max(change, std::abs(p[0] - first.impulse) * first.admittance);
  change = std::max(change, std::abs(p[1] - second.impulse) * second.admittance);
  apply(point, first, p[0] - first.impulse);
  apply(point, second, p[1] - second.impulse);
  if (point.spinning < 0) return change;
  return std::max(change, solve_spin(point, spins_[static_cast<std::size_t>(point.spinning)]));
}

double ContactSolver::sweep() {
  double change = 0;
  for (SolvedPoint& point : points_) {
    point.before = {point.normal.impulse, point.tangent[0].impulse, point.tangent[1].impulse};
    change = std::max(change, solve_point(point));
  }
  return change;
}

double ContactSolver::squared_step() const {
  double sum = 0;
  for (const SolvedPoint& point : points_) {
    const std::array<double, 3> now = {point.normal.impulse, point.tangent[0].impulse, point.tangent[1].impulse};
    for (std::size_t i = 0; i < 3; ++i) sum += (now[i] - point.before[i]) * (now[i] - point.before[i]);
  }
  return sum;
}

void ContactSolver::accelerate(double part) {
  for (SolvedPoint& point : points_) {
    const std::array<SolvedRow*, 3> rows = {&point.normal, &point.tangent[0], &point.tangent[1]};
    for (std::size_t i = 0; i < 3; ++i) {
      const double swept = rows[i]->impulse - point.before[i];
      const double more = part * point.search[i];
      if (more != 0) apply(point, *rows[i], more);
      point.search[i] = more + swept;
    }
  }
}

void ContactSolver::solve(std::vector<FoundContact>& points, double step) {
  std::stable_sort(points_.begin(), points_.end(),
                   [](const SolvedPoint& a, const SolvedPoint& b) { return a.height < b.height; });
  double before = 0;
  for (int i = 0; i < kMostSweeps; ++i) {
    if (sweep() < kSmallChange) break;
    if (i + 1 == kMostSweeps) break;  // a sweep comes last, since it leaves the impulses within their limits
    const double now = squared_step();
    accelerate(now < before ? now / before : 0);
    before = now;
  }
  for (const SolvedPoint& point : points_) {
    Vector3 impulse = point.normal.direction * point.normal.impulse;
    Vector3 turn_a = point.normal.arm_a * point.normal.impulse;
    Vector3 turn_b = point.normal.arm_b * point.normal.impulse;
    const auto add = [&](const SolvedRow& row) {
      impulse += row.direction * row.impulse;
      turn_a += row.arm_a * row.impulse;
      turn_b += row.arm_b * row.impulse;
    };
    for (const SolvedRow& row : point.tangent) add(row);
    if (point.spinning >= 0) {
      const SolvedSpin& spin = spins_[static_cast<std::size_t>(point.spinning)];
      Vector3 turn;
      for (const SolvedRow* row : {&spin.roll[0], &spin.roll[1], &spin.spin}) {
        add(*row);
        turn += row->arm_a * row->impulse;
      }
      points[point.found].torque = turn / step;
    }
    points[point.found].force = impulse / step;
    const auto push = [&](int number, const Vector3& force, const Vector3& torque) {
      dBodyID body = bodies_[static_cast<std::size_t>(number)].body;
      if (body == nullptr) return;
      dBodyAddForce(body, force.x(), force.y(), force.z());
      dBodyAddTorque(body, torque.x(), torque.y(), torque.z());
    };
    push(point.a, impulse / step, turn_a / step);
    push(point.b, -impulse / step, -turn_b / step);
  }
}

}  // namespace bubblesim
