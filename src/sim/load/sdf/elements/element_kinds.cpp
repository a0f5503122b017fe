// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/element_kinds.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "bubblesim/sensor_definition.hpp"
#include "load/sdf/elements/element_table.hpp"

namespace bubblesim {
namespace {

constexpr std::string_view kOwnPrefix = "bubblesim:";

const std::map<std::string, ValueType>& types() {
  static const std::map<std::string, ValueType> names = {
      {"none", ValueType::kNone},       {"any", ValueType::kAny},         {"text", ValueType::kText},
      {"flag", ValueType::kFlag},       {"integer", ValueType::kInteger}, {"number", ValueType::kNumber},
      {"vector2", ValueType::kVector2}, {"vector3", ValueType::kVector3}, {"color", ValueType::kColor},
      {"pose", ValueType::kPose},
  };
  return names;
}

/// A line of the table.
struct Line {
  std::size_t depth = 0;
  std::vector<std::string> words;
  Effect effect = Effect::kRead;
  std::string reason;
};

/// Splits a string at spaces; words in single quotes may contain some.
std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(' '); at != std::string_view::npos;
       at = text.find_first_not_of(' ', at)) {
    const bool is_quoted = text[at] == '\'';
    const std::size_t start = is_quoted ? at + 1 : at;
    const std::size_t end = std::min(text.find(is_quoted ? '\'' : ' ', start), text.size());
    words.emplace_back(text.substr(start, end - start));
    at = std::min(end + 1, text.size());
  }
  return words;
}

Line to_line(std::string_view text) {
  Line line;
  const std::size_t start = text.find_first_not_of(' ');
  line.depth = start / 2;
  text.remove_prefix(start);
  const std::size_t mark = std::min(text.find(" ~ "), text.find(" ! "));
  if (mark != std::string_view::npos) {
    line.effect = text[mark + 1] == '~' ? Effect::kNone : Effect::kLeftOut;
    line.reason = text.substr(mark + 3);
    text = text.substr(0, mark);
  }
  line.words = words_in(text);
  return line;
}

std::vector<Line> lines_of(std::string_view table) {
  std::vector<Line> lines;
  for (std::string_view rest = table; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (text.find_first_not_of(' ') != std::string_view::npos) lines.push_back(to_line(text));
  }
  return lines;
}

/// With the lines of the kinds of sensors in their place, and their definitions at the end.
std::vector<Line> lines_of_table(const std::vector<const SensorDefinition*>& sensors) {
  std::vector<std::string> parts;
  for (const SensorDefinition* sensor : sensors) parts.push_back(sensor->elements);
  std::sort(parts.begin(), parts.end());
  std::vector<Line> below;
  std::vector<Line> definitions;
  for (const std::string& part : parts) {
    std::vector<Line>* to = &below;
    for (Line& line : lines_of(part)) {
      if (line.words.front().front() == '=') to = &definitions;
      to->push_back(std::move(line));
    }
  }
  std::vector<Line> lines;
  for (const char* table : {kShapeTable, kModelTable, kWorldTable}) {
    for (Line& line : lines_of(table)) {
      if (line.words.front() == "&sensor_kinds") {
        lines.insert(lines.end(), below.begin(), below.end());
      } else {
        lines.push_back(std::move(line));
      }
    }
  }
  lines.insert(lines.end(), definitions.begin(), definitions.end());
  return lines;
}

/// Holds all kinds. Definitions that refer to each other, such as a model within a model, share their children.
class Kinds {
 public:
  explicit Kinds(const std::vector<const SensorDefinition*>& sensors) {
    const std::vector<Line> lines = lines_of_table(sensors);
    std::vector<ElementKind*> open;
    for (const Line& line : lines) {
      open.resize(line.depth);
      const std::string& name = line.words.front();
      if (name.front() == '=') {
        open = {&definition(name.substr(1))};
      } else if (name.front() == '&') {
        references_.emplace_back(open.back(), name.substr(1));
      } else if (name.front() == '@') {
        open.back()->attributes.push_back(
            {name.substr(1), types().at(line.words.at(1)), line.words.size() > 2 ? line.words[2] : ""});
      } else {
        ElementKind& kind = add(line);
        open.back()->children.push_back(&kind);
        open.push_back(&kind);
      }
    }
    for (const auto& [user, name] : references_) resolve(*user, name);
  }

  const ElementKind& root() const { return *definitions_.at("sdf"); }

