// SPDX-License-Identifier: BSD-3-Clause
// Mechanisms whose joints are eliminated before ODE's exact solver, compared with statics; the factors, with Eigen's.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "physics/ode/sparse_ldlt.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_large_mechanisms {
namespace {

constexpr double kStep = 0.005;
constexpr double kGravity = 9.81;  // m/s^2

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The matrix of a tree: node i is connected to a node before it.
Matrix tree_matrix(int nodes, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1, 1);
  Matrix matrix = Matrix::Identity(nodes, nodes) * (2.0 * nodes);
  for (int i = 1; i < nodes; ++i) {
    const int before = std::uniform_int_distribution<int>(0, i - 1)(random);
    matrix(i, before) = matrix(before, i) = value(random);
  }
  return matrix;
}

Eigen::VectorXd solved(const SparseLdlt& factors, const Eigen::VectorXd& right) {
  const std::vector<std::uint32_t>& order = factors.order();
  std::vector<double> x(order.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = right[order[i]];
  factors.solve_lower(x.data());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= factors.diagonal()[i];
  factors.solve_upper(x.data());
  Eigen::VectorXd result(right.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[order[i]] = x[i];
  return result;
}

TEST(SparseLdlt, OfATreeHasNoEntryMoreThanTheMatrix) {
  std::mt19937 random(3);
  for (const int nodes : {1, 2, 64, 65, 200}) {
    const Matrix matrix = tree_matrix(nodes, random);
    std::vector<std::uint32_t> all(static_cast<std::size_t>(nodes));
    std::iota(all.begin(), all.end(), 0U);
    SparseLdlt factors;
    ASSERT_TRUE(factors.factor(matrix.data(), static_cast<std::size_t>(nodes), all));
    EXPECT_EQ(factors.entries(), static_cast<std::size_t>(nodes - 1));
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(nodes, -1, 2);
    EXPECT_LT((solved(factors, right) - matrix.ldlt().solve(right)).norm(), 1e-12);
  }
}

TEST(SparseLdlt, TakesSomeRowsOfAnyMatrixAgainAndAgain) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  SparseLdlt factors;
  for (int round = 0; round < 20; ++round) {
    constexpr int kRows = 40;
    Matrix root = Matrix::NullaryExpr(kRows, kRows, [&] { return random() % 4 == 0 ? value(random) : 0; });
    Matrix matrix = root * root.transpose() + Matrix::Identity(kRows, kRows);
    const Matrix full = matrix;
    matrix.triangularView<Eigen::StrictlyUpper>().setConstant(std::nan(""));  // not read
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t i = 0; i < kRows; ++i) {
      if (random() % 3 != 0) chosen.push_back(i);
    }
    const auto count = static_cast<Eigen::Index>(chosen.size());
    const Matrix part =
        Matrix::NullaryExpr(count, count, [&](Eigen::Index i, Eigen::Index j) { return full(chosen[i], chosen[j]); });
    ASSERT_TRUE(factors.factor(matrix.data(), kRows, chosen));
    ASSERT_TRUE(factors.factor(matrix.data(), kRows, chosen));
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(count, -1, 2);
    EXPECT_LT((solved(factors, right) - part.ldlt().solve(right)).norm(), 1e-9);
  }
}

TEST(SparseLdlt, RefusesAMatrixThatIsNotPositiveDefinite) {
  const Matrix matrix = (Matrix(2, 2) << 1, 2, 2, 1).finished();
  EXPECT_FALSE(SparseLdlt().factor(matrix.data(), 2, {0, 1}));
}

constexpr int kArms = 4;
constexpr int kLinks = 6;
constexpr double kLength = 0.2;  // m, of a link

std::string named(const std::string& kind, int arm, int link) {
  return kind + std::to_string(arm) + "_" + std::to_string(link);
}

/// A block of 400 kg with arms of links of 1 kg, which stick out along x and -x; 24 hinges about y.
SceneDescription spider(const AxisDescription& axis) {
  ModelDescription robot = model("Spider", link("base", {0, 0, 0.5}));
  robot.links[0].mass = 400;
  robot.links[0].inertia_diagonal = {100, 100, 100};
  robot.links[0].collisions.push_back(shape(Box{{1, 1, 1}}));
  for (int arm = 0; arm < kArms; ++arm) {
    const double side = arm % 2 == 0 ? 1 : -1;
    const double y = 0.1 * arm;
    for (int i = 0; i < kLinks; ++i) {
      const double start = side * (0.5 + kLength * i);
      robot.links.push_back(link(named("link", arm, i), {start + side * kLength / 2, y, 1}));
      robot.links.back().inertia_diagonal = {0.01, 0.01, 0.01};
      robot.joints.push_back(
          joint("revolute", {axis}, {start, y, 1}, i == 0 ? "base" : named("link", arm, i - 1), named("link", arm, i)));
      robot.joints.back().name = named("joint", arm, i);
    }
  }
  return scene({floor(), robot});
}

TEST(LargeMechanism, MotorsBearTheWeightOfTheLinksBeyondThem) {
  AxisDescription motor = axis(Vector3::UnitY(), MotorMode::kVelocity);
  motor.max_force = 1000;  // N m
  World world(spider(motor), 0);
  world.advance(1, kStep);
  world.advance(kStep, kStep);
  for (int arm = 0; arm < kArms; ++arm) {
    for (int i = 0; i < kLinks; ++i) {
      const ObjectId joint = world.tree().find("/" + named("joint", arm, i));
      double moment = 0;
      for (int k = i; k < kLinks; ++k) moment += kGravity * kLength * (k - i + 0.5);
      EXPECT_NEAR(world.joints().position(joint), 0, 2e-3);
      EXPECT_NEAR(std::abs(world.joints().motor_effort(joint)), moment, 0.01 * moment) << named("joint", arm, i);
    }
  }
  EXPECT_NEAR(world.pose(world.tree().find("/base")).position.z(), 0.5, 2e-3);
}

TEST(LargeMechanism, LinksFallToTheStopsOfTheirJoints) {
  AxisDescription limited = axis(Vector3::UnitY());
  limited.lower = -0.1;
  limited.upper = 0.1;
  limited.damping = 1;
  World world(spider(limited), 0);
  world.advance(3, kStep);
  for (int arm = 0; arm < kArms; ++arm) {
    for (int i = 0; i < kLinks; ++i) {
      const double side = arm % 2 == 0 ? 1 : -1;  // about y, positive is down at x > 0
      EXPECT_NEAR(world.joints().position(world.tree().find("/" + named("joint", arm, i))), 0.1 * side, 2e-3)
          << named("joint", arm, i);
    }
  }
}

}  // namespace
}  // namespace bubblesim::test::test_large_mechanisms
