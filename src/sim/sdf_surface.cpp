// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_surface.hpp"

#include "sdf_source.hpp"

namespace bubblesim {

Surface read_surface(const sdf::ElementPtr& collision, const std::string& path, SceneReading& reading) {
  Surface surface;
  if (!collision->HasElement("surface")) return surface;
  const sdf::ElementPtr element = collision->GetElement("surface");
  if (element->HasElement("friction") && element->GetElement("friction")->HasElement("ode")) {
    surface.mu = element->GetElement("friction")->GetElement("ode")->Get<double>("mu", surface.mu).first;
  }
  if (element->HasElement("contact")) {
    const sdf::ElementPtr contact = element->GetElement("contact");
    const auto mask = contact->Get<unsigned int>("collide_bitmask", surface.collide_bitmask).first;
    if (mask > 0xffff) {
      reading.report(source_of(contact, "collide_bitmask"), path,
                     "<collide_bitmask> is " + std::to_string(mask) + ", it must be 0 to 65535: there are 16 bits");
    }
    surface.collide_bitmask = static_cast<std::uint16_t>(mask);
  }
  return surface;
}

}  // namespace bubblesim
