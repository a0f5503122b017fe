// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_randomize.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf_extensions.hpp"

namespace bubblesim {
namespace {

using DrawKind = Distribution::Kind;
using DrawOperation = Distribution::Operation;

/// Reads the attributes of one element.
class RandomizeReader {
 public:
  RandomizeReader(sdf::ElementPtr element, LoadContext& reading) : element_(std::move(element)), reading_(reading) {}

  RandomQuantity read() {
    const Source source = source_of(element_);
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
    for (std::size_t i = 0; i < element_->GetAttributeCount(); ++i) {
      const std::string name = element_->GetAttribute(static_cast<unsigned>(i))->GetKey();
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      report("has an unknown attribute " + name + did_you_mean(name, known));
    }
    return made;
  }

 private:
  void report(const std::string& message) {
    reading_.report(source_of(element_), "", "<" + element_->GetName() + "> " + message);
  }

  std::string word(const std::string& name) const {
    return element_->HasAttribute(name) ? trimmed(element_->GetAttribute(name)->GetAsString()) : "";
  }

  template <class Value>
  Value one_of(const std::string& name, const std::string& by_default,
               const std::vector<std::pair<std::string, Value>>& values) {
    const std::string found = element_->HasAttribute(name) ? word(name) : by_default;
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
    report(element_->HasAttribute(name) ? "has the " + name + " '" + word(name) + "', it must be numbers"
                                        : "needs the attribute " + name);
    return {};
  }

  sdf::ElementPtr element_;
  LoadContext& reading_;
};

}  // namespace

std::vector<RandomQuantity> read_randomized(const sdf::ElementPtr& world, LoadContext& reading) {
  std::vector<RandomQuantity> made;
  for (auto child = world->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    if (child->GetName() == kRandomize) made.push_back(RandomizeReader(child, reading).read());
  }
  return made;
}

}  // namespace bubblesim
