// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/impact_chain.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

constexpr std::size_t kMostImpacts = 64;  // in larger heaps, what travels is lost among what arrives at once
constexpr int kMostRounds = 200;          // a row of n equal balls takes n - 1
constexpr int kSweepsOfRound = 100;
constexpr double kSmallestSweep = 1e-12;  // m/s
constexpr double kNoApproach = 1e-9;      // m/s
constexpr double kAtOnce = 0.5;           // of the fastest approach, what counts as arriving with it

bool approaches(const Impact& impact) { return -impact.separation > std::max(impact.threshold, kNoApproach); }

}  // namespace

bool ImpactChain::may_travel() const {
  return impacts_.size() > 1 && impacts_.size() <= kMostImpacts &&
         std::any_of(impacts_.begin(), impacts_.end(), approaches);
}

bool ImpactChain::run_rounds() {
  int rounds = 0;
  for (; rounds < kMostRounds; ++rounds) {
    double fastest = 0;
    for (const Impact& impact : impacts_) {
      if (approaches(impact)) fastest = std::max(fastest, -impact.separation);
    }
    if (fastest == 0) break;
    approaching_.clear();
    for (std::size_t i = 0; i < impacts_.size(); ++i) {
      const bool is_fast = -impacts_[i].separation >= kAtOnce * fastest;
      if (is_fast && approaches(impacts_[i])) approaching_.push_back(static_cast<Eigen::Index>(i));
    }
    solve_round();
  }
  return rounds > 1;
}

/// Solves the contacts that approach, all at once: impulses >= 0 after which none separates slower than by its
/// restitution, by projected Gauss-Seidel.
void ImpactChain::solve_round() {
  wanted_.clear();
  for (const Eigen::Index i : approaching_) {
    wanted_.push_back(-impacts_[index(i)].restitution * impacts_[index(i)].separation);
  }
  given_.assign(approaching_.size(), 0);
  for (int sweep = 0; sweep < kSweepsOfRound; ++sweep) {
    double change = 0;
    for (std::size_t k = 0; k < approaching_.size(); ++k) {
      const Eigen::Index i = approaching_[k];
      if (!(effects_(i, i) > 0)) continue;
      const double missing = (wanted_[k] - impacts_[index(i)].separation) / effects_(i, i);
      const double more = std::max(missing, -given_[k]);
      given_[k] += more;
      impacts_[index(i)].impulse += more;
      for (std::size_t other = 0; other < impacts_.size(); ++other) {
        impacts_[other].separation += effects_(static_cast<Eigen::Index>(other), i) * more;
      }
      change = std::max(change, std::abs(more) * effects_(i, i));
    }
    if (change < kSmallestSweep) break;
  }
}

}  // namespace bubblesim
