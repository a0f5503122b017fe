// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/write_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "load/ttt/groups.hpp"
#include "load/ttt/script_files.hpp"
#include "load/ttt/write_joints.hpp"
#include "load/ttt/write_parts.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

namespace fs = std::filesystem;

/// Writes one group as a model.
class ModelWriter {
 public:
  ModelWriter(pugi::xml_node world, pugi::xml_node state, const Group& group, const std::map<int, std::string>& scripts,
              Conversion& conversion)
      : world_(world), state_(state), group_(group), scripts_(scripts), c_(conversion) {}

  void write() {
    const int leader = group_.leader(c_.structure);
    is_static_ = group_.bodies.empty();
    if (is_static_ && !is_worth_a_model(leader)) return;
    const std::string alias = plain_name(c_.object(leader).alias);
    const std::string name = c_.names.take(alias);
    model_ = named(world_, "model", name);
    model_pose_ = is_static_ || group_.fixed != kNone ? c_.node(leader).world : at_zero(group_.bodies.front());
    put_pose(model_, model_pose_);
    if (name != alias) put(model_, "bubblesim:alias", alias);
    if (is_static_) put(model_, "static", "true");
    name_links();
    write_script();
    if (group_.fixed != kNone) write_fixed_part();
    for (const int body : group_.bodies) write_body(body);
    write_joints();
    write_state(name);
    for (const auto& [object, path] : waiting_) {
      c_.left_out.add("second script of bodies that move as one: not run", c_.object(object).alias);
    }
  }

 private:
  const Body& body(int i) const { return c_.structure.bodies[static_cast<std::size_t>(i)]; }
  const Pose& in_file(int i) const { return c_.node(body(i).shape).world; }
  bool has_loops() const { return group_.at_zero.empty(); }
  const Pose& at_zero(int i) const { return has_loops() ? in_file(i) : group_.at_zero.at(i); }

  /// The editor's cameras and lights, and scripts, are no models; the lights are in the world.
  bool is_worth_a_model(int leader) const {
    if (group_.members.size() > 1) {
      return std::any_of(group_.members.begin(), group_.members.end(), [this](int i) { return is_thing(i); });
    }
    return is_thing(leader);
  }
  bool is_thing(int i) const {
    const Object& object = c_.object(i);
    return object.as<Lamp>() == nullptr && object.tag != "CMA" && object.tag != "SCT" && object.tag != "GRH";
  }

  void name_links() {
    // The model's own script comes first; those of other bodies get models inside it.
    for (const auto& [object, path] : scripts_) {
      const int of = c_.node(object).body;
      const bool is_here = of == kWorld ? std::count(group_.members.begin(), group_.members.end(), object) > 0
                                        : std::count(group_.bodies.begin(), group_.bodies.end(), of) > 0;
      if (is_here) waiting_.emplace(object, path);
    }
    const int leader = group_.leader(c_.structure);
    const int first_body = group_.fixed == kNone ? group_.bodies.front() : kWorld;
    own_script_ = waiting_.count(leader) > 0 ? leader : kNone;
    std::map<int, int> inner_scripts;  // object by body
    for (const auto& [object, path] : waiting_) {
      const int of = c_.node(object).body;
      if (object == own_script_) continue;
      if (of != first_body) {
        inner_scripts.emplace(of, object);
      } else if (own_script_ == kNone) {
        own_script_ = object;
      }
    }
    for (const int i : group_.bodies) {
      const std::string alias = plain_name(c_.object(body(i).shape).alias);
      std::string name = c_.names.take(alias);
      if (const auto script = inner_scripts.find(i); script != inner_scripts.end()) {
        inner_[i] = {name, script->second};
        name = c_.names.take(alias + "_link");
      }
      links_[i] = name;
    }
    if (group_.fixed != kNone) links_[kWorld] = c_.names.take(plain_name(c_.object(group_.fixed).alias) + "_link");
  }

  std::string scoped_link(int i) const {
    if (i == kWorld) return group_.fixed == kNone ? "world" : links_.at(kWorld);
    const auto inner = inner_.find(i);
    return inner == inner_.end() ? links_.at(i) : inner->second.first + "::" + links_.at(i);
  }

