// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the shapes of a link and their materials can be simulated.
#include "scene/describe.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

void check_geometry(Checker& checker, const ModelDescription& model, const Geometry& geometry) {
  if (const auto* box = std::get_if<Box>(&geometry)) {
    checker.check_length("the box's x size", box->size.x());
    checker.check_length("the box's y size", box->size.y());
    checker.check_length("the box's z size", box->size.z());
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    checker.check_length("the sphere's radius", sphere->radius);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    checker.check_length("the cylinder's radius", cylinder->radius);
    checker.check_length("the cylinder's length", cylinder->length);
  } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
    checker.check_length("the capsule's radius", capsule->radius);
    checker.check_length("the capsule's length", capsule->length);
  } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry)) {
    checker.check_length("the ellipsoid's x radius", ellipsoid->radii.x());
    checker.check_length("the ellipsoid's y radius", ellipsoid->radii.y());
    checker.check_length("the ellipsoid's z radius", ellipsoid->radii.z());
  } else if (const auto* mesh = std::get_if<Mesh>(&geometry)) {
    if (mesh->triangles == nullptr) checker.report("the mesh has no triangles");
  } else if (const auto* plane = std::get_if<Plane>(&geometry)) {
    checker.require(within(plane->normal, 1e6) && plane->normal.norm() > 1e-9, "the plane's normal",
                    text(plane->normal), "a direction");
    if (!model.is_static) checker.report("a plane is infinite and cannot move; make the model <static>true</static>");
  }
}

void check_material(Checker& checker, const Material& material) {
  checker.check_color("the diffuse colour", material.diffuse);
  checker.check_color("the emissive colour", material.emissive);
  checker.check_color("the checker's colour", material.checker_color);
  checker.require(material.checker_size >= 0 && within(material.checker_size, kMaxSize), "the checker's size",
                  text(material.checker_size) + " m", "0 (no checker) to 1e5 m");
}

void check_surface(Checker& checker, const Surface& surface) {
  struct Named {
    const char* name;
    double value;
    double most;
  };
  // Some files have infinite friction.
  checker.require(surface.mu >= 0, "the friction mu", text(surface.mu), "0 or more");
  checker.require(!surface.mu2 || *surface.mu2 >= 0, "the friction mu2", text(surface.mu2.value_or(0)), "0 or more");
  for (const Named& named :
       {Named{"the slip1", surface.slip1, 1e6}, Named{"the slip2", surface.slip2, 1e6},
        Named{"the torsional friction", surface.torsion, 1e6},
        Named{"the torsional friction by depth", surface.torsion_by_depth, 1e6},
        Named{"the rolling resistance", surface.rolling, 1e6}, Named{"the stiffness kp", surface.kp.value_or(0), 1e300},
        Named{"the damping kd", surface.kd.value_or(0), 1e300},
        Named{"the soft_cfm", surface.soft_cfm.value_or(0), 1e6},
        Named{"the max_vel", surface.max_vel.value_or(0), 1e300},
        Named{"the min_depth", surface.min_depth.value_or(0), kMaxSize},
        Named{"the bounce's threshold", surface.bounce_threshold, 1e300}}) {
    checker.require(named.value >= 0 && named.value <= named.most, named.name, text(named.value),
                    "0 or more, and at most " + text(named.most));
  }
  checker.require(surface.soft_erp.value_or(0) >= 0 && surface.soft_erp.value_or(0) <= 1, "the soft_erp",
                  text(surface.soft_erp.value_or(0)), "from 0 to 1");
  checker.require(surface.restitution >= 0 && surface.restitution <= 1, "the restitution coefficient",
                  text(surface.restitution), "from 0 to 1");
  checker.require(within(surface.fdir1, 1e6), "the friction direction fdir1", text(surface.fdir1), "a direction");
  checker.require(surface.max_contacts >= 0, "max_contacts", std::to_string(surface.max_contacts), "0 or more");
}

}  // namespace

void check_shapes(Checker& checker, const ModelDescription& model, const LinkDescription& link,
                  const std::string& path) {
  for (const CollisionDescription& collision : link.collisions) {
    checker.at(collision.source, path + "/" + collision.name);
    checker.check_pose(collision.pose);
    check_geometry(checker, model, collision.geometry);
    check_surface(checker, collision.surface);
  }
  for (const VisualDescription& visual : link.visuals) {
    checker.at(visual.source, path + "/" + visual.name);
    checker.check_pose(visual.pose);
    check_geometry(checker, model, visual.geometry);
    check_material(checker, visual.material);
    checker.require(visual.laser_retro >= 0 && within(visual.laser_retro, 1e6), "the laser retro",
                    text(visual.laser_retro), "0 or more");
  }
}

}  // namespace bubblesim
