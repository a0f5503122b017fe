// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_plugins.hpp"

#include <utility>

#include "scene/text_values.hpp"

namespace bubblesim {
namespace {

/// The elements of a plugin may have any names. The attributes of each are parameters in it, before its elements.
std::vector<PluginParameter> read_parameters(const XmlElement& element) {
  std::vector<PluginParameter> parameters;
  for (const XmlElement& child : element.children) {
    PluginParameter parameter{child.name, child.text, {}, child.source()};
    for (const XmlAttribute& attribute : child.attributes) {
      parameter.children.push_back({attribute.name, trimmed(attribute.value), {}, child.source()});
    }
    for (PluginParameter& inner : read_parameters(child)) parameter.children.push_back(std::move(inner));
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

}  // namespace

std::vector<PluginDescription> read_plugins(const SdfElement& owner) {
  std::vector<PluginDescription> plugins;
  for (const SdfElement& plugin : owner.children("plugin")) {
    plugins.push_back(
        {plugin.attribute("name"), plugin.attribute("filename"), read_parameters(plugin.xml()), plugin.source()});
  }
  return plugins;
}

}  // namespace bubblesim
