// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/structure.hpp"

#include <algorithm>
#include <utility>

namespace bubblesim::ttt {
namespace {

constexpr unsigned kNotDynamic = 0x20;
constexpr unsigned kNotVisible = 0x100;
constexpr unsigned kNoModel = 0xf000;
constexpr int kClosedLoop = 0;

class Builder {
 public:
  explicit Builder(const SceneFile& file) : file_(file) {}

  Structure build() {
    built_.nodes.resize(file_.objects.size());
    for (int i = 0; i < count(); ++i) built_.places.emplace(object(i).handle, i);
    find_parents();
    for (const int root : built_.roots) walk(root);
    for (int i = 0; i < count(); ++i) connect(i);
    return std::move(built_);
  }

 private:
  int count() const { return static_cast<int>(file_.objects.size()); }
  const Object& object(int i) const { return file_.objects[static_cast<std::size_t>(i)]; }
  Node& node(int i) { return built_.nodes[static_cast<std::size_t>(i)]; }
  void find_parents() {
    for (int i = 0; i < count(); ++i) node(i).parent = built_.place(object(i).parent);
    std::vector<int> state(file_.objects.size(), 0);  // 1: on the way up from the current object, 2: leads to the top
    for (int i = 0; i < count(); ++i) {
      std::vector<int> way;
      int up = i;
      for (; up != kNone && state[static_cast<std::size_t>(up)] == 0; up = node(up).parent) {
        state[static_cast<std::size_t>(up)] = 1;
        way.push_back(up);
      }
      if (up != kNone && state[static_cast<std::size_t>(up)] == 1) node(up).parent = kNone;  // they went in a circle
      for (const int passed : way) state[static_cast<std::size_t>(passed)] = 2;
    }
    for (int i = 0; i < count(); ++i) siblings(node(i).parent).push_back(i);
    sort(built_.roots);
    for (Node& parent : built_.nodes) sort(parent.children);
  }

  std::vector<int>& siblings(int parent) { return parent == kNone ? built_.roots : node(parent).children; }

  void sort(std::vector<int>& siblings) const {
    std::stable_sort(siblings.begin(), siblings.end(),
                     [this](int a, int b) { return object(a).order < object(b).order; });
  }

  /// From the top down: poses, flags and bodies. A tree may be as deep as the file has objects.
  void walk(int root) {
    std::vector<int> open{root};
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      place_one(i);
      const std::vector<int>& children = node(i).children;
      open.insert(open.end(), children.rbegin(), children.rend());
    }
  }

  void place_one(int i) {
    Node& self = node(i);
    const Object& described = object(i);
    const Node* parent = self.parent == kNone ? nullptr : &node(self.parent);
    self.world = (parent == nullptr ? Pose() : parent->moving) * described.pose;
    self.world.orientation.normalize();
    const Joint* joint = described.as<Joint>();
    self.moving = joint == nullptr ? self.world : self.world * motion_of(*joint);
    self.model_flags = parent == nullptr ? 0 : parent->model_flags;
    if ((described.model_flags & kNoModel) != kNoModel && described.is_model) self.model_flags |= described.model_flags;
    self.is_visible = (described.layers & file_.settings.active_layers) != 0 && (self.model_flags & kNotVisible) == 0;
    const Shape* shape = described.as<Shape>();
    const bool is_body = shape != nullptr && !shape->is_static && (self.model_flags & kNotDynamic) == 0 &&
                         file_.settings.is_dynamics_enabled;
    if (is_body) {
      self.body = static_cast<int>(built_.bodies.size());
      built_.bodies.emplace_back().shape = i;
    } else {
      self.body = parent == nullptr ? kWorld : parent->body;
    }
    if (self.body != kWorld) built_.bodies[static_cast<std::size_t>(self.body)].members.push_back(i);
  }

  bool is_shape(int i) const { return object(i).as<Shape>() != nullptr; }
  bool makes_body(int i) {
    return node(i).body != kWorld && built_.bodies[static_cast<std::size_t>(node(i).body)].shape == i;
  }

  /// The only child that is a body; none if there are several.
  int only_body_below(int i) {
    int found = kNone;
    for (const int child : node(i).children) {
      if (!makes_body(child)) continue;
      if (found != kNone) return kNone;
      found = child;
    }
    return found;
  }

  void connect(int i) {
    const Object& described = object(i);
    if (described.as<Dummy>() != nullptr) {
      close_loop(i);
      return;
    }
    const Joint* joint = described.as<Joint>();
    const bool connects = described.as<ForceSensor>() != nullptr || (joint != nullptr && joint->is_dynamic);
    const int parent = node(i).parent;
    if (!connects || (parent != kNone && !is_shape(parent))) return;
    const int child = only_body_below(i);
    if (child == kNone) return;
    add({joint != nullptr ? ConnectionKind::kJoint : ConnectionKind::kRigid, i, node(i).body, node(child).body});
  }

  /// The joint in dynamic mode whose only child is a dummy.
  int joint_of(int dummy) {
    const int parent = node(dummy).parent;
    if (parent == kNone || node(parent).children.size() != 1) return kNone;
    const Joint* joint = object(parent).as<Joint>();
    return joint != nullptr && joint->is_dynamic ? parent : kNone;
  }

  void close_loop(int i) {
    const Dummy& dummy = *object(i).as<Dummy>();
    const int partner = built_.place(dummy.linked);
    if (partner == kNone || dummy.link_kind != kClosedLoop || object(partner).as<Dummy>() == nullptr) return;
    if (const int joint = joint_of(i); joint != kNone) {
      add({ConnectionKind::kJoint, joint, node(joint).body, node(partner).body});
      return;
    }
    if (joint_of(partner) != kNone) return;  // it connects the two itself
    const bool is_second = object(partner).as<Dummy>()->linked == object(i).handle && partner < i;
    if (!is_second) add({ConnectionKind::kWeld, i, node(i).body, node(partner).body});
  }

  /// The world is never the child.
  void add(Connection connection) {
    if (connection.parent == connection.child) return;
    if (connection.child == kWorld) {
      if (connection.kind == ConnectionKind::kJoint) return;  // its axis would turn the other way
      std::swap(connection.parent, connection.child);
    }
    built_.connections.push_back(connection);
  }

  const SceneFile& file_;
  Structure built_;
};

}  // namespace

Pose motion_of(const Joint& joint) {
  const Quaternion turn(Eigen::AngleAxisd(joint.position, Eigen::Vector3d::UnitZ()));
  switch (joint.type) {
    case JointType::kRevolute:
      return {Vector3(0, 0, joint.lead * joint.position), turn};
    case JointType::kPrismatic:
      return {Vector3(0, 0, joint.position), Quaternion()};
    case JointType::kSpherical:
      return {Vector3(), joint.rotation};
  }
  return {};
}

Structure structure_of(const SceneFile& file) { return Builder(file).build(); }

}  // namespace bubblesim::ttt
