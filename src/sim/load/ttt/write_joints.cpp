// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/write_joints.hpp"

#include <cmath>

#include "bubblesim/scene.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {

bool is_left_over(const Joint& joint) {
  constexpr double kSlow = 1;    // rad/s
  constexpr double kSoon = 0.5;  // s
  const double speed = std::abs(joint.target_velocity);
  if (joint.control != JointControl::kVelocity || joint.type != JointType::kRevolute || joint.is_cyclic) return false;
  const double way = joint.target_velocity > 0 ? joint.upper - joint.position : joint.position - joint.lower;
  return speed > kSlow && way < kSoon * speed;
}

const char* type_of(const Joint& joint) {
  if (joint.type == JointType::kSpherical) return "ball";
  if (joint.type == JointType::kPrismatic) return "prismatic";
  if (joint.lead != 0) return "screw";
  return joint.is_cyclic ? "continuous" : "revolute";
}

namespace {

constexpr double kSameGain = 0.1;  // 1/s

const char* motor_of(const Joint& joint) {
  switch (joint.control) {
    case JointControl::kForce:
      return "effort";
    case JointControl::kVelocity:
      return "velocity";
    case JointControl::kPosition:
      return "position";
    case JointControl::kCallback:
      return "callback";
    default:
      return nullptr;
  }
}

void write_limits(pugi::xml_node axis, const Joint& joint, double zero) {
  pugi::xml_node limit = axis.append_child("limit");
  if (!joint.is_cyclic) {
    put(limit, "lower", joint.lower - zero);
    put(limit, "upper", joint.upper - zero);
  }
  if (motor_of(joint) == nullptr) return;
  put(limit, "effort", joint.max_force);
  const bool keeps_pace = joint.control == JointControl::kPosition || joint.control == JointControl::kCallback;
  if (keeps_pace && joint.max_velocity > 0) put(limit, "velocity", joint.max_velocity);
}

/// `zero`: the position of the file's joint that is 0 here.
void write_axis(pugi::xml_node element, const Joint& joint, double zero, const JointSite& site, double engine_step) {
  pugi::xml_node axis = element.append_child("axis");
  put(axis, "xyz", "0 0 1");
  write_limits(axis, joint, zero);
  if (joint.control == JointControl::kSpring) {
    pugi::xml_node dynamics = axis.append_child("dynamics");
    put(dynamics, "spring_stiffness", std::max(joint.spring_stiffness, 0.0));
    put(dynamics, "spring_reference", joint.target_position - zero);
    put(dynamics, "damping", std::max(joint.spring_damping, 0.0));
  }
  const auto leader = site.names.find(joint.leader);
  if (joint.is_dependent && leader != site.names.end() && !site.has_loops) {
    pugi::xml_node mimic = axis.append_child("mimic");
    mimic.append_attribute("joint").set_value(leader->second.c_str());
    put(mimic, "multiplier", joint.factor);
    put(mimic, "offset", joint.offset);
    return;
  }
  if (const char* motor = motor_of(joint)) put(axis, "bubblesim:motor", motor);
  if (joint.control == JointControl::kVelocity) {
    put(axis, "bubblesim:target", is_left_over(joint) ? 0 : joint.target_velocity);
  }
  if (joint.control == JointControl::kPosition || joint.control == JointControl::kCallback) {
    put(axis, "bubblesim:target", joint.target_position - zero);
  }
  // The engine moves a part P of the error in each of its steps.
  const double gain = joint.gains[0] / engine_step;
  if (joint.control == JointControl::kPosition && std::abs(gain - kPositionGain) > kSameGain) {
    put(axis, "bubblesim:position_gain", gain);
  }
}

}  // namespace

void write_joint(pugi::xml_node model, const Connection& connection, const JointSite& site, Conversion& conversion) {
  const Object& object = conversion.object(connection.object);
  const Node& node = conversion.node(connection.object);
  const Joint* joint = object.as<Joint>();
  const std::string alias = path_name(object.alias);
  const auto known = site.names.find(object.handle);
  const std::string name = connection.kind != ConnectionKind::kWeld && known != site.names.end()
                               ? known->second
                               : conversion.names.take(alias + "_weld");
  pugi::xml_node element = named(model, "joint", name);
  element.append_attribute("type").set_value(joint != nullptr ? type_of(*joint) : "fixed");
  put(element, "parent", site.link(connection.parent));
  put(element, "child", site.link(connection.child));
  // A joint is placed by its child, which is beyond the joint's position in the file.
  const Pose child_in_file =
      conversion.node(conversion.structure.bodies[static_cast<std::size_t>(connection.child)].shape).world;
  const bool at_zero = joint != nullptr && joint->type != JointType::kSpherical && !site.has_loops;
  put_pose(element, child_in_file.inverse() * (at_zero ? node.moving : node.world));
  if (connection.kind == ConnectionKind::kJoint) {
    if (name != alias) put(element, "bubblesim:alias", alias);
    write_place(element, connection.object, conversion);
  }
  if (joint != nullptr && joint->type != JointType::kSpherical) {
    if (joint->lead != 0 && joint->type == JointType::kRevolute) {
      put(element, "screw_thread_pitch", 2 * M_PI * joint->lead);
    }
    write_axis(element, *joint, site.has_loops ? joint->position : 0, site, conversion.file.settings.engine_step);
  }
  if (object.as<ForceSensor>() == nullptr) return;
  pugi::xml_node sensor = named(element, "sensor", conversion.names.take(alias + "_sensor"));
  sensor.append_attribute("type").set_value("force_torque");
  put(sensor, "bubblesim:alias", alias);
  write_place(sensor, connection.object, conversion);
}

}  // namespace bubblesim::ttt
