// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/write_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "files/file_text.hpp"
#include "load/ttt/groups.hpp"
#include "load/ttt/script_files.hpp"
#include "load/ttt/write_joints.hpp"
#include "load/ttt/write_parts.hpp"
#include "load/ttt/write_surroundings.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

namespace fs = std::filesystem;

/// Writes one group as a model.
class ModelWriter {
 public:
  ModelWriter(pugi::xml_node world, pugi::xml_node state, const Group& group, Conversion& conversion)
      : world_(world), state_(state), group_(group), c_(conversion) {}

  void write() {
    const int leader = group_.leader(c_.structure);
    is_static_ = group_.bodies.empty();
    if (is_static_ && !has_physics()) return;
    const std::string name = add_model(leader);
    model_pose_ = is_static_ || group_.fixed != kNone ? c_.node(leader).world : at_zero(group_.bodies.front());
    put_pose(model_, model_pose_);
    if (is_static_) put(model_, "static", "true");
    if (group_.bodies.size() > 1) put(model_, "self_collide", "true");
    for (const int i : group_.bodies) links_[i] = c_.names.take(c_.object(body(i).shape).alias);
    if (group_.fixed != kNone) {
      links_[kWorld] = c_.names.take(c_.object(group_.fixed).alias);
      write_fixed_part();
    }
    for (const int i : group_.bodies) write_body(i);
    write_joints();
    write_state(name);
    if (is_static_) write_loose();
    if (group_.fixed != kNone) write_frames(group_.members, links_.at(kWorld), c_.node(group_.fixed).world);
    for (const int i : group_.bodies) write_frames(body(i).members, links_.at(i), in_file(i));
    if (is_static_ || loose_.empty()) return;
    // A model of its own: they have no part in the physics of this one.
    add_model(leader);
    model_pose_ = Pose();
    put(model_, "static", "true");
    write_loose();
  }

 private:
  /// A shape that scripts may move on its own.
  struct Loose {
    int object = kNone;
    std::string carrier;  // the link with which it moves; empty: it stays
  };

  /// Returns its name.
  std::string add_model(int leader) {
    const std::string name = c_.names.take(c_.object(leader).alias + "_model");
    model_ = named(world_, "model", name);
    // In the tree are the objects of the file, not what moves together.
    put(model_, "bubblesim:is_object", "false");
    return name;
  }

  const Body& body(int i) const { return c_.structure.bodies[static_cast<std::size_t>(i)]; }
  const Pose& in_file(int i) const { return c_.node(body(i).shape).world; }
  bool has_loops() const { return group_.at_zero.empty(); }
  const Pose& at_zero(int i) const { return has_loops() ? in_file(i) : group_.at_zero.at(i); }

  /// Whether something of a tree that does not move is seen, felt or measures.
  bool has_physics() const {
    return std::any_of(group_.members.begin(), group_.members.end(), [this](int i) {
      const Object& object = c_.object(i);
      return object.as<Shape>() != nullptr || object.as<ProximitySensor>() != nullptr ||
             object.as<VisionSensor>() != nullptr;
    });
  }

  std::string link_name(int i) const { return i == kWorld && group_.fixed == kNone ? "world" : links_.at(i); }

  pugi::xml_node write_link(int i, int object) {
    pugi::xml_node link = named(model_, "link", links_.at(i));
    const std::string alias = path_name(c_.object(object).alias);
    if (links_.at(i) != alias) put(link, "bubblesim:alias", alias);
    if (c_.object(object).as<Shape>() != nullptr) write_place(link, object, c_);
    c_.links[object] = links_.at(i);
    return link;
  }

  /// Each as a link of a static model.
  void write_loose() {
    for (const auto& [object, carrier] : loose_) {
      const std::string alias = path_name(c_.object(object).alias);
      const std::string name = c_.names.take(alias);
      pugi::xml_node link = named(model_, "link", name);
      if (name != alias) put(link, "bubblesim:alias", alias);
      if (!carrier.empty()) put(link, "bubblesim:carrier", carrier);
      const Pose& pose = c_.node(object).world;
      put_pose(link, model_pose_.inverse() * pose);
      write_shape(link, object, pose, {true, false}, c_);
      write_place(link, object, c_);
      c_.links[object] = name;
    }
  }

  /// What does not move, as a link of its own. It is fixed to the world, so that neighbours of joints pass it.
  void write_fixed_part() {
    const Pose& pose = c_.node(group_.fixed).world;
    pugi::xml_node link = write_link(kWorld, group_.fixed);
    put_pose(link, model_pose_.inverse() * pose);
    write_members(link, kWorld, group_.members, pose, {is_static_, false});
    if (is_static_) return;
    pugi::xml_node joint = named(model_, "joint", c_.names.take(links_.at(kWorld) + "_held"));
    joint.append_attribute("type").set_value("fixed");
    put(joint, "parent", "world");
    put(joint, "child", links_.at(kWorld));
  }

