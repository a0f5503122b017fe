// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/randomization.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "scene/describe.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

using DrawKind = Distribution::Kind;
using DrawOperation = Distribution::Operation;

/// Random numbers that are a function of their key and index: the generator splitmix64 (Steele, Lea, Flood, "Fast
/// splittable pseudorandom number generators", 2014) at any place of its sequence.
class Draws {
 public:
  Draws(std::uint64_t seed, const std::string& name) {
    Fnv1a hash;
    hash.add(seed);
    hash.add(std::string_view(name));
    start_ = hash.value();
  }
  /// From 0 to 1, without 1.
  double uniform(std::uint64_t index) const {
    std::uint64_t z = start_ + (index + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  /// With mean 0 and standard deviation 1 (G. Box, M. Muller, "A note on the generation of random normal deviates").
  double normal(std::uint64_t index) const {
    return std::sqrt(-2 * std::log(1 - uniform(2 * index))) * std::cos(2 * M_PI * uniform(2 * index + 1));
  }

 private:
  std::uint64_t start_;
};

double number_at(const std::vector<double>& numbers, std::size_t i) {
  return numbers.size() == 1 ? numbers.front() : numbers[i];
}

double drawn(const Distribution& d, const Draws& draws, std::size_t i, std::size_t size) {
  switch (d.kind) {
    case DrawKind::kUniform: {
      const double low = number_at(d.first, i);
      return low + (number_at(d.second, i) - low) * draws.uniform(i);
    }
    case DrawKind::kNormal:
      return number_at(d.first, i) + number_at(d.second, i) * draws.normal(i);
    case DrawKind::kChoice: {
      const std::size_t rows = d.first.size() / size;
      return d.first[static_cast<std::size_t>(draws.uniform(0) * static_cast<double>(rows)) * size + i];
    }
  }
  return 0;
}

void check_distribution(const Distribution& d, std::size_t size) {
  const auto finite = [](double number) { return std::isfinite(number); };
  if (!std::all_of(d.first.begin(), d.first.end(), finite) || !std::all_of(d.second.begin(), d.second.end(), finite)) {
    throw InvalidInput("the numbers of a distribution must be finite");
  }
  if (d.kind == DrawKind::kChoice) {
    if (!d.first.empty() && d.first.size() % size == 0) return;
    throw InvalidInput("a choice needs rows of " + std::to_string(size) + " numbers, found " +
                       std::to_string(d.first.size()) + " numbers");
  }
  const bool uniform = d.kind == DrawKind::kUniform;
  for (const auto& [numbers, name] :
       {std::pair(&d.first, uniform ? "low" : "mean"), std::pair(&d.second, uniform ? "high" : "standard_deviation")}) {
    if (numbers->size() == 1 || numbers->size() == size) continue;
    throw InvalidInput(std::string(name) + " has " + std::to_string(numbers->size()) + " numbers, it must have 1 or " +
                       std::to_string(size));
  }
  for (std::size_t i = 0; i < size; ++i) {
    const double first = number_at(d.first, i);
    const double second = number_at(d.second, i);
    if (uniform && first > second) throw InvalidInput("low is " + text(first) + ", more than high, " + text(second));
    if (!uniform && second < 0) throw InvalidInput("standard_deviation is " + text(second) + ", less than 0");
  }
}

std::vector<double> draw_checked(const Distribution& d, std::uint64_t seed, const std::string& name, std::size_t size) {
  const Draws draws(seed, name);
  std::vector<double> numbers(size);
  for (std::size_t i = 0; i < size; ++i) numbers[i] = drawn(d, draws, i, size);
  return numbers;
}

std::string shown_with(const RandomQuantity& quantity, const std::string& message) {
  return "randomize " + quantity.name + ": " + message;
}

/// Calls `use`, and adds the quantity to its errors.
template <class Use>
auto naming(const RandomQuantity& quantity, const Use& use) {
  try {
    return use();
  } catch (const InvalidInput& error) {
    if (!quantity.file.empty()) {
      throw SceneError({{quantity.file, quantity.line, "", shown_with(quantity, error.what())}});
    }
    throw InvalidInput(shown_with(quantity, error.what()));
  }
}

std::vector<std::string> names_in(const Quantities& quantities) {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities.list()) names.push_back(quantity.name);
  return names;
}

}  // namespace

Randomization::Randomization(Simulation& example, const std::vector<RandomQuantity>& quantities) {
  for (const RandomQuantity& quantity : quantities) {
    naming(quantity, [&] {
      Quantities commands(example, {quantity.name}, Quantities::Use::kCommand);
      for (const Quantity& one : commands.list()) check_distribution(quantity.distribution, one.size);
      const bool changes = quantity.distribution.operation != DrawOperation::kSet;
      Quantities present(example, changes ? names_in(commands) : std::vector<std::string>(), Quantities::Use::kObserve);
      items_.push_back({quantity, std::move(commands), std::move(present)});
    });
  }
}

void Randomization::apply(Simulation& simulation) const {
  for (const Item& item : items_) {
    const Distribution& distribution = item.quantity.distribution;
    std::vector<double> values(item.commands.width());
    const Row row(values.data(), NumberType::kFloat64);
    naming(item.quantity, [&] {
      item.present.observe(simulation, row);
      for (const Quantity& one : item.commands.list()) {
        const std::vector<double> numbers = draw_checked(distribution, simulation.seed(), one.name, one.size);
        for (std::size_t i = 0; i < one.size; ++i) {
          double& value = values[one.start + i];
          const double number = numbers[i];
          if (distribution.operation == DrawOperation::kSet) value = number;
          if (distribution.operation == DrawOperation::kAdd) value += number;
          if (distribution.operation == DrawOperation::kScale) value *= number;
        }
      }
      item.commands.command(simulation, row);
    });
  }
}

std::vector<double> draw(const Distribution& distribution, std::uint64_t seed, const std::string& name,
                         std::size_t size) {
  check_distribution(distribution, size);
  return draw_checked(distribution, seed, name, size);
}

}  // namespace bubblesim
