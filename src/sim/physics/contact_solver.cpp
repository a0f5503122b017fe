// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact_defaults.hpp"
#include "physics/symmetric_matrix.hpp"
#include "physics/world_state.hpp"

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
  const SymmetricMatrix inertia = turned(dBodyGetRotation(body), inertia_of(body));
  made.inverse_inertia = inverse(inertia);
  made.velocity = to_vector(dBodyGetLinearVel(body)) + to_vector(dBodyGetForce(body)) * (step * made.inverse_mass);
  if (dBodyGetGravityMode(body) != 0) made.velocity += gravity * step;
  const Vector3 spin = to_vector(dBodyGetAngularVel(body));
  const Vector3 torque = to_vector(dBodyGetTorque(body)) - spin.Cross(times(inertia, spin));
  made.spin = spin + times(made.inverse_inertia, torque) * step;
}

void ContactSolver::finish_row(int a, int b, SolvedRow& row) const {
  const SolvedBody& first = bodies_[static_cast<std::size_t>(a)];
  const SolvedBody& second = bodies_[static_cast<std::size_t>(b)];
  row.turned_a = times(first.inverse_inertia, row.arm_a);
  row.turned_b = times(second.inverse_inertia, row.arm_b);
  row.admittance = row.direction.SquaredLength() * (first.inverse_mass + second.inverse_mass) +
                   row.arm_a.Dot(row.turned_a) + row.arm_b.Dot(row.turned_b);
}

SolvedRow ContactSolver::make_row(int a, int b, const Vector3& direction, const Vector3& lever_a,
                                  const Vector3& lever_b) const {
  SolvedRow row;
  row.direction = direction;
  row.arm_a = lever_a.Cross(direction);
  row.arm_b = lever_b.Cross(direction);
  finish_row(a, b, row);
  return row;
}

SolvedRow ContactSolver::make_turning_row(int a, int b, const Vector3& axis) const {
  SolvedRow row;
  row.arm_a = row.arm_b = axis;
  finish_row(a, b, row);
  return row;
}

