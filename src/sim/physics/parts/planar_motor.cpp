// SPDX-License-Identifier: BSD-3-Clause
// Planar motion of whole models, as with omnidirectional wheels.
#include <cmath>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "check/checks.hpp"
#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

// m/s^2, the motor's force divided by the model's mass: twice the deceleration of a friction coefficient of 1.
constexpr double kMaxAcceleration = 20;
constexpr double kLever = 1;  // m, its torque divided by its force

}  // namespace

PlanarMotor make_planar_motor(const World::State& state, const PlacedModel& model) {
  dWorldID world = state.world.get();
  dBodyID body = state.link(model.frame.canonical_link).body.get();
  PlanarMotor motor{ode::JointHandle(dJointCreateLMotor(world, nullptr)),
                    ode::JointHandle(dJointCreateAMotor(world, nullptr))};
  dJointAttach(motor.linear.get(), body, nullptr);
  dJointSetLMotorNumAxes(motor.linear.get(), 2);
  dJointSetLMotorAxis(motor.linear.get(), 0, 0, 1, 0, 0);
  dJointSetLMotorAxis(motor.linear.get(), 1, 0, 0, 1, 0);
  dJointAttach(motor.angular.get(), body, nullptr);
  dJointSetAMotorNumAxes(motor.angular.get(), 1);
  dJointSetAMotorAxis(motor.angular.get(), 0, 0, 0, 0, 1);
  limit_planar_motor(motor, model);
  return motor;
}

void limit_planar_motor(const PlanarMotor& motor, const PlacedModel& model) {
  const double force = kMaxAcceleration * total_mass(model);
  dJointSetLMotorParam(motor.linear.get(), dParamFMax, force);
  dJointSetLMotorParam(motor.linear.get(), dParamFMax2, force);
  dJointSetAMotorParam(motor.angular.get(), dParamFMax, force * kLever);
}

void World::set_planar_velocity(ObjectId model, double x, double y, double turning) {
  const Object& object = state_->tree().at(model);
  if (object.kind != ObjectKind::kModel || object.parent != kNoObject) {
    throw WrongObject(state_->shown(model) + " is a " + std::string(kind_name(object.kind)) +
                      ": the planar velocity can be set for outermost models only");
  }
  PlacedModel& placed = state_->model_of(model);
  if (placed.description.is_static) throw WrongObject(state_->shown(model) + " is static: it cannot be moved");
  if (!within(x, kMaxSpeed) || !within(y, kMaxSpeed) || !within(turning, kMaxSpeed)) {
    throw InvalidInput(state_->shown(model) + ": the planar velocity must be finite and at most 1e6");
  }
  const Link& link = state_->link(placed.frame.canonical_link);
  dBodyID body = link.body.get();
  if (placed.planar_motor.linear == nullptr) {
    placed.planar_motor = make_planar_motor(*state_, placed);
  }
  // ODE's motor moves the centre of mass, which moves in a circle around the model's origin.
  const Vector3 arm = to_vector(dBodyGetPosition(body)) - pose(model).position;
  dJointSetLMotorParam(placed.planar_motor.linear.get(), dParamVel, x - turning * arm.y());
  dJointSetLMotorParam(placed.planar_motor.linear.get(), dParamVel2, y + turning * arm.x());
  dJointSetAMotorParam(placed.planar_motor.angular.get(), dParamVel, turning);
  dBodyEnable(body);
}

}  // namespace bubblesim