  void write_script() {
    if (own_script_ == kNone) return;
    put(model_, "bubblesim:child_script", waiting_.at(own_script_));
    waiting_.erase(own_script_);
  }

  /// What does not move, as a link of its own. It is fixed to the world, so that neighbours of joints pass it.
  void write_fixed_part() {
    const Pose& pose = c_.node(group_.fixed).world;
    pugi::xml_node link = named(model_, "link", links_.at(kWorld));
    put_pose(link, model_pose_.inverse() * pose);
    write_members(link, group_.members, pose, {is_static_, false});
    if (is_static_) return;
    pugi::xml_node joint = named(model_, "joint", c_.names.take(links_.at(kWorld) + "_held"));
    joint.append_attribute("type").set_value("fixed");
    put(joint, "parent", "world");
    put(joint, "child", links_.at(kWorld));
  }

  void write_body(int i) {
    pugi::xml_node parent = model_;
    Pose frame = model_pose_;
    const auto inner = inner_.find(i);
    if (inner != inner_.end()) {
      parent = named(model_, "model", inner->second.first);
      put_pose(parent, model_pose_.inverse() * at_zero(i));
      frame = at_zero(i);
      const auto script = waiting_.find(inner->second.second);
      put(parent, "bubblesim:child_script", script->second);
      waiting_.erase(script);
    }
    pugi::xml_node link = named(parent, "link", links_.at(i));
    put_pose(link, frame.inverse() * at_zero(i));
    const Object& object = c_.object(body(i).shape);
    const std::string alias = plain_name(object.alias);
    if (links_.at(i) != alias) put(link, "bubblesim:alias", alias);
    write_inertial(link, *object.as<Shape>());
    write_members(link, body(i).members, in_file(i), {false, is_wheel(i)});
  }

  bool is_wheel(int i) const {
    return std::any_of(group_.connections.begin(), group_.connections.end(), [&](int index) {
      const Connection& connection = c_.structure.connections[static_cast<std::size_t>(index)];
      const Joint* joint = c_.object(connection.object).as<Joint>();
      return connection.child == i && joint != nullptr && joint->type == JointType::kRevolute &&
             (joint->is_cyclic || joint->control == JointControl::kVelocity);
    });
  }

  static void write_inertial(pugi::xml_node link, const Shape& shape) {
    pugi::xml_node inertial = link.append_child("inertial");
    put(inertial, "mass", shape.mass);
    put_pose(inertial, Pose(shape.centre_of_mass, Quaternion()));
    pugi::xml_node inertia = inertial.append_child("inertia");
    const Matrix3 m = shape.mass * shape.inertia;
    put(inertia, "ixx", m(0, 0));
    put(inertia, "ixy", m(0, 1));
    put(inertia, "ixz", m(0, 2));
    put(inertia, "iyy", m(1, 1));
    put(inertia, "iyz", m(1, 2));
    put(inertia, "izz", m(2, 2));
  }

  void write_members(pugi::xml_node link, const std::vector<int>& members, const Pose& pose, const LinkKind& kind) {
    for (const int member : members) {
      if (c_.object(member).as<Shape>() != nullptr) write_shape(link, member, pose, kind, c_);
      write_sensor(link, member, pose, c_);
      // Lights that do not move are the world's.
      if (c_.object(member).as<Lamp>() != nullptr && c_.node(member).body != kWorld) write_lamp(link, member, pose, c_);
    }
  }

  void write_joints() {
    JointSite site;
    site.link = [this](int i) { return scoped_link(i); };
    site.has_loops = has_loops();
    for (const int i : group_.connections) {
      const Connection& connection = c_.structure.connections[static_cast<std::size_t>(i)];
      if (connection.kind == ConnectionKind::kWeld) continue;
      const Object& object = c_.object(connection.object);
      site.names.emplace(object.handle, c_.names.take(object.alias));
    }
    for (const int i : group_.connections) {
      write_joint(model_, c_.structure.connections[static_cast<std::size_t>(i)], site, c_);
    }
  }

