// SPDX-License-Identifier: BSD-3-Clause
// Trees in generalised coordinates against theory.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <vector>

#include "physics/solver/tree.hpp"

namespace bubblesim::test::test_trees {
namespace {

constexpr double kGravity = 9.81;

TreeLink rod(int parent, const Vector3& in_parent) {
  TreeLink link;
  link.parent = parent;
  link.motion = TreeMotion::kTurns;
  link.axis = {0, 1, 0};
  link.in_parent = Pose(in_parent, Quaternion());
  link.in_child = Pose(Vector3(0, 0, 0.5), Quaternion());
  link.inertia = Vector3(1.0 / 12, 1.0 / 12, 1e-3).asDiagonal();
  return link;
}

std::vector<SpatialLanes> weights(const Tree& tree) {
  return std::vector<SpatialLanes>(static_cast<std::size_t>(tree.links()), {Four{}, Four{0, 0, -kGravity, 0}});
}

void step(Tree& tree, double duration, const std::vector<SpatialLanes>& wrenches) {
  tree.place();
  tree.weigh(Eigen::VectorXd::Zero(tree.dofs()));
  tree.set_velocities(tree.rates());
  tree.push(duration, wrenches, Eigen::VectorXd::Zero(tree.dofs()));
  tree.move(duration);
}

double energy(Tree& tree) {
  tree.place();
  tree.set_velocities(tree.rates());
  double sum = tree.kinetic_energy();
  for (int i = 0; i < tree.links(); ++i) sum += kGravity * tree.pose(i).position.z();
  return sum;
}

/// Links of all kinds of motion, with branches and two roots, somewhere and in motion.
Tree mixed_tree(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vector3(any(random), any(random), any(random)); };
  const auto pose = [&] { return Pose(vector(), Quaternion(turn_from_z(vector().normalized()))); };
  Tree tree;
  const std::vector<TreeMotion> motions = {
      TreeMotion::kFree, TreeMotion::kTurns, TreeMotion::kSlides, TreeMotion::kScrews, TreeMotion::kTwoAxes,
      TreeMotion::kBall, TreeMotion::kFixed, TreeMotion::kTurns,  TreeMotion::kFree,   TreeMotion::kTurns};
  for (int i = 0; i < static_cast<int>(motions.size()); ++i) {
    TreeLink link;
    link.motion = motions[static_cast<std::size_t>(i)];
    if (link.motion != TreeMotion::kFree)
      link.parent = i == 9 ? 8 : static_cast<int>(random() % static_cast<unsigned>(i));
    link.axis = vector().normalized();
    link.axis2 = link.axis.unitOrthogonal();
    link.lead = link.motion == TreeMotion::kScrews ? 0.1 : 0;
    link.in_parent = pose();
    link.in_child = pose();
    link.mass = 1.5 + any(random);
    const Matrix3 root = Matrix3::Identity() + Matrix3::Random() / 4;
    link.inertia = root * root.transpose();
    tree.add(link);
    tree.joint(i).place = vector();
  }
  for (int i = 0; i < tree.dofs(); ++i) tree.rates()[i] = any(random);
  tree.move(0.7);
  tree.place();
  return tree;
}

/// The mass matrix, from the kinetic energies of pairs of rates.
Eigen::MatrixXd mass_matrix(Tree tree) {
  const int n = tree.dofs();
  const auto energy_of = [&](int j, int k) {
    Eigen::VectorXd rates = Eigen::VectorXd::Zero(n);
    rates[j] += 1;
    rates[k] += 1;
    tree.set_velocities(rates);
    return tree.kinetic_energy();
  };
  Eigen::MatrixXd dense(n, n);
  for (int j = 0; j < n; ++j) dense(j, j) = energy_of(j, j) / 2;
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) dense(j, k) = dense(k, j) = energy_of(j, k) - (dense(j, j) + dense(k, k)) / 2;
  }
  return dense;
}

TEST(MassMatrix, HasTheFactorsOfArticulatedInertias) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    Tree tree = mixed_tree(seed);
    const int n = tree.dofs();
    const Eigen::VectorXd added = Eigen::VectorXd::LinSpaced(n, 0, 0.3);
    tree.weigh(added);
    tree.factor();
    Eigen::MatrixXd l = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd d(n);
    for (int k = 0; k < n; ++k) {
      d[k] = 1 / tree.factors().inverse_diagonal(k);
      for (int j = tree.before(k); j >= 0; j = tree.before(j)) l(k, j) = tree.factors().entry(k, j);
    }
    Eigen::MatrixXd dense = mass_matrix(tree);
    dense.diagonal() += added;
    EXPECT_LT((l.transpose() * d.asDiagonal() * l - dense).norm(), 1e-10 * dense.norm()) << seed;
  }
}

TEST(Push, AcceleratesByTheMassMatrix) {
  constexpr double kStep = 1e-7;  // s: rates from rest make no forces yet
  for (unsigned seed = 1; seed < 20; ++seed) {
    Tree tree = mixed_tree(seed);
    const int n = tree.dofs();
    const Eigen::VectorXd added = Eigen::VectorXd::LinSpaced(n, 0, 0.3);
    const Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(n, -1, 2);
    Eigen::MatrixXd dense = mass_matrix(tree);
    dense.diagonal() += added;
    tree.rates().setZero();
    tree.set_velocities(tree.rates());
    tree.weigh(added);
    tree.push(kStep, std::vector<SpatialLanes>(static_cast<std::size_t>(tree.links())), forces);
    EXPECT_LT((dense * tree.rates() / kStep - forces).norm(), 1e-8) << seed;
  }
}