 private:
  ElementKind& add(const Line& line) {
    ElementKind& kind = *all_.emplace_back(std::make_unique<ElementKind>());
    kind.name = line.words.front();
    kind.type = types().at(line.words.at(1));
    kind.effect = line.effect;
    kind.reason = line.reason;
    for (std::size_t i = 2; i < line.words.size(); ++i) {
      const std::string& word = line.words[i];
      if (const std::size_t dots = word.find(".."); dots != std::string::npos) {
        if (dots > 0) kind.min = std::strtod(word.c_str(), nullptr);
        if (dots + 2 < word.size()) kind.max = std::strtod(word.c_str() + dots + 2, nullptr);
      } else if (word == "required") {
        kind.required = true;
      } else {
        kind.default_text = word;
      }
    }
    return kind;
  }

  ElementKind& definition(const std::string& name) {
    ElementKind& kind = *all_.emplace_back(std::make_unique<ElementKind>());
    kind.name = name;
    definitions_.emplace(name, &kind);
    return kind;
  }

  /// Adds the children and attributes of a definition, whose own references are resolved first.
  void resolve(ElementKind& user, const std::string& name) {
    if (!resolved_.insert(&user).second) return;
    ElementKind& used = *definitions_.at(name);
    for (const auto& [inner, inner_name] : references_) {
      if (inner == &used) resolve(*inner, inner_name);
    }
    user.children.insert(user.children.begin(), used.children.begin(), used.children.end());
    user.attributes.insert(user.attributes.begin(), used.attributes.begin(), used.attributes.end());
  }

  std::vector<std::unique_ptr<ElementKind>> all_;
  std::map<std::string, ElementKind*> definitions_;
  std::vector<std::pair<ElementKind*, std::string>> references_;
  std::set<ElementKind*> resolved_;
};

template <class Visit>
void visit_all(const ElementKind& kind, std::set<const ElementKind*>& seen, const Visit& visit) {
  if (!seen.insert(&kind).second) return;
  for (const ElementKind* child : kind.children) visit(kind, *child);
  for (const ElementKind* child : kind.children) visit_all(*child, seen, visit);
}

}  // namespace

std::string type_name(ValueType type) {
  for (const auto& [name, named] : types()) {
    if (named == type) return name;
  }
  throw std::logic_error("a type without a name");
}

const ElementKind* ElementKind::child(std::string_view child_name) const {
  for (const ElementKind* each : children) {
    if (each->name == child_name) return each;
  }
  return nullptr;
}

const AttributeKind* ElementKind::attribute(std::string_view attribute_name) const {
  for (const AttributeKind& each : attributes) {
    if (each.name == attribute_name) return &each;
  }
  return nullptr;
}

const ElementKind& sdf_kind() {
  static std::mutex mutex;
  static std::map<std::size_t, const Kinds>
      tables;  // by the number of sensor kinds; elements of earlier ones are in use
  const std::vector<const SensorDefinition*> sensors = sensor_definitions();
  const std::lock_guard<std::mutex> lock(mutex);
  return tables.try_emplace(sensors.size(), sensors).first->second.root();
}

const ElementKind& world_kind() { return *sdf_kind().child("world"); }
const ElementKind& model_kind() { return *sdf_kind().child("model"); }
const ElementKind& link_kind() { return *model_kind().child("link"); }
const ElementKind& joint_kind() { return *model_kind().child("joint"); }
const ElementKind& light_kind() { return *sdf_kind().child("light"); }

bool is_own_element(std::string_view name) { return name.substr(0, kOwnPrefix.size()) == kOwnPrefix; }

std::vector<std::string> parents_of_own(std::string_view name) {
  std::vector<std::string> parents;
  std::set<const ElementKind*> seen;
  visit_all(sdf_kind(), seen, [&](const ElementKind& parent, const ElementKind& child) {
    if (child.name != name) return;
    if (std::find(parents.begin(), parents.end(), parent.name) == parents.end()) parents.push_back(parent.name);
  });
  return parents;
}

std::vector<std::string> own_elements() {
  std::set<std::string> names;
  std::set<const ElementKind*> seen;
  visit_all(sdf_kind(), seen, [&](const ElementKind&, const ElementKind& child) {
    if (is_own_element(child.name)) names.insert(child.name);
  });
  return {names.begin(), names.end()};
}

}  // namespace bubblesim
