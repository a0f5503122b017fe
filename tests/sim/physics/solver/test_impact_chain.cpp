// SPDX-License-Identifier: BSD-3-Clause
// Impacts in rows of equal balls, whose speeds theory knows.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/solver/impact_chain.hpp"

namespace bubblesim::test::test_impact_chain {
namespace {

/// Balls of 1 kg that touch, in a row: contact i is between balls i and i + 1.
class Row {
 public:
  Row(std::vector<double> speeds, double restitution, double threshold = 0) : speeds_(std::move(speeds)) {
    for (int i = 0; i + 1 < count(); ++i) chain_.add({i, speed(i + 1) - speed(i), restitution, threshold, 0, 0, 0});
  }

  bool run() {
    const bool travels = chain_.run([](int a, int b) { return a == b ? 2.0 : std::abs(a - b) == 1 ? -1.0 : 0.0; });
    for (const Impact& impact : chain_.impacts()) {
      speeds_[static_cast<std::size_t>(impact.contact)] -= impact.impulse;
      speeds_[static_cast<std::size_t>(impact.contact) + 1] += impact.impulse;
    }
    return travels;
  }
  const std::vector<double>& speeds() const { return speeds_; }

 private:
  int count() const { return static_cast<int>(speeds_.size()); }
  double speed(int ball) const { return speeds_[static_cast<std::size_t>(ball)]; }

  std::vector<double> speeds_;
  ImpactChain chain_;
};

void expect_speeds(const Row& row, const std::vector<double>& wanted) {
  ASSERT_EQ(row.speeds().size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(row.speeds()[i], wanted[i], 1e-9) << i;
}

TEST(ImpactChain, AsManyBallsFlyAsHit) {
  for (const std::vector<double>& hit : {std::vector<double>{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 1, 1, 0, 0}}) {
    Row row(hit, 1);
    EXPECT_TRUE(row.run());
    expect_speeds(row, {hit.rbegin(), hit.rend()});
  }
}

TEST(ImpactChain, KeepsMomentumAndEnergyWhereImpactsMeet) {
  Row row({1, 0, 0, 0, -2}, 1);
  EXPECT_TRUE(row.run());
  double momentum = 0;
  double energy = 0;
  for (const double speed : row.speeds()) {
    momentum += speed;
    energy += speed * speed;
  }
  EXPECT_NEAR(momentum, 1 - 2, 1e-9);
  EXPECT_NEAR(energy, 1 + 4, 1e-9);
}

TEST(ImpactChain, EachPairKeepsItsRestitution) {
  // Of two equal balls, (1 + e) / 2 of the speed passes on, (1 - e) / 2 stays (Newton).
  const double e = 0.8;
  Row row({1, 0, 0}, e);
  EXPECT_TRUE(row.run());
  const double passed = (1 + e) / 2;
  const double kept = (1 - e) / 2;
  // The second ball has passed on so much that the first one, slow as it is, hits it once more.
  const double both = (kept + passed * kept) / 2;  // the mean speed of the two
  const double apart = e * (kept - passed * kept) / 2;
  expect_speeds(row, {both - apart, both + apart, passed * passed});
}

TEST(ImpactChain, OneSolutionServesWhereAllApproachAtOnce) {
  Row row({1, 0, -1}, 1);
  EXPECT_FALSE(row.run());
}

TEST(ImpactChain, SlowApproachesDoNotBounce) {
  Row row({0.01, 0, 0}, 1, 0.02);
  EXPECT_FALSE(row.run());
  expect_speeds(row, {0.01, 0, 0});
}

}  // namespace
}  // namespace bubblesim::test::test_impact_chain
