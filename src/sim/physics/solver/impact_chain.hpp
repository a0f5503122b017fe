// SPDX-License-Identifier: BSD-3-Clause
// Impacts that travel through bodies that touch, as in Newton's cradle.
//
// One solution for all contacts, with Newton's restitution at those that approach, would send off several balls of a
// cradle: contacts at rest have nothing to give back. So the contacts that approach fastest are solved first, then
// those that approach because of it, and so on (Smith, Kaufman, Vouga, Tamstorf and Grinspun, Reflections on
// simultaneous impact, ACM Transactions on Graphics 31, 2012).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace bubblesim {

/// A contact that bounces.
struct Impact {
  int contact = 0;         ///< its number, for the caller
  double separation = 0;   ///< m/s, along the normal, before the substep's forces; negative: the bodies approach
  double restitution = 0;  ///< of approaches faster than the threshold
  double threshold = 0;    ///< m/s
  double motion = 0;       ///< m/s, of a surface that moves along the normal
  double least = 0;        ///< m/s, that the substep has to reach without a bounce, as where bodies overlap
  double impulse = 0;      ///< N s, of the chain

  /// What the substep has to reach after this impact alone, by Newton's restitution, m/s.
  double target_alone() const {
    return -separation > threshold ? std::max(least, -restitution * separation + motion) : least;
  }
  /// What the substep has to reach after the chain, m/s.
  double target() const { return std::max(least, separation + motion); }
};

/// The contacts of an island that bounce; its vectors are working memory.
class ImpactChain {
 public:
  void clear() { impacts_.clear(); }
  void add(const Impact& impact) { impacts_.push_back(impact); }
  const std::vector<Impact>& impacts() const { return impacts_; }

  /// Sets the impulses, and the separations after them. Returns false, with nothing to use, if no impact travels: one
  /// solution for all contacts is right then. `effect(a, b)`: by how much an impulse at contact b raises the separation
  /// of contact a, 1/kg.
  template <class Effect>
  bool run(const Effect& effect) {
    if (!may_travel()) return false;
    const auto count = static_cast<Eigen::Index>(impacts_.size());
    effects_.resize(count, count);
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b <= a; ++b) {
        effects_(a, b) = effects_(b, a) = effect(impacts_[index(a)].contact, impacts_[index(b)].contact);
      }
    }
    return run_rounds();
  }

 private:
  static std::size_t index(Eigen::Index number) { return static_cast<std::size_t>(number); }
  bool may_travel() const;
  bool run_rounds();
  void solve_round();

  std::vector<Impact> impacts_;
  Eigen::MatrixXd effects_;     // 1/kg
  std::vector<double> wanted_;  // m/s, separations after a round, of the contacts that approached in it
  std::vector<double> given_;   // N s, in a round
  std::vector<Eigen::Index> approaching_;
};

}  // namespace bubblesim
