// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "load/ttt/read_objects.hpp"

namespace bubblesim::ttt {
namespace {

constexpr int kDependentMode = 4;
constexpr int kOldDependentMode = 3;
constexpr int kDynamicMode = 5;
constexpr double kLeastLead = 1e-6;  // m per rad; a screw with less turns on the spot
constexpr double kMostLead = 100;

/// `bits`: of the old item Va9, which has the mode of the motor where Dcm is missing.
JointControl control_of(const TagList& list, unsigned bits) {
  if (const auto mode = list.integer("Dcm")) {
    switch (*mode) {
      case 1:
        return JointControl::kForce;
      case 4:
        return JointControl::kVelocity;
      case 8:
      case 9:
        return JointControl::kPosition;
      case 12:
      case 13:
        return JointControl::kSpring;
      case 16:
        return JointControl::kCallback;
      default:
        return JointControl::kFree;
    }
  }
  if ((bits & 0x10U) == 0) return JointControl::kFree;
  if ((bits & 0x20U) == 0) return JointControl::kVelocity;
  return (bits & 0x80U) != 0 ? JointControl::kSpring : JointControl::kPosition;
}

void read_dependency(const TagList& list, Joint& joint) {
  const bool are_doubles = list.has("_dt");
  auto bytes = list.item(are_doubles ? "_dt" : "Jdt");
  if (!bytes) return;
  note_damage(list.damage(), [&] {
    const int leader = bytes->i32();
    const auto numbers = bytes->numbers(2, are_doubles);
    joint.leader = leader;
    joint.factor = numbers[0];
    joint.offset = numbers[1];
  });
}

/// P, I, D; those of the block of ODE stand behind its own five numbers.
void read_gains(const TagList& list, Joint& joint) {
  constexpr std::size_t kFirst = 5;
  std::vector<double> gains;
  if (const std::vector<double> block = list.block("OdN", "_dN"); block.size() >= kFirst + 3) {
    gains.assign(block.begin() + kFirst, block.begin() + kFirst + 3);
  }
  for (const char* tag : {"Dpc", "Dp2"}) {
    if (gains.empty()) gains = list.numbers(tag, "", 3);
  }
  if (!gains.empty()) joint.gains = {std::max(gains[0], 0.0), gains[1], gains[2]};
}

}  // namespace

Joint read_joint(const TagList& list) {
  Joint joint;
  const int type = list.integer("Jtt", 10);
  if (type < 10 || type > 12) fail_at(list.item("Jtt")->offset(), "the type of the joint is not known");
  joint.type = static_cast<JointType>(type);
  joint.position = list.number("Prt", "_rt").value_or(0);
  if (const auto range = list.numbers("Pmr", "_mr", 2); !range.empty()) {
    joint.lower = range[0];
    joint.upper = range[0] + std::max(range[1], 0.0);
  }
  const unsigned bits = list.u8("Va9").value_or(0);
  joint.is_cyclic = (bits & 1U) != 0 && joint.type == JointType::kRevolute;
  joint.lead = list.number("Jsp", "_sp").value_or(0);
  if (const auto per_turn = list.number("", "Sld")) joint.lead = *per_turn / (2 * M_PI);
  if (const double size = std::abs(joint.lead); size < kLeastLead || size > kMostLead) joint.lead = 0;
  joint.rotation = list.rotation("Jst", "_st").value_or(Quaternion());
  const int mode = list.integer("Jmd", 0);
  joint.is_dynamic = mode == kDynamicMode || (bits & 0x40U) != 0;
  joint.is_dependent = mode == kDependentMode || mode == kOldDependentMode;
  read_dependency(list, joint);
  joint.control = control_of(list, bits);
  if (const auto motor = list.numbers("Dmp", "_mp", 2); !motor.empty()) {
    joint.target_velocity = motor[0];
    joint.max_force = std::abs(motor[1]);
  }
  joint.target_position = list.number("Dtp", "_tp").value_or(0);
  if (const auto spring = list.numbers("Spp", "_pp", 2); !spring.empty()) {
    joint.spring_stiffness = spring[0];
    joint.spring_damping = spring[1];
  }
  read_gains(list, joint);
  if (const auto profile = list.numbers("Ruc", "_uc", 3); !profile.empty()) {
    joint.max_velocity = profile[0];
  } else {
    joint.max_velocity = list.number("Ulv", "").value_or(0);
  }
  return joint;
}

}  // namespace bubblesim::ttt
