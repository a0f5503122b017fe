// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/joint_ramps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {

JointRamps::JointRamps(std::vector<double> rates, std::vector<Output> outputs)
    : rates_(std::move(rates)), outputs_(std::move(outputs)), inputs_(rates_.size()), targets_(rates_.size()) {
  for (const double rate : rates_) {
    if (!(rate >= 0)) throw InvalidInput("the rate " + text(rate) + " of an input is not usable: it must be 0 or more");
  }
  for (const Output& output : outputs_) {
    const bool finite =
        std::all_of(output.factors.begin(), output.factors.end(), [](double f) { return std::isfinite(f); });
    if (finite && output.factors.size() == rates_.size()) continue;
    throw InvalidInput("the factors of an output are not usable: they must be " + std::to_string(rates_.size()) +
                       " finite numbers, one for each input");
  }
}

void JointRamps::set_targets(std::vector<double> targets) {
  const bool finite = std::all_of(targets.begin(), targets.end(), [](double target) { return std::isfinite(target); });
  if (!finite || targets.size() != rates_.size()) {
    throw InvalidInput("the targets are not usable: they must be " + std::to_string(rates_.size()) +
                       " finite numbers, one for each input");
  }
  targets_ = std::move(targets);
  changing_ = true;
}

void JointRamps::stop() {
  std::fill(inputs_.begin(), inputs_.end(), 0);
  std::fill(targets_.begin(), targets_.end(), 0);
  changing_ = false;
}

void JointRamps::update(World& world, double, double duration) {
  if (!changing_) return;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const double most = rates_[i] * duration;
    const double gap = targets_[i] - inputs_[i];
    inputs_[i] = std::abs(gap) <= most ? targets_[i] : inputs_[i] + std::copysign(most, gap);
  }
  changing_ = inputs_ != targets_;
  for (const Output& output : outputs_) {
    const double sum = std::inner_product(inputs_.begin(), inputs_.end(), output.factors.begin(), 0.0);
    if (output.mode == MotorMode::kPosition) {
      world.joints().set_target_position(output.joint, sum);
    } else {
      world.joints().set_target_velocity(output.joint, std::clamp(sum, -kMaxSpeed, kMaxSpeed));
    }
  }
}

void JointRamps::reset(World&) { stop(); }

void JointRamps::transfer(StateArchive& archive) {
  archive.require(inputs_.size(), "number of inputs of a device");
  for (std::size_t i = 0; i < inputs_.size(); ++i) archive(inputs_[i], targets_[i]);
  archive(changing_);
}

std::optional<std::vector<double>> CommandMix::inputs(const std::vector<double>& commands) const {
  const auto usable = [this](double command) { return std::abs(command) <= most; };  // NaN is not
  if (!std::all_of(commands.begin(), commands.end(), usable)) return std::nullopt;
  std::vector<double> inputs;
  double largest = 0;
  for (const Row& row : rows) {
    if (row.factors.size() != commands.size()) return std::nullopt;
    const double sum = std::inner_product(commands.begin(), commands.end(), row.factors.begin(), 0.0);
    inputs.push_back(sum / row.divisor);
    largest = std::max(largest, std::abs(inputs.back()));
  }
  if (largest > most) {
    for (double& input : inputs) input *= most / largest;
  }
  return inputs;
}

}  // namespace bubblesim
