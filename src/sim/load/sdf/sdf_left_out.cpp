// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_left_out.hpp"

#include <map>
#include <vector>

#include "load/load_context.hpp"
#include "load/sdf/sdf_source.hpp"

namespace bubblesim {
namespace {

struct LeftOut {
  const char* name;
  const char* reason;
  bool (*counts)(const sdf::ElementPtr&);  // whether it has an effect
};

bool always(const sdf::ElementPtr&) { return true; }
bool is_true(const sdf::ElementPtr& element) { return element->Get<bool>(); }

const std::vector<LeftOut>& left_out_of(const std::string& owner) {
  static const std::map<std::string, std::vector<LeftOut>> kinds = {
      {"world",
       {{"actor", "actors are not simulated", always},
        {"road", "roads are not simulated", always},
        {"population", "populations of models are not simulated", always},
        {"joint", "joints between models are not simulated", always}}},
      {"model", {{"gripper", "grippers hold objects by contacts, not by a joint", always}}},
      {"link",
       {{"kinematic", "kinematic links are not supported, forces and gravity move the link", is_true},
        {"projector", "projectors are not simulated", always},
        {"battery", "batteries are not simulated", always},
        {"particle_emitter", "particles are not simulated", always},
        {"audio_source", "sound is not simulated", always},
        {"audio_sink", "sound is not simulated", always}}}};
  return kinds.at(owner);
}

}  // namespace

void report_left_out(const sdf::ElementPtr& owner, const std::string& path, LoadContext& reading) {
  for (const LeftOut& kind : left_out_of(owner->GetName())) {
    if (!owner->HasElement(kind.name)) continue;
    for (auto element = owner->GetElement(kind.name); element != nullptr;
         element = element->GetNextElement(kind.name)) {
      if (!kind.counts(element)) continue;
      const std::string name = element->HasAttribute("name") ? element->Get<std::string>("name") : "";
      reading.warn(source_of(element), name.empty() ? path : path + "/" + name,
                   "<" + std::string(kind.name) + "> is ignored: " + kind.reason);
    }
  }
}

}  // namespace bubblesim