  /// The positions of the joints in the file.
  void write_state(const std::string& name) {
    const bool moved = std::any_of(group_.bodies.begin(), group_.bodies.end(), [this](int i) {
      const Pose gap = at_zero(i).inverse() * in_file(i);
      return gap.position.norm() > 1e-9 || gap.orientation.vec().norm() > 1e-9;
    });
    if (!moved) return;
    pugi::xml_node model = named(state_, "model", name);
    for (const int i : group_.bodies) {
      const auto inner = inner_.find(i);
      pugi::xml_node parent = inner == inner_.end() ? model : named(model, "model", inner->second.first);
      put_pose(named(parent, "link", links_.at(i)), in_file(i));
    }
  }

  pugi::xml_node world_;
  pugi::xml_node state_;
  const Group& group_;
  const std::map<int, std::string>& scripts_;
  Conversion& c_;
  pugi::xml_node model_;
  Pose model_pose_;
  bool is_static_ = false;
  int own_script_ = kNone;
  std::map<int, std::string> waiting_;                // scripts that no model has yet
  std::map<int, std::string> links_;                  // names by body
  std::map<int, std::pair<std::string, int>> inner_;  // models inside this one, with the object of their script
};

/// Whole substeps in a step.
double substep_of(const Settings& settings) {
  const double count = std::max(1.0, std::round(settings.time_step / settings.engine_step));
  return settings.time_step / count;
}

void write_settings(pugi::xml_node world, const Settings& settings) {
  put(world, "bubblesim:axis_convention", "coppeliasim");
  put(world, "bubblesim:time_step", settings.time_step);
  put(world, "gravity", exact({settings.gravity.x(), settings.gravity.y(), settings.gravity.z()}));
  pugi::xml_node physics = named(world, "physics", "engine");
  physics.append_attribute("type").set_value("ode");
  put(physics, "max_step_size", substep_of(settings));
  pugi::xml_node scene = world.append_child("scene");
  put(scene, "ambient", color_text(settings.ambient));
  put(scene, "background", color_text(settings.background));
  put(scene, "shadows", "false");
}

void write_floor(pugi::xml_node world, Conversion& conversion) {
  pugi::xml_node model = named(world, "model", conversion.names.take("ground_plane"));
  put(model, "static", "true");
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

}  // namespace

std::vector<std::string> write_scene(const SceneFile& file, const std::string& name, const fs::path& folder) {
  const Structure structure = structure_of(file);
  Conversion conversion{file, structure, MeshFiles(folder, file), left_out_of(file, structure), UniqueNames()};
  pugi::xml_document document;
  pugi::xml_node sdf = document.append_child("sdf");
  sdf.append_attribute("version").set_value("1.9");
  sdf.append_attribute("xmlns:bubblesim").set_value("https://bubblesim");
  pugi::xml_node world = named(sdf, "world", plain_name(name));
  write_settings(world, file.settings);
  for (int i = 0; i < static_cast<int>(file.objects.size()); ++i) {
    const bool is_fixed_lamp = conversion.object(i).as<Lamp>() != nullptr && conversion.node(i).body == kWorld;
    if (is_fixed_lamp) write_lamp(world, i, Pose(), conversion);
  }
  const std::map<int, std::string> scripts = write_scripts(folder, conversion);
  if (!file.is_scene) write_floor(world, conversion);
  pugi::xml_node state = sdf.append_child("state");
  for (const Group& group : groups_of(file, structure)) {
    ModelWriter(world, state, group, scripts, conversion).write();
  }
  if (state.first_child()) {
    state.append_attribute("world_name").set_value(plain_name(name).c_str());
    world.append_move(state);
  } else {
    sdf.remove_child(state);
  }
  if (!document.save_file((folder / kSceneFile).c_str(), "  ")) {
    throw std::runtime_error("cannot write " + (folder / kSceneFile).string() + ": is the disk full?");
  }
  std::ofstream list(folder / kLeftOutFile);
  std::vector<std::string> lines = conversion.left_out.lines();
  for (const std::string& line : lines) list << line << "\n";
  if (!list.flush()) throw std::runtime_error("cannot write " + (folder / kLeftOutFile).string());
  return lines;
}

}  // namespace bubblesim::ttt
