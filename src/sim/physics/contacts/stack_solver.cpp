// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/stack_solver.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

constexpr std::size_t kLeastBodies = 4;  // with the static world: fewer are solved by sweeps as fast
constexpr int kMostTries = 3;
constexpr double kSticks = 0.999;    // of the limit
constexpr double kYields = 1e-3;     // of the admittance, by which friction yields to a change in one solution
constexpr double kLeastSoft = 1e-4;  // likewise a rigid normal

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// From the motion of a body to that of a place on it.
Matrix6 shift(const Vector3& lever) {
  Matrix6 made = Matrix6::Identity();
  made.block<3, 3>(0, 3) = -cross_matrix(lever);
  return made;
}

double softness(const SolvedRow& row, std::size_t which) {
  return std::max(row.softness, (which == 0 ? kLeastSoft : kYields) * row.admittance);
}

/// Whether friction is within `part` of its limit.
bool is_within(const SolvedPoint& point, double normal, double first, double second, double part) {
  const double limit = part * normal;
  if (point.isotropic) return first * first + second * second <= point.mu * limit * point.mu * limit;
  return std::abs(first) <= point.mu * limit && std::abs(second) <= point.mu2 * limit;
}

}  // namespace

std::size_t StackSolver::solved_rows(Contact contact) {
  switch (contact) {
    case Contact::kSticks:
      return 3;
    case Contact::kSlides:
      return 1;
    case Contact::kOpen:
      break;
  }
  return 0;
}

bool StackSolver::solve(const SolvedIsland& island) {
  if (island.bodies.size() < kLeastBodies || !arrange(island)) return false;
  assume(island);
  for (int i = 0; i < kMostTries; ++i) {
    assemble(island);
    eliminate();
    if (judge(island)) return true;
  }
  return false;
}

void StackSolver::assume(const SolvedIsland& island) {
  missing_.resize(island.points.size());
  changes_.resize(island.points.size());
  contacts_.resize(island.points.size());
  for (const SolvedPair& pair : island.pairs) {
    const SpatialVector motion = island.motion_of(pair);
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      const SolvedPoint& point = island.points[i];
      const auto rows = point.rows();
      for (std::size_t row = 0; row < 3; ++row) {
        const double wanted = row == 0 ? point.target : 0;
        missing_[i][row] = wanted - rows[row]->softness * rows[row]->impulse - rows[row]->along.dot(motion);
      }
      const bool presses = point.normal.impulse > 0 || missing_[i][0] > 0;
      const bool sticks = is_within(point, point.normal.impulse, rows[1]->impulse, rows[2]->impulse, kSticks);
      contacts_[i] = !presses ? Contact::kOpen : sticks ? Contact::kSticks : Contact::kSlides;
    }
  }
}

bool StackSolver::arrange(const SolvedIsland& island) {
  const std::size_t count = island.bodies.size();
  nodes_.resize(count);
  for (Node& node : nodes_) node.above = 0;  // the rest is assembled
  neighbours_.resize(std::max(neighbours_.size(), count));
  for (std::size_t i = 0; i < count; ++i) neighbours_[i].clear();
  for (const SolvedPair& pair : island.pairs) {
    if (pair.a == 0 || pair.b == 0) continue;
    std::vector<int>& of_a = neighbours_[static_cast<std::size_t>(pair.a)];
    if (std::find(of_a.begin(), of_a.end(), pair.b) != of_a.end()) continue;  // they touch with several shapes
    of_a.push_back(pair.b);
    neighbours_[static_cast<std::size_t>(pair.b)].push_back(pair.a);
  }
  order_.clear();
  seen_.assign(count, 0);
  for (std::size_t top = 1; top < count; ++top) {
    if (seen_[top] != 0) continue;
    seen_[top] = 1;
    order_.push_back(static_cast<int>(top));
    for (std::size_t next = order_.size() - 1; next < order_.size(); ++next) {
      const int body = order_[next];
      for (const int other : neighbours_[static_cast<std::size_t>(body)]) {
        Node& node = nodes_[static_cast<std::size_t>(other)];
        if (other == nodes_[static_cast<std::size_t>(body)].above) continue;
        if (seen_[static_cast<std::size_t>(other)] != 0) return false;
        seen_[static_cast<std::size_t>(other)] = 1;
        node.above = body;
        order_.push_back(other);
      }
    }
  }
  std::reverse(order_.begin(), order_.end());
  return true;
}

