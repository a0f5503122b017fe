// SPDX-License-Identifier: BSD-3-Clause
// The cone problem and its rows: bounds, Coulomb's friction, loads that constraints share.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "physics/solver/constraint_rows.hpp"

namespace bubblesim::test::test_cones {
namespace {

constexpr double kGravity = 9.81;
constexpr double kStep = 0.005;

Tree body(double mass) {
  Tree tree;
  TreeLink link;
  link.mass = mass;
  tree.add(link);
  return tree;
}

void add_contact(ConstraintRows& rows, const TreeBody& on, const Vector3& at, double mu, bool is_one_of_many = false) {
  int normal = -1;
  for (const Vector3& direction : {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0, 1, 0)}) {
    const int row = rows.add_force(on, {}, at, direction);
    rows.set(row, 0, 0, 0);
    if (is_one_of_many) rows.set_of_contact(row);
    if (normal < 0) normal = row;
  }
  rows.bound(normal, 0, std::numeric_limits<double>::infinity());
  rows.bound_by(normal, mu, normal + 1, 2);
}

/// The acceleration along a slope of a point mass on it, m/s^2; the slope is gravity that leans.
double slide_on_slope(double slope, double mu, double heading) {
  Tree tree = body(3);
  tree.place();
  tree.weigh(Eigen::VectorXd::Zero(6));
  const Vector3 down(std::sin(slope) * std::cos(heading), std::sin(slope) * std::sin(heading), -std::cos(slope));
  tree.push(kStep, {{Four{}, lanes_of(down * (3 * kGravity))}}, Eigen::VectorXd::Zero(6));
  ConstraintRows rows;
  add_contact(rows, {&tree, 0}, {}, mu);
  EXPECT_LT(rows.solve().residual, 1e-8);
  return std::hypot(tree.rates()[3], tree.rates()[4]) / kStep;
}

TEST(Slope, HoldsWithinTheConeAndSlidesBeyond) {
  for (const double heading : {0.0, 0.4, 2.5}) {
    EXPECT_NEAR(slide_on_slope(0.4, std::tan(0.41), heading), 0, 1e-6);
    for (const double mu : {0.0, 0.1, 0.4}) {
      EXPECT_NEAR(slide_on_slope(0.5, mu, heading), kGravity * (std::sin(0.5) - mu * std::cos(0.5)), 1e-6);
    }
  }
}

TEST(ThreeWheels, ShareALateralLoadThatIsNotDetermined) {
  // A plate on three points in one line across its motion: friction along the line is shared in no determined way.
  Tree tree = body(12);
  tree.place();
  tree.weigh(Eigen::VectorXd::Zero(6));
  tree.push(kStep, {{Four{}, Four{0, 50, -12 * kGravity, 0}}}, Eigen::VectorXd::Zero(6));
  ConstraintRows rows;
  for (const Vector3& at : {Vector3(1, 0, 0), Vector3(-1, 0.5, 0), Vector3(-1, -0.5, 0)}) {
    add_contact(rows, {&tree, 0}, at, 0.5);
  }
  const ConeResult result = rows.solve();
  EXPECT_LT(result.residual, 1e-8);
  EXPECT_LT(tree.rates().norm(), 1e-6);
  double normal = 0;
  double lateral = 0;
  for (int i = 0; i < 3; ++i) {
    normal += rows.impulse(3 * i);
    lateral += rows.impulse(3 * i + 2);
    EXPECT_LE(std::hypot(rows.impulse(3 * i + 1), rows.impulse(3 * i + 2)), 0.5 * rows.impulse(3 * i) + 1e-9);
  }
  EXPECT_NEAR(normal / kStep, 12 * kGravity, 1e-4);
  EXPECT_NEAR(lateral / kStep, -50, 1e-4);
}

TEST(Boxes, OnFourCornersSlideAndHold) {
  // Twelve rows for six coordinates: many impulses have the same effect.
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  constexpr double kMu = 0.4;
  for (int trial = 0; trial < 100; ++trial) {
    Tree tree = body(2);
    tree.place();
    tree.weigh(Eigen::VectorXd::Zero(6));
    SpatialLanes wrench;
    wrench.linear = Four{30 * any(random), 30 * any(random), -2 * kGravity, 0};
    wrench.angular = Four{0.1 * any(random), 0, any(random), 0};
    tree.push(kStep, {wrench}, Eigen::VectorXd::Zero(6));
    ConstraintRows rows;
    for (const double x : {-0.3, 0.3}) {
      for (const double y : {-0.2, 0.2}) add_contact(rows, {&tree, 0}, {x, y, -0.1}, kMu, true);
    }
    EXPECT_LT(rows.solve().residual, 1e-5) << trial;
    for (int i = 0; i < 12; i += 3) {
      EXPECT_GE(rows.impulse(i), -1e-6);
      EXPECT_LE(std::hypot(rows.impulse(i + 1), rows.impulse(i + 2)), kMu * rows.impulse(i) + 1e-5) << trial;
    }
  }
}

TEST(ConeProblem, FindsASolutionOfRandomProblems) {
  std::mt19937 random(7);
  std::normal_distribution<double> any;
  for (int trial = 0; trial < 200; ++trial) {
    const int contacts = 1 + trial % 6;
    const int n = 3 * contacts + 2;
    ConeProblem problem;
    Eigen::MatrixXd root(n, n + 1);
    for (Eigen::Index i = 0; i < root.size(); ++i) root.data()[i] = any(random);
    problem.a.set_zero(n, n);
    problem.a.matrix() = root * root.transpose() / n + 1e-3 * Eigen::MatrixXd::Identity(n, n);
    problem.b.resize(n);
    for (int i = 0; i < n; ++i) problem.b[i] = any(random);
    problem.x = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < 3 * contacts; i += 3) {
      ConeBlock normal;
      normal.row = i;
      normal.lower = 0;
      problem.blocks.push_back(normal);
      ConeBlock friction;
      friction.row = i + 1;
      friction.size = 2;
      friction.normal = i;
      friction.mu = 0.1 + 0.1 * (trial % 7);
      problem.blocks.push_back(friction);
    }
    for (int i = 3 * contacts; i < n; ++i) {
      ConeBlock motor;
      motor.row = i;
      motor.lower = -0.3;
      motor.upper = 0.3;
      problem.blocks.push_back(motor);
    }
    const ConeResult result = ConeSolver().solve(problem);
    EXPECT_LT(result.residual, 1e-6) << trial << ": " << result.newton_steps << " steps, " << result.sweeps
                                     << " sweeps";
    // By the laws themselves.
    const Eigen::VectorXd v = problem.a.matrix() * problem.x - problem.b;
    for (int i = 0; i < 3 * contacts; i += 3) {
      EXPECT_GE(problem.x[i], -1e-6);
      EXPECT_GE(v[i], -1e-5);
      EXPECT_NEAR(problem.x[i] * v[i], 0, 1e-5);
      const double bound = (0.1 + 0.1 * (trial % 7)) * problem.x[i];
      const double friction = std::hypot(problem.x[i + 1], problem.x[i + 2]);
      const double slip = std::hypot(v[i + 1], v[i + 2]);
      EXPECT_LE(friction, bound + 1e-5);
      const double power = problem.x[i + 1] * v[i + 1] + problem.x[i + 2] * v[i + 2];
      EXPECT_NEAR(power, -bound * slip, 1e-4) << trial;
    }
  }
}

}  // namespace
}  // namespace bubblesim::test::test_cones
