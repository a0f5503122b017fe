// SPDX-License-Identifier: BSD-3-Clause
#include "load/xml_lines.hpp"

#include <algorithm>
#include <string_view>

namespace bubblesim {
namespace {

int lines_in(const char* text) {
  const std::string_view all(text != nullptr ? text : "");
  return static_cast<int>(std::count(all.begin(), all.end(), '\n'));
}

class LinePrinter final : public tinyxml2::XMLPrinter {
 public:
  LinePrinter() : XMLPrinter(nullptr, true) {}

  using XMLPrinter::Visit;
  using XMLPrinter::VisitEnter;
  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute* attributes) override {
    go_to(element.GetLineNum());
    for (const auto* each = attributes; each != nullptr; each = each->Next()) line_ += lines_in(each->Value());
    return XMLPrinter::VisitEnter(element, attributes);
  }
  bool Visit(const tinyxml2::XMLText& text) override {
    line_ += lines_in(text.Value());
    return XMLPrinter::Visit(text);
  }
  bool Visit(const tinyxml2::XMLComment&) override { return true; }

 private:
  void go_to(int line) {
    for (; line_ < line; ++line_) PushText("\n");
  }

  int line_ = 1;
};

}  // namespace

std::string print_in_lines(const tinyxml2::XMLDocument& document) {
  LinePrinter printer;
  document.Accept(&printer);
  return printer.CStr();
}

std::string without_late_declaration(std::string text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  const std::size_t declaration = text.find("<?xml ");
  if (start == std::string::npos || declaration == std::string::npos || declaration <= start) return text;
  // Only comments may be before it: otherwise it is part of the content.
  for (std::size_t place = start; place < declaration;) {
    if (text.compare(place, 4, "<!--") != 0) return text;
    const std::size_t end = text.find("-->", place);
    if (end == std::string::npos || end > declaration) return text;
    place = text.find_first_not_of(" \t\r\n", end + 3);
  }
  const std::size_t end = text.find("?>", declaration);
  if (end == std::string::npos) return text;
  std::replace_if(
      text.begin() + static_cast<std::ptrdiff_t>(declaration), text.begin() + static_cast<std::ptrdiff_t>(end) + 2,
      [](char character) { return character != '\n'; }, ' ');
  return text;
}

std::string object_path(const tinyxml2::XMLElement& element) {
  const std::string_view kind = element.Name();
  if (kind == "world" || kind == "sdf") return "";
  const auto* parent = element.Parent() != nullptr ? element.Parent()->ToElement() : nullptr;
  const char* name = element.Attribute("name");
  return (parent != nullptr ? object_path(*parent) : "") + (name != nullptr ? "/" + std::string(name) : "");
}

}  // namespace bubblesim
