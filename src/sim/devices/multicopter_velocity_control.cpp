// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/multicopter_velocity_control.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

/// The axes of a frame in the world.
struct Axes {
  Vector3 x, y, z;
};

Axes axes_of(const Quaternion& turn) {
  return {turn * Vector3::UnitX(), turn * Vector3::UnitY(), turn * Vector3::UnitZ()};
}

double mass_of_model(const World& world, ObjectId link) {
  double mass = 0;
  for (const LinkDescription& each : world.models().description(link).links) mass += each.mass;
  return mass;
}

/// The pseudo-inverse of the map from squared speeds to torques about the link's axes at the centre of mass of its
/// model, and to the thrust.
std::vector<double> mixing_of(const World& world, ObjectId link, const std::vector<std::shared_ptr<Rotor>>& rotors) {
  Eigen::Matrix<double, 4, Eigen::Dynamic> effect(4, static_cast<Eigen::Index>(rotors.size()));
  const Pose frame(motion_of(world, link).centre, world.pose(link).orientation);
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    const RotorDescription& rotor = rotors[i]->description();
    const Vector3 place = (frame.inverse() * world.joints().child_pose(rotor.joint)).position;
    const double turning = rotor.clockwise ? -1 : 1;
    effect.col(static_cast<Eigen::Index>(i)) =
        Eigen::Vector4d(place.y(), -place.x(), -turning * rotor.torque_length, 1) * rotor.thrust_coefficient;
  }
  Eigen::FullPivLU<Eigen::Matrix4d> gram(effect * effect.transpose());
  gram.setThreshold(1e-12);  // levers of a micrometre are none
  if (gram.rank() < 4) {
    throw InvalidInput(
        world.tree().short_path(link) + ": its " + std::to_string(rotors.size()) +
        " rotors cannot exert thrust and torques about all axes: it needs at least four, some clockwise");
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 4> inverse = effect.transpose() * gram.inverse();
  std::vector<double> rows;
  for (Eigen::Index row = 0; row < inverse.rows(); ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) rows.push_back(inverse(row, column));
  }
  return rows;
}

/// The attitude with this z axis whose x axis is nearest to a given one.
Axes attitude(const Vector3& z, const Axes& now) {
  constexpr double kParallel = 1e-3;
  Vector3 x = now.x;
  for (const Vector3& other : {now.y, now.z}) {
    if (x.cross(z).squaredNorm() < kParallel) x = other;
  }
  const Vector3 y = z.cross(x).normalized();
  return {y.cross(z), y, z};
}

}  // namespace

MulticopterVelocityControl::MulticopterVelocityControl(const World& world,
                                                       const VelocityControlDescription& description,
                                                       std::vector<std::shared_ptr<Rotor>> rotors)
    : description_(description), rotors_(std::move(rotors)) {
  check_pushable(world, description_.link);
  for (const Vector3& gains : {description_.velocity_gain, description_.attitude_gain, description_.rate_gain}) {
    if (within(gains, kMaxEffort) && (gains.array() >= 0).all()) continue;
    throw InvalidInput(world.tree().short_path(description_.link) + ": the gains " + text(gains) +
                       " are not usable: each must be from 0 to 1e9");
  }
  if (!(description_.max_acceleration.array() >= 0).all()) {
    throw InvalidInput(world.tree().short_path(description_.link) + ": the greatest acceleration " +
                       text(description_.max_acceleration) + " m/s^2 is not usable: it must be 0 or more");
  }
  mixing_ = mixing_of(world, description_.link, rotors_);
  mass_ = mass_of_model(world, description_.link);
}

void MulticopterVelocityControl::set_velocity(const Vector3& linear, double yaw_rate) {
  if (!within(linear, kMaxSpeed) || !within(yaw_rate, kMaxSpeed)) {
    throw InvalidInput("the velocity " + text(linear) + " m/s, " + text(yaw_rate) +
                       " rad/s is not usable: it must be finite and at most 1e6");
  }
  command_ = Command{linear, yaw_rate};
}

void MulticopterVelocityControl::stop() {
  command_.reset();
  for (const auto& rotor : rotors_) rotor->set_speed(0);
}

void MulticopterVelocityControl::update(World& world, double, double) {
  if (!command_) return;
  const Pose pose = world.pose(description_.link);
  const Twist twist = world.velocity(description_.link);
  const Axes now = axes_of(pose.orientation);

  const Vector3 error = pose.orientation * command_->linear - twist.linear;
  const Vector3& most = description_.max_acceleration;
  const Vector3 acceleration = (error.cwiseProduct(description_.velocity_gain) / mass_).cwiseMin(most).cwiseMax(-most);
  const Vector3 force = (acceleration - world.properties().gravity()) * mass_;
  if (force.squaredNorm() == 0) return;  // weightless and at the velocity: any attitude will do

  // e_R = (R_d^T R - R^T R_d)^v / 2, and e_omega with R^T R_d omega_d.
  const Axes wanted = attitude(force.normalized(), now);
  const Vector3 attitude_error =
      pose.orientation.conjugate() * ((wanted.x.cross(now.x) + wanted.y.cross(now.y) + wanted.z.cross(now.z)) / 2);
  const Vector3 rate_error = pose.orientation.conjugate() * (twist.angular - wanted.z * command_->yaw_rate);
  const Vector3 torque =
      -attitude_error.cwiseProduct(description_.attitude_gain) - rate_error.cwiseProduct(description_.rate_gain);
  const double thrust = force.dot(now.z);
  for (std::size_t i = 0; i < rotors_.size(); ++i) {
    const double* row = &mixing_[4 * i];
    const double squared = row[0] * torque.x() + row[1] * torque.y() + row[2] * torque.z() + row[3] * thrust;
    rotors_[i]->set_speed(std::sqrt(std::max(squared, 0.0)));
  }
}

void MulticopterVelocityControl::reset(World&) { command_.reset(); }

void MulticopterVelocityControl::transfer(StateArchive& archive) {
  bool commanded = command_.has_value();
  Command command = command_.value_or(Command{});
  archive(commanded, command.linear, command.yaw_rate);
  if (archive.restores()) command_ = commanded ? std::make_optional(command) : std::nullopt;
}

}  // namespace bubblesim