void StackSolver::assemble(const SolvedIsland& island) {
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const SolvedBody& body = island.bodies[i];
    nodes_[i].own.setZero();
    nodes_[i].own.block<3, 3>(0, 0) = Matrix3::Identity() / body.inverse_mass;
    nodes_[i].own.block<3, 3>(3, 3) = body.inverse_inertia.inverse();
    nodes_[i].to_above.setZero();
    nodes_[i].push.setZero();
  }
  for (const SolvedPair& pair : island.pairs) {
    Matrix6 stiffness = Matrix6::Zero();
    SpatialVector push = SpatialVector::Zero();
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      const auto rows = island.points[i].rows();
      const std::size_t count = solved_rows(contacts_[i]);
      if (count == 0) {
        for (const SolvedRow* row : rows) push -= row->along * row->impulse;
        continue;
      }
      for (std::size_t row = 0; row < count; ++row) {
        const SpatialVector stiff = rows[row]->along / softness(*rows[row], row);
        stiffness += stiff * rows[row]->along.transpose();
        push += stiff * missing_[i][row];
      }
    }
    Node& a = nodes_[static_cast<std::size_t>(pair.a)];
    Node& b = nodes_[static_cast<std::size_t>(pair.b)];
    const Matrix6 to_a = shift(pair.lever_a);
    const Matrix6 to_b = shift(pair.lever_b);
    const Matrix6 of_a = stiffness * to_a;
    const Matrix6 of_b = stiffness * to_b;
    if (pair.a != 0) {
      a.own += to_a.transpose() * of_a;
      a.push += to_a.transpose() * push;
    }
    if (pair.b != 0) {
      b.own += to_b.transpose() * of_b;
      b.push -= to_b.transpose() * push;
    }
    if (pair.a != 0 && a.above == pair.b) a.to_above -= to_a.transpose() * of_b;
    if (pair.b != 0 && b.above == pair.a) b.to_above -= to_b.transpose() * of_a;
  }
}

void StackSolver::eliminate() {
  for (const int i : order_) {
    Node& node = nodes_[static_cast<std::size_t>(i)];
    const Eigen::LLT<Matrix6> own(node.own);
    node.push = own.solve(node.push);
    if (node.above == 0) continue;
    Node& above = nodes_[static_cast<std::size_t>(node.above)];
    const Matrix6 back = node.to_above.transpose();
    node.to_above = own.solve(node.to_above);
    above.own -= back * node.to_above;
    above.push -= back * node.push;
  }
  for (auto i = order_.rbegin(); i != order_.rend(); ++i) {
    Node& node = nodes_[static_cast<std::size_t>(*i)];
    node.motion = node.push;
    if (node.above != 0) node.motion -= node.to_above * nodes_[static_cast<std::size_t>(node.above)].motion;
  }
}

SpatialVector StackSolver::relative(const SolvedPair& pair) const {
  SpatialVector motion = SpatialVector::Zero();
  if (pair.a != 0) motion += shift(pair.lever_a) * nodes_[static_cast<std::size_t>(pair.a)].motion;
  if (pair.b != 0) motion -= shift(pair.lever_b) * nodes_[static_cast<std::size_t>(pair.b)].motion;
  return motion;
}

bool StackSolver::judge(const SolvedIsland& island) {
  bool holds = true;
  for (const SolvedPair& pair : island.pairs) {
    const SpatialVector motion = relative(pair);
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      const SolvedPoint& point = island.points[i];
      const auto rows = point.rows();
      const std::size_t count = solved_rows(contacts_[i]);
      std::array<double, 3>& change = changes_[i];
      change = {};
      for (std::size_t row = 0; row < count; ++row) {
        change[row] = (missing_[i][row] - rows[row]->along.dot(motion)) / softness(*rows[row], row);
      }
      if (count == 0) {
        change = {-point.normal.impulse, -point.tangent[0].impulse, -point.tangent[1].impulse};
        continue;
      }
      const double normal = point.normal.impulse + change[0];
      if (normal < 0) {
        contacts_[i] = Contact::kOpen;
        holds = false;
      } else if (count == 3 &&
                 !is_within(point, normal, rows[1]->impulse + change[1], rows[2]->impulse + change[2], 1)) {
        contacts_[i] = Contact::kSlides;
        holds = false;
      }
    }
  }
  return holds;
}

}  // namespace bubblesim
