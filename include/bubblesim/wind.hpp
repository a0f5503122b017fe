// SPDX-License-Identifier: BSD-3-Clause
// The wind of a simulation: its velocity, which devices of propellers, wings and drag use, and its force on links.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// The same everywhere. It pushes the links with LinkDescription::wind_enabled at their centres of mass, with the force
/// mass * force_factor() * (wind - velocity of the centre of mass), as Gazebo; not when it is 0 without a variation.
class Wind final : public Device {
 public:
  /// How the wind varies about its mean, with the parameters of gz-sim's WindEffects. Speed and direction of the
  /// horizontal wind, and the vertical wind, approach their means exponentially with these time constants, from 0 and
  /// from the mean direction. A sine and white noise, drawn anew in each physics substep, are added.
  struct Variation {
    double rise_time = 1;           ///< s, of the horizontal speed
    double sine_part = 0;           ///< amplitude of the sine, as a part of the horizontal speed
    double sine_period = 1;         ///< s
    double speed_noise = 0;         ///< m/s, standard deviation
    double turn_time = 1;           ///< s, of the direction
    double turn_sine = 0;           ///< rad, amplitude
    double turn_period = 1;         ///< s
    double turn_noise = 0;          ///< rad, standard deviation
    double vertical_rise_time = 1;  ///< s
    double vertical_noise = 0;      ///< m/s, standard deviation

    void transfer(StateArchive& archive);
  };

  /// The mean in m/s, world axes. Noise depends on the seed and the simulation time alone.
  Wind(const Vector3& mean, std::uint64_t seed);

  /// m/s, world axes: of the current physics substep.
  const Vector3& velocity() const { return velocity_; }
  const Vector3& mean() const { return mean_; }
  /// Until the next reset. Without a variation, the wind has this velocity at once. Throws InvalidInput unless it is
  /// finite and at most 1e6 m/s.
  void set_mean(const Vector3& mean);
  /// Not changed by a reset. Throws InvalidInput for times that are not above 0 and for negative deviations.
  void set_variation(const Variation& variation);
  /// 1/s; 1 by default. Not changed by a reset. Throws InvalidInput unless it is from 0 to 1e6.
  void set_force_factor(double factor);
  double force_factor() const { return force_factor_; }
  /// Of the noise from now on.
  void set_seed(std::uint64_t seed) { seed_ = seed; }

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  void blow(double time, double duration);
  void restart();

  Vector3 first_mean_;
  Vector3 mean_;
  std::uint64_t seed_;
  std::optional<Variation> variation_;
  double force_factor_ = 1;
  Vector3 velocity_;
  double speed_ = 0;      // m/s, of the horizontal wind, without sine and noise
  double direction_ = 0;  // rad, of the same
  double vertical_ = 0;   // m/s, of the same
  std::vector<ObjectId> pushed_;
  std::optional<std::uint64_t> revision_;  // of the world in which the links were found
};

}  // namespace bubblesim
