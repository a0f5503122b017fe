// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_surface.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "load/sdf/sdf_source.hpp"
#include "load/sdf_extensions.hpp"

namespace bubblesim {
namespace {

/// The element at a path of names, or null.
sdf::ElementPtr below(sdf::ElementPtr element, std::initializer_list<const char*> way) {
  for (const char* name : way) {
    if (element == nullptr || !element->HasElement(name)) return nullptr;
    element = element->GetElement(name);
  }
  return element;
}

/// Overwrites `value` if the file has the element.
template <class T, class Value>
void read(const sdf::ElementPtr& element, const char* name, Value& value) {
  if (element != nullptr && element->HasElement(name)) value = element->Get<T>(name);
}

/// Like Gazebo: the torque of a Hertzian contact patch, with a separate coefficient. The radius of the patch is given,
/// or is that of a sphere that is pressed in: sqrt(surface_radius * depth).
void read_torsion(const sdf::ElementPtr& element, Surface& surface) {
  if (element == nullptr) return;
  double coefficient = 1;
  bool use_patch_radius = true;
  double patch_radius = 0;
  double surface_radius = 0;
  read<double>(element, "coefficient", coefficient);
  read<bool>(element, "use_patch_radius", use_patch_radius);
  read<double>(element, "patch_radius", patch_radius);
  read<double>(element, "surface_radius", surface_radius);
  const double factor = 3 * M_PI / 16 * coefficient;
  if (use_patch_radius) {
    surface.torsion = factor * patch_radius;
  } else {  // libsdformat reports a negative radius
    surface.torsion_by_depth = factor * std::sqrt(std::max(surface_radius, 0.0));
  }
}

}  // namespace

Surface read_surface(const sdf::ElementPtr& collision, const std::string& path, LoadContext& reading) {
  Surface surface;
  read<int>(collision, "max_contacts", surface.max_contacts);
  const sdf::ElementPtr friction = below(collision, {"surface", "friction", "ode"});
  read<double>(friction, "mu", surface.mu);
  read<double>(friction, "mu2", surface.mu2);
  read<Vector3>(friction, "fdir1", surface.fdir1);
  read<double>(friction, "slip1", surface.slip1);
  read<double>(friction, "slip2", surface.slip2);
  read_torsion(below(collision, {"surface", "friction", "torsional"}), surface);
  if (const sdf::ElementPtr any = below(collision, {"surface", "friction"})) {
    surface.rolling = own_number(any, "bubblesim:rolling", reading.problems()).value_or(0);
  }
  const sdf::ElementPtr bounce = below(collision, {"surface", "bounce"});
  read<double>(bounce, "restitution_coefficient", surface.restitution);
  read<double>(bounce, "threshold", surface.bounce_threshold);

  const sdf::ElementPtr contact = below(collision, {"surface", "contact"});
  if (contact == nullptr) return surface;
  read<bool>(contact, "collide_without_contact", surface.collide_without_contact);
  const auto mask = contact->Get<unsigned int>("collide_bitmask", surface.collide_bitmask).first;
  if (mask > 0xffff) {
    reading.report(source_of(contact, "collide_bitmask"), path,
                   "<collide_bitmask> is " + std::to_string(mask) + ", it must be 0 to 65535 (16 bits)");
  }
  surface.collide_bitmask = static_cast<std::uint16_t>(mask);
  const sdf::ElementPtr ode = below(contact, {"ode"});
  read<double>(ode, "kp", surface.kp);
  read<double>(ode, "kd", surface.kd);
  read<double>(ode, "soft_erp", surface.soft_erp);
  read<double>(ode, "soft_cfm", surface.soft_cfm);
  read<double>(ode, "max_vel", surface.max_vel);
  read<double>(ode, "min_depth", surface.min_depth);
  return surface;
}

}  // namespace bubblesim
