// SPDX-License-Identifier: BSD-3-Clause
#include "load/xml/xml_element.hpp"

#include <algorithm>
#include <utility>

namespace bubblesim {
namespace {

const std::string kEmpty;

}  // namespace

const std::string* XmlElement::attribute(std::string_view name) const {
  for (const XmlAttribute& each : attributes) {
    if (each.name == name) return &each.value;
  }
  return nullptr;
}

void XmlElement::set_attribute(std::string_view name, std::string value) {
  for (XmlAttribute& each : attributes) {
    if (each.name != name) continue;
    each.value = std::move(value);
    return;
  }
  attributes.push_back({std::string(name), std::move(value)});
}

void XmlElement::remove_attribute(std::string_view name) {
  attributes.erase(std::remove_if(attributes.begin(), attributes.end(),
                                  [name](const XmlAttribute& each) { return each.name == name; }),
                   attributes.end());
}

const std::string& XmlElement::given_name() const {
  const std::string* found = attribute("name");
  return found != nullptr ? *found : kEmpty;
}

const XmlElement* XmlElement::child(std::string_view name) const {
  for (const XmlElement& each : children) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

XmlElement* XmlElement::child(std::string_view name) {
  return const_cast<XmlElement*>(std::as_const(*this).child(name));  // NOLINT: this element is not const
}

const std::string& XmlElement::child_text(std::string_view name) const {
  const XmlElement* found = child(name);
  return found != nullptr ? found->text : kEmpty;
}

XmlElement& XmlElement::add_child(std::string name, std::string text) {
  XmlElement& added = children.emplace_back();
  added.name = std::move(name);
  added.text = std::move(text);
  added.file = file;
  added.line = line;
  return added;
}

void XmlElement::remove_children(std::string_view name) {
  children.erase(
      std::remove_if(children.begin(), children.end(), [name](const XmlElement& each) { return each.name == name; }),
      children.end());
}

void XmlElement::replace_child(XmlElement replacement) {
  remove_children(replacement.name);
  children.push_back(std::move(replacement));
}

std::size_t count_elements(const XmlElement& element) {
  std::size_t count = 1;
  for (const XmlElement& child : element.children) count += count_elements(child);
  return count;
}

}  // namespace bubblesim
