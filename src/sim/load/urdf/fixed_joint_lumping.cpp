// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/fixed_joint_lumping.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "scene/unit_steiner.hpp"

namespace bubblesim {
namespace {

/// Mass and inertia of bodies that nothing moves, which have none in the file.
UrdfInertial unit_inertial() { return {1, Vector3(), Matrix3::Identity()}; }

/// The inertial of a part in the frame of its body.
UrdfInertial moved(const UrdfInertial& inertial, const Pose& pose) {
  const Matrix3 turn = pose.orientation.toRotationMatrix();
  const bool is_turned = !turn.isIdentity(0);
  return {inertial.mass, pose * inertial.centre_of_mass,
          is_turned ? Matrix3(turn * inertial.inertia * turn.transpose()) : inertial.inertia};
}

/// The inertial of parts that are given in one frame.
UrdfInertial combined(const std::vector<UrdfInertial>& parts) {
  if (parts.size() == 1) return parts.front();  // without rounding
  UrdfInertial whole;
  for (const UrdfInertial& part : parts) {
    whole.mass += part.mass;
    whole.centre_of_mass += part.mass * part.centre_of_mass;
  }
  whole.centre_of_mass = whole.mass > 0 ? Vector3(whole.centre_of_mass / whole.mass) : parts.front().centre_of_mass;
  for (const UrdfInertial& part : parts) {
    whole.inertia += part.inertia + part.mass * unit_steiner(part.centre_of_mass - whole.centre_of_mass);
  }
  return whole;
}

class Lumping {
 public:
  Lumping(const UrdfRobot& robot, const std::set<std::string>& kept, LoadContext& context)
      : robot_(robot), kept_(kept), context_(context) {
    for (const UrdfLink& link : robot.links) links_.emplace(link.name, &link);
    for (const UrdfJoint& joint : robot.joints) below_[joint.parent].push_back(&joint);
    const auto by_name = [](const UrdfJoint* a, const UrdfJoint* b) { return a->name < b->name; };
    for (auto& [parent, joints] : below_) std::sort(joints.begin(), joints.end(), by_name);
  }

  std::vector<LumpedLink> lump() {
    collect();
    for (LumpedLink& link : lumped_) link.inertial = inertial_of(link);
    hold_root();
    leave_out();
    return std::move(lumped_);
  }

 private:
  /// A link that is still to be visited.
  struct Visit {
    const UrdfLink* link = nullptr;    // null: the world
    const UrdfJoint* joint = nullptr;  // that leads to it
    std::optional<std::size_t> body;   // that the joint starts from
    Pose pose;                         // of the parent link in that body
  };

  // Visits parents before children, and children in their order. Without recursion: chains may be long.
  void collect() {
    std::vector<Visit> open;
    std::set<std::string> children;
    for (const UrdfJoint& joint : robot_.joints) children.insert(joint.child);
    if (children.count(kUrdfWorld) == 0) open.push_back({});
    for (const UrdfLink& link : robot_.links) {
      if (link.name != kUrdfWorld && children.count(link.name) == 0) open.push_back({&link, nullptr, {}, {}});
    }
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const Visit from = placed(visit);
      const auto found = below_.find(from.link != nullptr ? from.link->name : kUrdfWorld);
      if (found == below_.end()) continue;
      for (auto joint = found->second.rbegin(); joint != found->second.rend(); ++joint) {
        open.push_back({links_.at((*joint)->child), *joint, from.body, from.pose});
      }
    }
  }

  /// Adds the link to its body, or makes a new one. Returns the place that its own joints start from.
  Visit placed(const Visit& visit) {
    if (visit.link == nullptr) return visit;
    if (visit.link->name == kUrdfWorld) {
      context_.warn(visit.joint->place.source(), "/" + robot_.name + "/" + visit.joint->name,
                    "is ignored: the world cannot be the child of a joint; make it the parent");
      return {};
    }
    const Pose offset = visit.joint != nullptr ? visit.pose * visit.joint->pose : Pose();
    if (visit.body && is_lumped(*visit.joint)) {
      lumped_[*visit.body].parts.push_back({visit.link, offset, visit.joint});
      return {visit.link, visit.joint, visit.body, offset};
    }
    LumpedLink body;
    body.parts.push_back({visit.link, Pose(), nullptr});
    body.pose = visit.body ? lumped_[*visit.body].pose * offset : offset;
    body.joint = visit.joint;
    if (visit.joint != nullptr) body.parent = visit.body ? lumped_[*visit.body].link().name : kUrdfWorld;
    lumped_.push_back(std::move(body));
    return {visit.link, visit.joint, lumped_.size() - 1, Pose()};
  }

  bool is_lumped(const UrdfJoint& joint) const {
    if (joint.type != "fixed") return false;
    const bool is_place = !links_.at(joint.parent)->inertial.has_mass() || !links_.at(joint.child)->inertial.has_mass();
    return is_place || kept_.count(joint.name) == 0;
  }

  static UrdfInertial inertial_of(const LumpedLink& link) {
    std::vector<UrdfInertial> parts;
    for (const LumpedPart& part : link.parts) parts.push_back(moved(part.link->inertial, part.pose));
    return combined(parts);
  }

  /// A root without mass cannot be moved by anything: it is fixed to the world.
  void hold_root() {
    for (LumpedLink& body : lumped_) {
      if (body.inertial.has_mass()) continue;
      const bool is_at_world = body.parent == kUrdfWorld && body.joint->type == "fixed";
      if (body.joint != nullptr && !is_at_world) continue;
      body.inertial = unit_inertial();
      if (is_at_world) continue;
      body.is_held = true;
      context_.warn(body.link().place.source(), "/" + robot_.name + "/" + body.link().name,
                    "has no mass: it is fixed to the world; add an <inertial> if it shall move");
    }
  }

  void leave_out() {
    std::set<std::string> left_out;
    const auto leaves = [&](const LumpedLink& body) {
      const std::string& name = body.link().name;
      if (left_out.count(body.parent) > 0) {
        left_out.insert(name);
        return true;
      }
      if (body.inertial.has_mass()) return false;
      left_out.insert(name);
      context_.warn(body.joint->place.source(), "/" + robot_.name + "/" + body.joint->name,
                    "is ignored with all links below it: '" + name + "' has no mass; add an <inertial>");
      return true;
    };
    // Parents come before their children.
    std::vector<LumpedLink> kept;
    for (LumpedLink& body : lumped_) {
      if (!leaves(body)) kept.push_back(std::move(body));
    }
    lumped_ = std::move(kept);
  }

  const UrdfRobot& robot_;
  const std::set<std::string>& kept_;
  LoadContext& context_;
  std::map<std::string, const UrdfLink*> links_;
  std::map<std::string, std::vector<const UrdfJoint*>> below_;  // by parent
  std::vector<LumpedLink> lumped_;
};

}  // namespace

std::vector<LumpedLink> lump_fixed_joints(const UrdfRobot& robot, const std::set<std::string>& kept,
                                          LoadContext& context) {
  return Lumping(robot, kept, context).lump();
}

}  // namespace bubblesim