void ContactSolver::add_point(int a, int b, const FoundContact& found, std::size_t index, const Vector3& start,
                              double height, double step) {
  const dSurfaceParameters& surface = found.contact.surface;
  const Vector3 position = to_vector(found.contact.geom.pos);
  const Vector3 n = to_vector(found.contact.geom.normal);
  const auto lever = [&](int body) {
    const SolvedBody& at = bodies_[static_cast<std::size_t>(body)];
    return at.body == nullptr ? Vector3::Zero : position - to_vector(dBodyGetPosition(at.body));
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
  point.tangent = {make_row(a, b, t1, lever_a, lever_b), make_row(a, b, n.Cross(t1), lever_a, lever_b)};
  const SolvedBody& first = bodies_[static_cast<std::size_t>(a)];
  const SolvedBody& second = bodies_[static_cast<std::size_t>(b)];
  point.mixed =
      point.tangent[1].arm_a.Dot(point.tangent[0].turned_a) + point.tangent[1].arm_b.Dot(point.tangent[0].turned_b);
  if ((surface.mode & dContactSlip1) != 0) soften(point.tangent[0], surface.slip1 / step);
  if ((surface.mode & dContactSlip2) != 0) soften(point.tangent[1], surface.slip2 / step);
  point.determinant = point.tangent[0].admittance * point.tangent[1].admittance - point.mixed * point.mixed;
  const double half = (point.tangent[0].admittance - point.tangent[1].admittance) / 2;
  point.slide = 1 / (point.tangent[0].admittance - half + std::hypot(half, point.mixed));
  point.mu = surface.mu;
  point.mu2 = (surface.mode & dContactMu2) != 0 ? surface.mu2 : surface.mu;
  point.isotropic = (surface.mode & dContactMu2) == 0;

  const double cfm = (surface.mode & dContactSoftCFM) != 0 ? surface.soft_cfm : kConstraintSoftness;
  soften(point.normal, cfm / step);
  point.target = surface.soft_erp / step * std::max(found.contact.geom.depth - kSurfaceLayer, 0.0);
  const double motion = (surface.mode & dContactMotionN) != 0 ? surface.motionN : 0;
  point.target += motion;
  if ((surface.mode & dContactBounce) != 0) {
    const auto now = [&](const SolvedBody& body, const Vector3& arm) {
      if (body.body == nullptr) return 0.0;
      return n.Dot(to_vector(dBodyGetLinearVel(body.body))) + arm.Dot(to_vector(dBodyGetAngularVel(body.body)));
    };
    const double incoming = now(second, point.normal.arm_b) - now(first, point.normal.arm_a);
    if (incoming > surface.bounce_vel) point.target = std::max(point.target, surface.bounce * incoming + motion);
  }
  if ((surface.mode & dContactRolling) != 0) {
    point.spinning = static_cast<int>(spins_.size());
    SolvedSpin& spin = spins_.emplace_back();
    spin.rolling = surface.rho;
    spin.spinning = surface.rhoN;
    spin.rows = {make_turning_row(a, b, t1), make_turning_row(a, b, n.Cross(t1)), make_turning_row(a, b, n)};
  }
  // A rigid contact yields only to what it did not bear before: a stack does not sink.
  if (!found.has_own_correction) point.target += point.normal.softness * std::max(start.Dot(n), 0.0) * step;
  const Vector3 impulse = start * step;
  apply(point, point.normal, std::max(impulse.Dot(n), 0.0));
  for (SolvedRow& row : point.tangent) apply(point, row, impulse.Dot(row.direction));
}

double ContactSolver::speed(const SolvedPoint& point, const SolvedRow& row) const {
  const SolvedBody& a = bodies_[static_cast<std::size_t>(point.a)];
  const SolvedBody& b = bodies_[static_cast<std::size_t>(point.b)];
  return row.direction.Dot(a.velocity - b.velocity) + row.arm_a.Dot(a.spin) - row.arm_b.Dot(b.spin);
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

void ContactSolver::solve_spin(const SolvedPoint& point, SolvedSpin& spin) {
  const auto turn = [&](SolvedRow& row, double least, double most) {
    const double wanted = row.impulse - speed(point, row) / row.admittance;
    apply(point, row, std::clamp(wanted, least, most) - row.impulse);
  };
  const double normal = point.normal.impulse;
  turn(spin.rows[2], -spin.spinning * normal, spin.spinning * normal);
  if (spin.rolling == 0) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const double other = spin.rows[1 - i].impulse;
    const double most = std::sqrt(std::max(spin.rolling * normal * spin.rolling * normal - other * other, 0.0));
    turn(spin.rows[i], -most, most);
  }
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
  double p1 = first.impulse - (second.admittance * v1 - point.mixed * v2) / point.determinant;
  double p2 = second.impulse - (first.admittance * v2 - point.mixed * v1) / point.determinant;
  if (point.isotropic) {
    const double limit = point.mu * normal.impulse;
    if (std::hypot(p1, p2) > limit) {
      // A slide: a step along the velocity, since friction opposes it, and back to the cone.
      p1 = first.impulse - v1 * point.slide;
      p2 = second.impulse - v2 * point.slide;
      const double scale = limit / std::max({std::hypot(p1, p2), limit, std::numeric_limits<double>::min()});
      p1 *= scale;
      p2 *= scale;
    }
  } else {
    p1 = std::clamp(p1, -point.mu * normal.impulse, point.mu * normal.impulse);
    p2 = std::clamp(p2, -point.mu2 * normal.impulse, point.mu2 * normal.impulse);
  }
  change = std::max(change, std::abs(p1 - first.impulse) * first.admittance);
  change = std::max(change, std::abs(p2 - second.impulse) * second.admittance);
  apply(point, first, p1 - first.impulse);
  apply(point, second, p2 - second.impulse);
  if (point.spinning >= 0) solve_spin(point, spins_[static_cast<std::size_t>(point.spinning)]);
  return change;
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
      for (const SolvedRow& row : spins_[static_cast<std::size_t>(point.spinning)].rows) add(row);
    }
    points[point.found].force = impulse / step;
    const auto push = [&](int number, const Vector3& force, const Vector3& torque) {
      dBodyID body = bodies_[static_cast<std::size_t>(number)].body;
      if (body == nullptr) return;
      dBodyAddForce(body, force.X(), force.Y(), force.Z());
      dBodyAddTorque(body, torque.X(), torque.Y(), torque.Z());
    };
    push(point.a, impulse / step, turn_a / step);
    push(point.b, -impulse / step, -turn_b / step);
  }
}

}  // namespace bubblesim
