// SPDX-License-Identifier: BSD-3-Clause
#include "physics/joints/motor.hpp"

#include <cmath>
#include <utility>

namespace bubblesim {

Motor Motor::turning(dWorldID world, const AxisLine& line) {
  ode::JointHandle joint(dJointCreateAMotor(world, nullptr));
  dJointSetAMotorNumAxes(joint.get(), 1);
  return between(line, std::move(joint), dJointSetAMotorAxis, dJointSetAMotorParam, dJointGetAMotorParam);
}

Motor Motor::sliding(dWorldID world, const AxisLine& line) {
  ode::JointHandle joint(dJointCreateLMotor(world, nullptr));
  dJointSetLMotorNumAxes(joint.get(), 1);
  return between(line, std::move(joint), dJointSetLMotorAxis, dJointSetLMotorParam, dJointGetLMotorParam);
}

Motor Motor::between(const AxisLine& line, ode::JointHandle joint, SetAxis set_axis, SetParameter set,
                     GetParameter get) {
  dJointAttach(joint.get(), line.first, line.second);
  set_axis(joint.get(), 0, line.carrier, line.direction.x(), line.direction.y(), line.direction.z());
  Motor motor(joint.get(), set, get, 0);
  motor.own_ = std::move(joint);
  return motor;
}

MotorForce Motor::force() const {
  const auto get = [&](int parameter) { return get_(joint_, group_ * dParamGroup + parameter); };
  return {get(dParamVel), get(dParamFMax), get(dParamCFM)};
}

void Motor::hold(double velocity, double max_force) const {
  set(dParamVel, velocity);
  set(dParamFMax, std::isfinite(max_force) ? max_force : dInfinity);
}

void Motor::damp(double velocity, double coefficient) const {
  hold(velocity, dInfinity);
  set(dParamCFM, 1 / coefficient);  // CFM f is the velocity error of a row with force f
}

}  // namespace bubblesim
