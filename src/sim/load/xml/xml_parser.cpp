// SPDX-License-Identifier: BSD-3-Clause
#include "load/xml/xml_parser.hpp"

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <utility>

#include "load/xml/xml_tags.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

constexpr std::size_t kMostElements = 1'000'000;
constexpr std::size_t kLongestName = 1000;
constexpr std::size_t kLongestText = 1'000'000;
constexpr int kDeepest = 256;  // the tree is walked and freed recursively

bool is_utf8(const std::string& text) {
  std::size_t following = 0;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (following > 0) {
      if ((byte & 0xC0U) != 0x80U) return false;
      --following;
    } else if (byte >= 0x80U) {
      following = byte >= 0xF0U ? 3 : byte >= 0xE0U ? 2 : 1;
      if (byte < 0xC2U || byte > 0xF4U) return false;
    }
  }
  return following == 0;
}

/// Some files are in Latin-1, regardless of their declaration.
std::string from_latin1(const std::string& text) {
  std::string converted;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x80U) {
      converted += character;
    } else {
      converted += static_cast<char>(0xC0U | (byte >> 6U));
      converted += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return converted;
}

/// Returns the line of an offset in a string.
class Lines {
 public:
  explicit Lines(const std::string& text) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) ends_.push_back(at);
  }
  int at(std::ptrdiff_t offset) const {
    const auto end = std::lower_bound(ends_.begin(), ends_.end(), static_cast<std::size_t>(offset));
    return static_cast<int>(end - ends_.begin()) + 1;
  }

 private:
  std::vector<std::size_t> ends_;
};

/// Copies pugixml's tree and checks its limits.
class TreeCopy {
 public:
  TreeCopy(const std::string& text, const std::string& file)
      : file_(std::make_shared<const std::string>(file)), lines_(text) {}

  XmlElement copy(const pugi::xml_node& node, int depth = 1) {
    XmlElement element;
    element.file = file_;
    element.line = lines_.at(node.offset_debug());
    element.name = node.name();
    check_length("the element name", element.name, kLongestName, element.line);
    if (depth > kDeepest) fail(element.line, "elements are nested more than " + std::to_string(kDeepest) + " deep");
    if (++count_ > kMostElements) fail(element.line, "too many elements: more than " + std::to_string(kMostElements));
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      element.attributes.push_back({attribute.name(), attribute.value()});
      const bool is_name = element.attributes.back().name == "name";
      if (is_name) element.attributes.back().value = trimmed(element.attributes.back().value);
      check_length(is_name ? "the name" : "the attribute " + element.attributes.back().name,
                   element.attributes.back().value, is_name ? kLongestName : kLongestText, element.line);
    }
    std::size_t elements = 0;
    for (const pugi::xml_node& child : node.children()) elements += child.type() == pugi::node_element ? 1 : 0;
    element.children.reserve(elements);
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element) {
        element.children.push_back(copy(child, depth + 1));
      } else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        element.text += child.value();
      }
    }
    check_length("the text of <" + element.name + ">", element.text, kLongestText, element.line);
    element.text = trimmed(element.text);
    return element;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw SceneError({{*file_, line, "", message}});
  }

  void check_length(const std::string& what, const std::string& text, std::size_t most, int line) const {
    if (text.size() <= most) return;
    fail(line, what.substr(0, 60) + " '" + text.substr(0, 40) + "...' has " + std::to_string(text.size()) +
                   " characters; the maximum is " + std::to_string(most));
  }

  std::shared_ptr<const std::string> file_;
  Lines lines_;
  std::size_t count_ = 0;
};

pugi::xml_parse_result parse(pugi::xml_document& document, const std::string& text) {
  return document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
}

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

void write(const XmlElement& element, pugi::xml_node parent) {
  pugi::xml_node node = parent.append_child(element.name.c_str());
  for (const XmlAttribute& each : element.attributes) {
    node.append_attribute(each.name.c_str()).set_value(each.value.c_str());
  }
  if (!element.text.empty()) node.text().set(element.text.c_str());
  for (const XmlElement& child : element.children) write(child, node);
}

struct StringWriter final : pugi::xml_writer {
  void write(const void* data, std::size_t size) override { text.append(static_cast<const char*>(data), size); }
  std::string text;
};

}  // namespace

XmlElement parse_xml(const std::string& given, const std::string& file, std::vector<Problem>& warnings) {
  const auto fail = [&](int line, const std::string& message) { throw SceneError({{file, line, "", message}}); };
  std::string text = given.rfind("\xef\xbb\xbf", 0) == 0 ? given.substr(3) : given;
  if (trimmed(text).empty()) fail(0, "is empty");
  if (!is_utf8(text)) text = from_latin1(text);
  pugi::xml_document document;
  pugi::xml_parse_result result = parse(document, text);
  if (result.status == pugi::status_bad_attribute || result.status == pugi::status_bad_start_element) {
    QuotedText quoted = with_quoted_attributes(text);
    pugi::xml_document mended;
    if (const pugi::xml_parse_result second = parse(mended, quoted.text); second) {
      for (const int line : quoted.lines) {
        warnings.push_back({file, line, "", "an attribute has no quotes: read as if it had"});
      }
      text = std::move(quoted.text);
      document = std::move(mended);
      result = second;
    }
  }
  if (!result && result.status != pugi::status_no_document_element) {
    if (const auto fault = find_unclosed_tag(text)) fail(fault->line, "is not well-formed XML: " + fault->message);
    fail(Lines(text).at(result.offset), "is not well-formed XML: " + lower_first(result.description()));
  }
  const pugi::xml_node root = document.document_element();
  if (!root) fail(0, "contains no XML element");
  return TreeCopy(text, file).copy(root);
}

std::string to_xml(const XmlElement& root) {
  pugi::xml_document document;
  write(root, document);
  StringWriter writer;
  document.save(writer, "  ", pugi::format_default | pugi::format_no_declaration, pugi::encoding_utf8);
  return std::move(writer.text);
}

}  // namespace bubblesim
