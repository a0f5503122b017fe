// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_grippers.hpp"

#include <algorithm>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "scene/text_values.hpp"

namespace bubblesim {

GripperDescription read_gripper(const SdfElement& gripper, const std::string& inner) {
  const auto link = [&](const std::string& name) { return inner + trimmed(name); };
  const SdfElement check = gripper.child("grasp_check");
  GripperDescription described;
  described.name = gripper.name();
  described.palm = link(gripper.text("palm_link"));
  for (const SdfElement& finger : gripper.children("gripper_link")) described.fingers.push_back(link(finger.as_text()));
  described.min_contacts = static_cast<int>(check.number("min_contact_count"));
  described.attach_steps = static_cast<int>(check.number("attach_steps"));
  described.detach_steps = static_cast<int>(check.number("detach_steps"));
  described.source = gripper.source();
  return described;
}

void leave_out_broken_grippers(ModelDescription& model, LoadContext& context) {
  std::vector<std::string> names;
  for (const LinkDescription& link : model.links) names.push_back(link.name);
  const auto is_link = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto is_broken = [&](const GripperDescription& gripper) {
    std::vector<std::string> links = gripper.fingers;
    links.push_back(gripper.palm);
    const auto missing = std::find_if_not(links.begin(), links.end(), is_link);
    if (missing == links.end() && !gripper.fingers.empty()) return false;
    const std::string why = missing == links.end()
                                ? "it has no <gripper_link>"
                                : "'" + *missing + "' is not a link of this model" + did_you_mean(*missing, names);
    context.warn(gripper.source, "/" + model.name, "the gripper '" + gripper.name + "' is ignored: " + why);
    return true;
  };
  model.grippers.erase(std::remove_if(model.grippers.begin(), model.grippers.end(), is_broken), model.grippers.end());
}

}  // namespace bubblesim
