// SPDX-License-Identifier: BSD-3-Clause
// The table of elements, compared with the specification of SDFormat 1.9 (sdformat_1_9.txt: path, type and default of
// each element and attribute; parts that several elements have are listed once).
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "load/sdf/elements/element_kinds.hpp"
#include "load/sdf/elements/sdf_element.hpp"
#include "scene/text_values.hpp"

namespace bubblesim::test::test_element_table {
namespace {

struct Specified {
  std::vector<std::string> path;
  std::string type;
  std::string default_text;
};

std::vector<Specified> specification() {
  std::vector<Specified> all;
  std::ifstream file(BUBBLESIM_SPECIFICATION);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string path;
    Specified& each = all.emplace_back();
    words >> path >> each.type >> std::ws;
    std::getline(words, each.default_text);
    std::istringstream names(path);
    for (std::string name; std::getline(names, name, '/');) each.path.push_back(name);
  }
  return all;
}

/// The element at a path below <sdf>, or the first one above it whose content is not checked; null when there is none.
const ElementKind* find(const std::vector<std::string>& path) {
  const ElementKind* kind = &sdf_kind();
  for (std::size_t i = 1; i < path.size() && kind != nullptr && kind->type != ValueType::kAny; ++i) {
    if (path[i].front() == '@') break;
    kind = kind->child(path[i]);
  }
  return kind;
}

std::string joined(const std::vector<std::string>& path) {
  std::string text;
  for (const std::string& name : path) text += (text.empty() ? "" : "/") + name;
  return text;
}

/// Equal as numbers, or as strings.
bool same_value(const std::string& one, const std::string& other) {
  std::vector<double> numbers;
  std::vector<double> others;
  if (read_numbers(one, numbers) && read_numbers(other, others)) return numbers == others;
  return one == other;
}

TEST(ElementTable, HasEachElementOfTheSpecification) {
  for (const Specified& specified : specification()) {
    EXPECT_NE(find(specified.path), nullptr) << joined(specified.path);
  }
}

TEST(ElementTable, HasTheTypesOfTheSpecification) {
  for (const Specified& specified : specification()) {
    const ElementKind* kind = find(specified.path);
    if (kind == nullptr || kind->type == ValueType::kAny || specified.path.back().front() == '@') continue;
    EXPECT_EQ(type_name(kind->type), specified.type) << joined(specified.path);
  }
}

TEST(ElementTable, HasTheDefaultsOfTheSpecification) {
  for (const Specified& specified : specification()) {
    const ElementKind* kind = find(specified.path);
    const bool has_none = specified.type == "none" || specified.type == "pose" || specified.type == "text";
    if (kind == nullptr || kind->type == ValueType::kAny || has_none || specified.path.back().front() == '@') continue;
    EXPECT_TRUE(same_value(kind->default_text, specified.default_text))
        << joined(specified.path) << ": " << kind->default_text << " and not " << specified.default_text;
  }
}

TEST(ElementTable, HasTheAttributesOfTheSpecification) {
  for (const Specified& specified : specification()) {
    if (specified.path.back().front() != '@') continue;
    const ElementKind* kind = find(specified.path);
    if (kind == nullptr || kind->type == ValueType::kAny) continue;
    EXPECT_NE(kind->attribute(specified.path.back().substr(1)), nullptr) << joined(specified.path);
  }
}

TEST(ElementTable, StatesWhyAnElementIsLeftOut) {
  for (const Specified& specified : specification()) {
    const ElementKind* kind = find(specified.path);
    if (kind == nullptr || kind->effect == Effect::kRead) continue;
    EXPECT_FALSE(kind->reason.empty()) << joined(specified.path);
  }
}

TEST(ElementTable, ContainsModelsInModels) {
  const ElementKind* model = find({"sdf", "model", "model", "model", "link", "collision", "geometry", "box", "size"});
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->default_text, "1 1 1");
}

TEST(OwnElements, KnowTheirParents) {
  EXPECT_EQ(parents_of_own("bubblesim:rolling"), std::vector<std::string>{"friction"});
  EXPECT_TRUE(parents_of_own("bubblesim:unheard_of").empty());
}

}  // namespace
}  // namespace bubblesim::test::test_element_table
