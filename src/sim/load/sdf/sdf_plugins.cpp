// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_plugins.hpp"

#include <utility>

#include "load/sdf/sdf_source.hpp"

namespace bubblesim {
namespace {

std::vector<PluginParameter> read_parameters(const sdf::ElementPtr& element) {
  std::vector<PluginParameter> parameters;
  for (sdf::ElementPtr child = element->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    PluginParameter parameter;
    parameter.name = child->GetName();
    if (child->GetValue() != nullptr) parameter.text = child->GetValue()->GetAsString();
    for (const auto& attribute : child->GetAttributes()) {
      parameter.children.push_back({attribute->GetKey(), attribute->GetAsString(), {}, source_of(child)});
    }
    const std::vector<PluginParameter> elements = read_parameters(child);
    parameter.children.insert(parameter.children.end(), elements.begin(), elements.end());
    parameter.source = source_of(child);
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

}  // namespace

std::vector<PluginDescription> read_plugins(const sdf::ElementPtr& owner) {
  std::vector<PluginDescription> plugins;
  if (!owner->HasElement("plugin")) return plugins;
  for (sdf::ElementPtr element = owner->GetElement("plugin"); element != nullptr;
       element = element->GetNextElement("plugin")) {
    plugins.push_back({element->Get<std::string>("name"), element->Get<std::string>("filename"),
                       read_parameters(element), source_of(element)});
  }
  return plugins;
}

}  // namespace bubblesim
