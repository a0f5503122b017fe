// SPDX-License-Identifier: BSD-3-Clause
// What differs at random between simulations of one scene.
#pragma once

#include <string>
#include <vector>

namespace bubblesim {

/// How the numbers of a quantity are drawn, each by itself. SI units.
struct Distribution {
  enum class Kind {
    kUniform,  ///< from `first` to `second`
    kNormal,   ///< with the mean `first` and the standard deviation `second`
    kChoice,   ///< one of the rows of numbers in `first`, all equally likely
  };
  /// What is done with the numbers: they replace those of the quantity, are added to them or multiply them.
  enum class Operation { kSet, kAdd, kScale };

  Kind kind = Kind::kUniform;
  Operation operation = Operation::kSet;
  std::vector<double> first;   ///< one number for each of the quantity, or one for all
  std::vector<double> second;  ///< likewise; empty for a choice
};

struct RandomQuantity {
  std::string name;  ///< of a quantity that can be set, as for a batch: /Robot.mass
  Distribution distribution;
  std::string file;  ///< of the scene that has it; empty elsewhere
  int line = 0;      ///< 0: unknown
};

}  // namespace bubblesim
