// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/wind.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/sensor_noise.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"
#include "scene/fnv1a.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

double direction_of(const Vector3& wind) { return std::atan2(wind.y(), wind.x()); }

/// The part of the gap to the mean that is closed in a time.
double closed_part(double duration, double time_constant) { return -std::expm1(-duration / time_constant); }

double sine(double time, double period) { return std::sin(2 * M_PI * time / period); }

NormalSource noise_at(std::uint64_t seed, double time) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &time, sizeof bits);
  Fnv1a hash;
  hash.add(seed);
  hash.add(bits);
  return NormalSource(hash.value());
}

}  // namespace

Wind::Wind(const Vector3& mean, std::uint64_t seed) : first_mean_(mean), seed_(seed) {
  set_mean(mean);
  restart();
}

void Wind::set_mean(const Vector3& mean) {
  if (!within(mean, kMaxSpeed)) {
    throw InvalidInput("the wind " + text(mean) + " m/s is not usable: it must be finite and at most 1e6");
  }
  mean_ = mean;
  if (!variation_) velocity_ = mean_;
}

void Wind::set_variation(const Variation& v) {
  for (const double time : {v.rise_time, v.sine_period, v.turn_time, v.turn_period, v.vertical_rise_time}) {
    if (time > 0 && std::isfinite(time)) continue;
    throw InvalidInput("a time of " + text(time) + " s in the variation of the wind is not usable: it must be above 0");
  }
  for (const double deviation : {v.speed_noise, v.turn_noise, v.vertical_noise}) {
    if (deviation >= 0 && deviation <= kMaxSpeed) continue;
    throw InvalidInput("a standard deviation of " + text(deviation) +
                       " of the wind is not usable: it must be from 0 to 1e6");
  }
  if (!within(v.sine_part, kMaxSpeed) || !within(v.turn_sine, kMaxSpeed)) {
    throw InvalidInput("the amplitudes of the wind must be finite and at most 1e6");
  }
  variation_ = v;
  restart();
}

void Wind::set_force_factor(double factor) {
  if (!(factor >= 0 && factor <= kMaxSpeed)) {
    throw InvalidInput("the force factor " + text(factor) + " 1/s of the wind is not usable: it must be from 0 to 1e6");
  }
  force_factor_ = factor;
}

void Wind::restart() {
  speed_ = vertical_ = 0;
  direction_ = direction_of(mean_);
  velocity_ = variation_ ? Vector3::Zero() : mean_;
}

void Wind::blow(double time, double duration) {
  const Variation& v = *variation_;
  const double mean_speed = std::hypot(mean_.x(), mean_.y());
  speed_ += (mean_speed - speed_) * closed_part(duration, v.rise_time);
  vertical_ += (mean_.z() - vertical_) * closed_part(duration, v.vertical_rise_time);
  const double turn = std::remainder(direction_of(mean_) - direction_, 2 * M_PI);
  direction_ += turn * closed_part(duration, v.turn_time);
  NormalSource normal = noise_at(seed_, time);
  const double speed = speed_ * (1 + v.sine_part * sine(time, v.sine_period)) + v.speed_noise * normal.next();
  const double direction = direction_ + v.turn_sine * sine(time, v.turn_period) + v.turn_noise * normal.next();
  const double vertical = vertical_ + v.vertical_noise * normal.next();
  velocity_ = {speed * std::cos(direction), speed * std::sin(direction), vertical};
}

void Wind::update(World& world, double time, double duration) {
  if (variation_) blow(time, duration);
  if (!variation_ && mean_.squaredNorm() == 0) return;
  if (revision_ != world.revision()) {
    pushed_ = moving_links(world, [](const LinkDescription& link) { return link.wind_enabled; });
    revision_ = world.revision();
  }
  for (const ObjectId link : pushed_) {
    const double mass = link_description(world, link).mass;
    // A great factor stops the motion relative to the wind in one substep, and does not reverse it.
    const double rate = std::min(force_factor_, 1 / duration);
    world.wrenches().apply(link, {(velocity_ - motion_of(world, link).twist.linear) * (mass * rate), {}});
  }
}

void Wind::reset(World&) {
  mean_ = first_mean_;
  restart();
}

void Wind::transfer(StateArchive& archive) {
  archive(mean_, seed_, force_factor_, velocity_, speed_, direction_, vertical_, variation_);
}

void Wind::Variation::transfer(StateArchive& archive) {
  archive(rise_time, sine_part, sine_period, speed_noise, turn_time, turn_sine, turn_period, turn_noise,
          vertical_rise_time, vertical_noise);
}

}  // namespace bubblesim
