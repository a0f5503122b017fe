// SPDX-License-Identifier: BSD-3-Clause
#include "contact_messages.hpp"

#include <numeric>

namespace bubblesim::reading_messages {
namespace {

std::string scoped(const World& world, ObjectId link, const std::string& collision) {
  const SceneTree& tree = world.tree();
  return tree.at(tree.model_of(link)).name + "::" + tree.at(link).name + "::" + collision;
}

/// Moves vectors from world axes to those of an object's frame; kNoObject: of the world.
class IntoFrame {
 public:
  IntoFrame(const World& world, ObjectId object) : is_world_(object == kNoObject) {
    if (is_world_) return;
    const Pose frame = world.pose(object);
    origin_ = frame.position;
    turn_ = frame.orientation.toRotationMatrix().transpose();
  }

  Vector3 turned(const Vector3& v) const {
    if (is_world_) return v;
    return turn_.col(0) * v.x() + turn_.col(1) * v.y() + turn_.col(2) * v.z();
  }
  Vector3 placed(const Vector3& position) const { return turned(position - origin_); }

 private:
  bool is_world_;
  Vector3 origin_ = Vector3::Zero();
  Matrix3 turn_;
};

void append(std::vector<double>& numbers, const Vector3& v) { numbers.insert(numbers.end(), v.data(), v.data() + 3); }

}  // namespace

std::vector<TouchReading> read_touches(const World& world, ObjectId link, const ContactReading& reading,
                                       ObjectId reference) {
  const IntoFrame frame(world, reference);
  std::vector<TouchReading> touches;
  for (const Contact& contact : reading.contacts) {
    TouchReading& touch = touches.emplace_back();
    touch.own = scoped(world, link, contact.collision);
    touch.other = scoped(world, contact.other_link, contact.other_collision);
    for (const ContactPoint& point : contact.points) {
      touch.forces.push_back(frame.turned(point.force));
      append(touch.positions, frame.placed(point.position));
      append(touch.normals, frame.turned(point.normal));
      touch.depths.push_back(point.depth);
    }
  }
  return touches;
}

void contacts_state(Fields& fields, const Header& header, const std::vector<TouchReading>& touches) {
  put(fields, header);
  fields.list("states", touches, [&](const TouchReading& touch) {
    fields.put("info", fields.keep(touch.own + " touches " + touch.other));
    fields.put("collision1_name", std::string_view(touch.own));
    fields.put("collision2_name", std::string_view(touch.other));
    fields.list("wrenches", touch.forces, [&](const Vector3& force) { put(fields, "force", force); });
    fields.message("total_wrench", [&] {
      const auto sum = std::accumulate(touch.forces.begin(), touch.forces.end(), Vector3(Vector3::Zero()));
      put(fields, "force", sum);
    });
    fields.array("contact_positions", touch.positions);
    fields.array("contact_normals", touch.normals);
    fields.array("depths", touch.depths);
  });
}

}  // namespace bubblesim::reading_messages