  void write_body(int i) {
    pugi::xml_node link = write_link(i, body(i).shape);
    put_pose(link, model_pose_.inverse() * at_zero(i));
    write_inertial(link, *c_.object(body(i).shape).as<Shape>());
    // Links of joints would be slowed each for itself: a rope of 70 thrashed.
    if (group_.connections.empty()) write_damping(link, *c_.object(body(i).shape).as<Shape>(), c_.file.settings);
    write_members(link, i, body(i).members, in_file(i), {false, is_wheel(i)});
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

  /// Whether scripts can move a shape on its own: what does not move has a link for each. Of what a body carries, it is
  /// beyond a joint, or a script names it, and it collides with nothing: a mark to be dragged.
  bool is_loose(int i) const {
    if (is_static_) return i != group_.fixed;
    if (c_.node(i).is_on_joint) return true;
    const Node& node = c_.node(i);
    const bool makes_body = node.body != kWorld && body(node.body).shape == i;
    const bool is_fixed = node.body == kWorld && i == group_.fixed;
    return !makes_body && !is_fixed && !c_.object(i).as<Shape>()->is_respondable && is_named(i);
  }

  bool is_named(int i) const {
    const std::string& alias = c_.object(i).alias;
    const auto names = [&alias](const Script& script) { return script.text.find(alias) != std::string::npos; };
    const std::vector<Script>& scripts = c_.file.scripts;
    return !alias.empty() && std::any_of(scripts.begin(), scripts.end(), names);
  }

  void write_members(pugi::xml_node link, int of_body, const std::vector<int>& members, const Pose& pose,
                     const LinkKind& kind) {
    for (const int member : members) {
      if (c_.object(member).as<Shape>() != nullptr) {
        if (is_loose(member)) {
          loose_.push_back({member, of_body == kWorld ? "" : links_.at(of_body)});
          continue;
        }
        write_shape(link, member, pose, kind, c_);
        c_.links[member] = links_.at(of_body);
      }
      write_sensor(link, member, pose, c_);
      // Lights that do not move are the world's.
      if (c_.object(member).as<Lamp>() != nullptr && c_.node(member).body != kWorld) write_lamp(link, member, pose, c_);
    }
  }

  /// The members that are nothing else.
  void write_frames(const std::vector<int>& members, const std::string& link, const Pose& link_pose) {
    for (const int i : members) {
      const bool is_loose_shape = c_.object(i).as<Shape>() != nullptr && is_loose(i);
      if (c_.placed.count(i) == 0 && !is_loose_shape) write_frame(model_, i, link, link_pose, c_);
    }
  }

  void write_joints() {
    JointSite site;
    site.link = [this](int i) { return link_name(i); };
    site.has_loops = has_loops();
    for (const int i : group_.connections) {
      const Connection& connection = c_.structure.connections[static_cast<std::size_t>(i)];
      if (connection.kind == ConnectionKind::kWeld) continue;
      const Object& object = c_.object(connection.object);
      if (object.as<Joint>() == nullptr) c_.joints[connection.object] = c_.names.take(object.alias);
      site.names.emplace(object.handle, c_.joints.at(connection.object));
    }
    for (const int i : group_.connections) {
      write_joint(model_, c_.structure.connections[static_cast<std::size_t>(i)], site, c_);
    }
  }

  /// The positions of the joints in the file, and what moves at the start.
  void write_state(const std::string& name) {
    const bool moved = std::any_of(group_.bodies.begin(), group_.bodies.end(), [this](int i) {
      const Pose gap = at_zero(i).inverse() * in_file(i);
      return gap.position.norm() > 1e-9 || gap.orientation.vec().norm() > 1e-9 || has_velocity(i);
    });
    if (!moved) return;
    pugi::xml_node model = named(state_, "model", name);
    for (const int i : group_.bodies) {
      pugi::xml_node link = named(model, "link", links_.at(i));
      put_pose(link, in_file(i));
      if (!has_velocity(i)) continue;
      // SDFormat's is that of the link's origin.
      const Shape& moving = shape(i);
      const Vector3& turn = moving.angular_velocity;
      const Vector3 v = moving.velocity - turn.cross(in_file(i).orientation * moving.centre_of_mass);
      put(link, "velocity", exact({v.x(), v.y(), v.z(), turn.x(), turn.y(), turn.z()}));
    }
  }

  const Shape& shape(int i) const { return *c_.object(body(i).shape).as<Shape>(); }
  bool has_velocity(int i) const { return shape(i).velocity.norm() > 0 || shape(i).angular_velocity.norm() > 0; }

  pugi::xml_node world_;
  pugi::xml_node state_;
  const Group& group_;
  Conversion& c_;
  pugi::xml_node model_;
  Pose model_pose_;
  bool is_static_ = false;
  std::map<int, std::string> links_;  // names by body
  std::vector<Loose> loose_;
};

}  // namespace

std::vector<std::string> write_scene(const SceneFile& file, const std::string& name, const fs::path& folder) {
  const Structure structure = structure_of(file);
  Conversion conversion{file, structure, MeshFiles(folder, file), left_out_of(file, structure), UniqueNames()};
  conversion.names.take(kFloor);
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
  conversion.scripts = write_scripts(folder, conversion);
  for (int i = 0; i < static_cast<int>(file.objects.size()); ++i) {
    const Object& object = conversion.object(i);
    if (object.as<Joint>() != nullptr) conversion.joints[i] = conversion.names.take(object.alias);
  }
  if (!file.is_scene) write_floor(world, file, structure);
  pugi::xml_node state = sdf.append_child("state");
  for (const Group& group : groups_of(file, structure)) {
    ModelWriter(world, state, group, conversion).write();
  }
  for (int i = 0; i < static_cast<int>(file.objects.size()); ++i) {
    if (conversion.placed.count(i) == 0) write_frame(world, i, "", Pose(), conversion);
  }
  write_entities(conversion);
  write_collections(world, file);
  if (state.first_child()) {
    state.append_attribute("world_name").set_value(plain_name(name).c_str());
    world.append_move(state);
  } else {
    sdf.remove_child(state);
  }
  if (!document.save_file((folder / kSceneFile).c_str(), "  ")) {
    throw std::runtime_error("cannot write " + (folder / kSceneFile).string() + ": is the disk full?");
  }
  std::vector<std::string> lines = conversion.left_out.lines();
  std::string list;
  for (const std::string& line : lines) list += line + "\n";
  write_file(folder / kLeftOutFile, list);
  return lines;
}

}  // namespace bubblesim::ttt
