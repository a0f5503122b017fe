// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/sdf_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "load/sdf/elements/own_elements.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

/// These numbers have no default: without them, other rules apply.
std::optional<double> given(const SdfElement& element, const char* name) {
  return element.has(name) ? std::make_optional(element.number(name)) : std::nullopt;
}

/// Like Gazebo: the torque of a Hertzian contact patch, with a separate coefficient. The radius of the patch is given,
/// or is that of a sphere that is pressed in: sqrt(surface_radius * depth).
void read_torsion(const SdfElement& torsional, Surface& surface) {
  if (!torsional) return;
  const double factor = 3 * M_PI / 16 * torsional.number("coefficient");
  if (torsional.flag("use_patch_radius")) {
    surface.torsion = factor * torsional.number("patch_radius");
  } else {
    surface.torsion_by_depth = factor * std::sqrt(torsional.number("surface_radius"));
  }
}

std::uint16_t bitmask_of(double mask, const Source& source, const std::string& name, const std::string& path,
                         LoadContext& context) {
  constexpr double kAllBits = 0xffff;
  if (mask >= 0 && mask <= kAllBits) return static_cast<std::uint16_t>(mask);
  context.report(source, path, "<" + name + "> is " + text(mask) + ", it must be 0 to 65535 (16 bits)");
  return 0;
}

}  // namespace

Surface read_surface(const SdfElement& collision, const std::string& path, LoadContext& context) {
  Surface surface;
  if (collision.has("max_contacts")) {
    constexpr double kMost = 1e9;
    surface.max_contacts = static_cast<int>(std::max(-kMost, std::min(collision.number("max_contacts"), kMost)));
  }
  const SdfElement element = collision.child("surface");
  const SdfElement friction = element.child("friction");
  const SdfElement pyramid = friction.child("ode");
  surface.mu = pyramid.number("mu");
  surface.mu2 = given(pyramid, "mu2");
  surface.fdir1 = pyramid.vector("fdir1");
  surface.slip1 = pyramid.number("slip1");
  surface.slip2 = pyramid.number("slip2");
  read_torsion(friction.child("torsional"), surface);
  surface.rolling = own_number(friction, "bubblesim:rolling", path, context).value_or(0);
  const SdfElement bounce = element.child("bounce");
  surface.restitution = bounce.number("restitution_coefficient");
  surface.bounce_threshold = bounce.number("threshold");

  const SdfElement contact = element.child("contact");
  if (!contact) return surface;
  surface.collide_without_contact = contact.flag("collide_without_contact");
  surface.collide_bitmask = bitmask_of(contact.number("collide_bitmask"), contact.source("collide_bitmask"),
                                       "collide_bitmask", path, context);
  if (const auto own = own_number(contact, "bubblesim:own_bitmask", path, context)) {
    const Source source = contact.source("bubblesim:own_bitmask");
    surface.own_bitmask = bitmask_of(*own, source, "bubblesim:own_bitmask", path, context);
  }
  const SdfElement ode = contact.child("ode");
  surface.kp = given(ode, "kp");
  surface.kd = given(ode, "kd");
  surface.soft_erp = given(ode, "soft_erp");
  surface.soft_cfm = given(ode, "soft_cfm");
  surface.max_vel = given(ode, "max_vel");
  surface.min_depth = given(ode, "min_depth");
  return surface;
}

}  // namespace bubblesim
