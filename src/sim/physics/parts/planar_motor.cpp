// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/planar_motor.hpp"

namespace bubblesim {
namespace {

// m/s^2, the motor's force divided by the model's mass: twice the deceleration of a friction coefficient of 1.
constexpr double kMaxAcceleration = 20;
constexpr double kLever = 1;  // m, its torque divided by its force

}  // namespace

PlanarMotor::PlanarMotor(dWorldID world, dBodyID body)
    : linear_(dJointCreateLMotor(world, nullptr)), angular_(dJointCreateAMotor(world, nullptr)) {
  dJointAttach(linear_.get(), body, nullptr);
  dJointSetLMotorNumAxes(linear_.get(), 2);
  dJointSetLMotorAxis(linear_.get(), 0, 0, 1, 0, 0);
  dJointSetLMotorAxis(linear_.get(), 1, 0, 0, 1, 0);
  dJointAttach(angular_.get(), body, nullptr);
  dJointSetAMotorNumAxes(angular_.get(), 1);
  dJointSetAMotorAxis(angular_.get(), 0, 0, 0, 0, 1);
}

void PlanarMotor::limit(double model_mass) {
  const double force = kMaxAcceleration * model_mass;
  dJointSetLMotorParam(linear_.get(), dParamFMax, force);
  dJointSetLMotorParam(linear_.get(), dParamFMax2, force);
  dJointSetAMotorParam(angular_.get(), dParamFMax, force * kLever);
}

void PlanarMotor::set_velocity(const std::array<double, 3>& velocity) {
  dJointSetLMotorParam(linear_.get(), dParamVel, velocity[0]);
  dJointSetLMotorParam(linear_.get(), dParamVel2, velocity[1]);
  dJointSetAMotorParam(angular_.get(), dParamVel, velocity[2]);
}

std::array<double, 3> PlanarMotor::velocity() const {
  return {dJointGetLMotorParam(linear_.get(), dParamVel), dJointGetLMotorParam(linear_.get(), dParamVel2),
          dJointGetAMotorParam(angular_.get(), dParamVel)};
}

std::array<double, 3> PlanarMotor::most() const {
  return {dJointGetLMotorParam(linear_.get(), dParamFMax), dJointGetLMotorParam(linear_.get(), dParamFMax2),
          dJointGetAMotorParam(angular_.get(), dParamFMax)};
}

}  // namespace bubblesim
