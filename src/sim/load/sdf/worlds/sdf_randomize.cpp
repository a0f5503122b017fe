// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/worlds/sdf_randomize.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/elements/own_elements.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

using DrawKind = Distribution::Kind;
using DrawOperation = Distribution::Operation;

/// Reads the attributes of one element.
class RandomizeReader {
 public:
  RandomizeReader(const XmlElement& element, LoadContext& context) : element_(element), context_(context) {}

  RandomQuantity read() {
    const Source source = element_.source();
    RandomQuantity made{word("quantity"), {}, source.file, source.line};
    if (made.name.empty()) report("has no attribute quantity, such as quantity=\"/Robot.mass\"");
    const std::vector<std::pair<std::string, DrawKind>> kinds = {
        {"uniform", DrawKind::kUniform}, {"normal", DrawKind::kNormal}, {"choice", DrawKind::kChoice}};
    const std::vector<std::pair<std::string, DrawOperation>> operations = {
        {"set", DrawOperation::kSet}, {"add", DrawOperation::kAdd}, {"scale", DrawOperation::kScale}};
    made.distribution.kind = one_of("distribution", "uniform", kinds);
    made.distribution.operation = one_of("operation", "set", operations);
    std::vector<std::string> known = {"quantity", "distribution", "operation"};
    switch (made.distribution.kind) {
      case DrawKind::kUniform:
        made.distribution.first = numbers("low", known);
        made.distribution.second = numbers("high", known);
        break;
      case DrawKind::kNormal:
        made.distribution.first = numbers("mean", known);
        made.distribution.second = numbers("standard_deviation", known);
        break;
      case DrawKind::kChoice:
        made.distribution.first = numbers("values", known);
        break;
    }
    for (const XmlAttribute& attribute : element_.attributes) {
      if (std::find(known.begin(), known.end(), attribute.name) != known.end()) continue;
      report("has an unknown attribute " + attribute.name + did_you_mean(attribute.name, known));
    }
    return made;
  }

 private:
  void report(const std::string& message) {
    context_.report(element_.source(), "", "<" + element_.name + "> " + message);
  }

  bool has(const std::string& name) const { return element_.attribute(name) != nullptr; }

  std::string word(const std::string& name) const { return has(name) ? trimmed(*element_.attribute(name)) : ""; }

  template <class Value>
  Value one_of(const std::string& name, const std::string& by_default,
               const std::vector<std::pair<std::string, Value>>& values) {
    const std::string found = has(name) ? word(name) : by_default;
    std::vector<std::string> names;
    for (const auto& [known, value] : values) {
      if (known == found) return value;
      names.push_back(known);
    }
    report("has the " + name + " '" + found + "', it must be " + names[0] + ", " + names[1] + " or " + names[2] +
           did_you_mean(found, names));
    return values.front().second;
  }

  std::vector<double> numbers(const std::string& name, std::vector<std::string>& known) {
    known.push_back(name);
    const std::optional<std::vector<double>> found = to_numbers(word(name));
    if (found && !found->empty()) return *found;
    report(has(name) ? "has the " + name + " '" + word(name) + "', it must be numbers" : "needs the attribute " + name);
    return {};
  }

  const XmlElement& element_;
  LoadContext& context_;
};

}  // namespace

std::vector<RandomQuantity> read_randomized(const SdfElement& world, LoadContext& context) {
  std::vector<RandomQuantity> made;
  for (const SdfElement& element : world.children("bubblesim:randomize")) {
    made.push_back(RandomizeReader(element.xml(), context).read());
  }
  return made;
}

}  // namespace bubblesim
