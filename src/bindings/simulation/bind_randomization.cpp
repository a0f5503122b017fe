// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Distribution, and what is drawn of it.
#include <pybind11/stl.h>

#include <utility>
#include <variant>

#include "bindings.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/randomization.hpp"
#include "simulation/random_quantities.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

using DrawnNumbers = std::variant<double, std::vector<double>>;
using DrawnRows = std::variant<std::vector<double>, std::vector<std::vector<double>>>;

std::vector<double> flattened(const DrawnNumbers& numbers) {
  if (const auto* one = std::get_if<double>(&numbers)) return {*one};
  return std::get<1>(numbers);
}

std::vector<double> flattened(const DrawnRows& rows) {
  if (const auto* numbers = std::get_if<0>(&rows)) return *numbers;
  std::vector<double> all;
  for (const std::vector<double>& row : std::get<1>(rows)) all.insert(all.end(), row.begin(), row.end());
  return all;
}

Distribution make_distribution(Distribution::Kind kind, const std::string& operation, std::vector<double> first,
                               std::vector<double> second) {
  using Operation = Distribution::Operation;
  for (const auto& [name, meaning] :
       {std::pair("set", Operation::kSet), std::pair("add", Operation::kAdd), std::pair("scale", Operation::kScale)}) {
    if (operation == name) return {kind, meaning, std::move(first), std::move(second)};
  }
  throw InvalidInput("operation '" + operation + "' is not usable: it must be 'set', 'add' or 'scale'");
}

}  // namespace

std::vector<RandomQuantity> to_random_quantities(const Distributions& distributions) {
  std::vector<RandomQuantity> made;
  for (const auto& [name, distribution] : distributions) {
    if (!py::isinstance<py::str>(name) || !py::isinstance<Distribution>(distribution)) {
      throw py::type_error(
          "randomize: expected Distributions by quantity, such as {'/Robot.mass': "
          "bubblesim.Distribution.uniform(1, 2)}");
    }
    made.push_back({name.cast<std::string>(), distribution.cast<Distribution>(), "", 0});
  }
  return made;
}

void bind_randomization(py::module_& module) {
  using Kind = Distribution::Kind;
  py::class_<Distribution>(module, "Distribution",
                           "How the numbers of a quantity are drawn, each by itself, SI units.\n\n"
                           "`operation` 'set' replaces the numbers of the quantity, 'add' adds to them, 'scale' "
                           "multiplies them.")
      .def_static(
          "uniform",
          [](const DrawnNumbers& low, const DrawnNumbers& high, const std::string& operation) {
            return make_distribution(Kind::kUniform, operation, flattened(low), flattened(high));
          },
          py::arg("low"), py::arg("high"), py::kw_only(), py::arg("operation") = "set",
          "From `low` to `high`: a number, or one for each number of the quantity.")
      .def_static(
          "normal",
          [](const DrawnNumbers& mean, const DrawnNumbers& standard_deviation, const std::string& operation) {
            return make_distribution(Kind::kNormal, operation, flattened(mean), flattened(standard_deviation));
          },
          py::arg("mean"), py::arg("standard_deviation"), py::kw_only(), py::arg("operation") = "set",
          "With a mean and a standard deviation: a number, or one for each number of the quantity.")
      .def_static(
          "choice",
          [](const DrawnRows& values, const std::string& operation) {
            return make_distribution(Kind::kChoice, operation, flattened(values), {});
          },
          py::arg("values"), py::kw_only(), py::arg("operation") = "set",
          "One of some values, all equally likely; a quantity of several numbers needs a list for each value.")
      .def("draw", &draw, py::arg("seed"), py::arg("name"), py::arg("size") = 1,
           "Return the numbers that a quantity with this name gets in a simulation with this seed; for what is not a\n"
           "quantity, any other name.\n\n"
           ":raises ValueError: if the distribution does not fit `size` numbers.");
}

void randomize(Simulation& simulation, const Distributions& distributions) {
  Randomization(simulation, to_random_quantities(distributions)).apply(simulation);
}

}  // namespace bubblesim::bindings
