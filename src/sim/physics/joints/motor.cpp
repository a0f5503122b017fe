// SPDX-License-Identifier: BSD-3-Clause
#include "physics/joints/motor.hpp"

#include <cmath>
#include <utility>

namespace bubblesim {

Motor Motor::turning(dWorldID world, const AxisLine& line) {
  ode::JointHandle joint(dJointCreateAMotor(world, nullptr));
  dJointSetAMotorNumAxes(joint.get(), 1);
  return between(line, std::move(joint), dJointSetAMotorAxis, dJointSetAMotorParam);
}

Motor Motor::sliding(dWorldID world, const AxisLine& line) {
  ode::JointHandle joint(dJointCreateLMotor(world, nullptr));
  dJointSetLMotorNumAxes(joint.get(), 1);
  return between(line, std::move(joint), dJointSetLMotorAxis, dJointSetLMotorParam);
}

Motor Motor::between(const AxisLine& line, ode::JointHandle joint, SetAxis set_axis, SetParameter set) {
  dJointAttach(joint.get(), line.first, line.second);
  set_axis(joint.get(), 0, line.carrier, line.direction.x(), line.direction.y(), line.direction.z());
  Motor motor(joint.get(), set, 0);
  motor.own_ = std::move(joint);
  return motor;
}

void Motor::turn(const Vector3& direction) const {
  if (own_ == nullptr) return;
  dJointSetAMotorAxis(joint_, 0, dJointGetAMotorAxisRel(joint_, 0), direction.x(), direction.y(), direction.z());
}

void Motor::hold(double velocity, double max_force) {
  aim(velocity);
  force_.max_force = std::isfinite(max_force) ? max_force : dInfinity;
  set(dParamFMax, force_.max_force);
}

void Motor::aim(double velocity) {
  force_.velocity = velocity;
  set(dParamVel, velocity);
}

void Motor::damp(double velocity, double coefficient) {
  hold(velocity, dInfinity);
  force_.softness = 1 / coefficient;
  set(dParamCFM, force_.softness);  // CFM f is the velocity error of a row with force f
}

}  // namespace bubblesim