TEST(Velocities, AreTheSlopesOfThePoses) {
  constexpr double kSmall = 1e-6;
  for (unsigned seed = 1; seed < 10; ++seed) {
    Tree tree = mixed_tree(seed);
    tree.set_velocities(tree.rates());
    Tree moved = tree;
    moved.move(kSmall);
    moved.place();
    for (int i = 0; i < tree.links(); ++i) {
      const Vector3 slope = (moved.pose(i).position - tree.pose(i).position) / kSmall;
      EXPECT_LT((slope - tree.velocity(i).linear).norm(), 1e-4) << seed << ' ' << i;
      const Quaternion turn = moved.pose(i).orientation * tree.pose(i).orientation.conjugate();
      const Vector3 spin = Vector3(turn.vec()) * (turn.w() < 0 ? -2 : 2) / kSmall;
      EXPECT_LT((spin - tree.velocity(i).angular).norm(), 1e-4) << seed << ' ' << i;
    }
  }
}

TEST(Read, GivesTheCoordinatesBack) {
  for (unsigned seed = 1; seed < 10; ++seed) {
    Tree tree = mixed_tree(seed);
    tree.set_velocities(tree.rates());
    std::vector<TreeLinkState> states;
    for (int i = 0; i < tree.links(); ++i) {
      TreeLinkState& state = states.emplace_back();
      state.place = lanes_of(tree.pose(i).position);
      state.turn = lanes_of(tree.pose(i).orientation);
      state.velocity = {lanes_of(tree.velocity(i).angular), lanes_of(tree.velocity(i).linear)};
    }
    Tree again = mixed_tree(seed);
    again.move(0.3);
    again.read(states);
    again.place();
    EXPECT_LT((again.rates() - tree.rates()).norm(), 1e-12) << seed;
    for (int i = 0; i < tree.links(); ++i) {
      EXPECT_LT((again.pose(i).position - tree.pose(i).position).norm(), 1e-12) << seed << ' ' << i;
      EXPECT_GT(std::abs(again.pose(i).orientation.dot(tree.pose(i).orientation)), 1 - 1e-12) << seed << ' ' << i;
    }
  }
}

TEST(Pendulum, HasThePeriodOfTheory) {
  constexpr double kStart = 170 * M_PI / 180;
  constexpr double kStep = 0.001;
  Tree tree;
  tree.add(rod(-1, {}));
  tree.joint(0).turn = Quaternion(Eigen::AngleAxisd(kStart, Eigen::Vector3d::UnitY()));
  const double period = 4 * std::comp_ellint_1(std::sin(kStart / 2)) * std::sqrt(1.0 / 3 / (kGravity * 0.5));
  std::vector<double> crossings;
  double before = 1;
  for (int i = 1; crossings.size() < 21 && i * kStep < 12 * period; ++i) {
    step(tree, kStep, weights(tree));
    const double now = 2 * std::atan2(tree.joint(0).turn.y(), tree.joint(0).turn.w());
    if (now * before < 0 && std::abs(now) < 1) crossings.push_back((i - now / (now - before)) * kStep);
    before = now;
  }
  ASSERT_EQ(crossings.size(), 21u);
  EXPECT_NEAR((crossings.back() - crossings.front()) / (10 * period), 1, 1e-3);
}

double energy_error_of_double_pendulum(double duration) {
  Tree tree;
  tree.add(rod(-1, {}));
  tree.add(rod(0, {0, 0, -0.5}));
  tree.joint(0).turn = Quaternion(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY()));
  tree.joint(1).turn = Quaternion(Eigen::AngleAxisd(-1.0, Eigen::Vector3d::UnitY()));
  const double start = energy(tree);
  double sum = 0;
  const int count = static_cast<int>(std::lround(10 / duration));
  for (int i = 0; i < count; ++i) {
    step(tree, duration, weights(tree));
    sum += energy(tree) - start;
  }
  return std::abs(sum / count);
}

TEST(DoublePendulum, KeepsItsEnergyForTenSeconds) {
  EXPECT_LT(energy_error_of_double_pendulum(0.001), 0.02);  // of 19.6 J between the highest and the lowest place
}

TEST(FloatingTree, KeepsItsMomentum) {
  // Two unequal bodies with a universal joint, without forces.
  Tree tree;
  TreeLink base;
  base.mass = 2;
  base.inertia = Vector3(0.3, 0.5, 0.9).asDiagonal();
  tree.add(base);
  TreeLink arm = rod(0, {0.3, 0.1, 0.2});
  arm.motion = TreeMotion::kTwoAxes;
  arm.axis2 = {1, 0, 0};
  tree.add(arm);
  tree.rates() << 0.4, 1.5, -0.6, 0.1, 0.2, -0.3, 1, -2;
  const auto momenta = [&] {
    tree.place();
    tree.set_velocities(tree.rates());
    Vector3 linear;
    Vector3 angular;
    const Matrix3 inertias[] = {base.inertia, arm.inertia};
    const double masses[] = {base.mass, arm.mass};
    for (int i = 0; i < 2; ++i) {
      const Pose at = tree.pose(i);
      const Twist v = tree.velocity(i);
      linear += v.linear * masses[i];
      angular += at.position.cross(v.linear) * masses[i] +
                 at.orientation * (inertias[i] * (at.orientation.conjugate() * v.angular));
    }
    return std::make_pair(linear, angular);
  };
  const auto [linear, angular] = momenta();
  const std::vector<SpatialLanes> none(2);
  for (int i = 0; i < 10000; ++i) step(tree, 0.001, none);
  const auto [linear_after, angular_after] = momenta();
  EXPECT_LT((linear_after - linear).norm(), 5e-3 * linear.norm());
  EXPECT_LT((angular_after - angular).norm(), 5e-3 * angular.norm());
}

}  // namespace
}  // namespace bubblesim::test::test_trees
