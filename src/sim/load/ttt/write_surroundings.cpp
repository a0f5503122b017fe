// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/write_surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "load/ttt/write_scene.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

/// Whole substeps in a step.
double substep_of(const Settings& settings) {
  const double count = std::max(1.0, std::round(settings.time_step / settings.engine_step));
  return settings.time_step / count;
}

/// Of a box of that size.
double lowest_corner(const Pose& frame, const Vector3& size) {
  const Matrix3 turn = frame.orientation.toRotationMatrix();
  double below = 0;
  for (int i = 0; i < 3; ++i) below += std::abs(turn(2, i) * size[i]) / 2;
  return frame.position.z() - below;
}

/// The lowest point of a model that collides, m, if it is clearly below 0: it would begin inside a floor there.
double lowest_of(const SceneFile& file, const Structure& structure) {
  double lowest = 0;
  for (std::size_t i = 0; i < file.objects.size(); ++i) {
    const Shape* shape = file.objects[i].as<Shape>();
    if (shape == nullptr || !shape->is_respondable) continue;
    for (const Part& part : shape->parts) {
      const Pose frame = structure.nodes[i].world * part.frame;
      for (const auto& v : *part.vertices) lowest = std::min(lowest, (frame * Vector3(v[0], v[1], v[2])).z());
      if (part.vertices->empty()) lowest = std::min(lowest, lowest_corner(frame, part.size));
    }
  }
  constexpr double kTouching = 1e-3;
  return lowest < -kTouching ? lowest : 0;
}

}  // namespace

void write_settings(pugi::xml_node world, const Settings& settings) {
  put(world, "bubblesim:axis_convention", "coppeliasim");
  put(world, "bubblesim:time_step", settings.time_step);
  put(world, "gravity", exact({settings.gravity.x(), settings.gravity.y(), settings.gravity.z()}));
  pugi::xml_node physics = named(world, "physics", "engine");
  physics.append_attribute("type").set_value("ode");
  put(physics, "max_step_size", substep_of(settings));
  put(physics, "bubblesim:substeps", "auto");  // ropes of many links need shorter ones
  pugi::xml_node scene = world.append_child("scene");
  put(scene, "ambient", color_text(settings.ambient));
  put(scene, "background", color_text(settings.background));
  put(scene, "shadows", "false");
}

void write_floor(pugi::xml_node world, const SceneFile& file, const Structure& structure) {
  const double height = lowest_of(file, structure);
  pugi::xml_node model = named(world, "model", kFloor);
  put(model, "static", "true");
  if (height != 0) put_pose(model, Pose(Vector3(0, 0, height), Quaternion()));
  pugi::xml_node link = named(model, "link", "link");
  for (const char* part : {"collision", "visual"}) {
    pugi::xml_node element = named(link, part, part);
    pugi::xml_node plane = element.append_child("geometry").append_child("plane");
    put(plane, "normal", "0 0 1");
    put(plane, "size", "10 10");
    if (std::string(part) == "collision") {
      put(element.append_child("surface").append_child("contact"), "collide_bitmask", "65535");
    }
  }
}

}  // namespace bubblesim::ttt
