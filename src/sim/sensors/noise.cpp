// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "bubblesim/sensor_noise.hpp"
#include "scene/fnv1a.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::uint64_t seed_of(std::uint64_t seed, ObjectId sensor, std::uint64_t channel, std::uint64_t time_bits) {
  Fnv1a hash;
  hash.add(seed);
  hash.add(static_cast<std::uint64_t>(sensor));
  hash.add(channel);
  hash.add(time_bits);
  return hash.value();
}

NoiseDescription scaled_noise(NoiseDescription description, double scale) {
  description.stddev *= scale;
  description.bias_stddev *= scale;
  return description;
}

}  // namespace

const MemberTable& NoiseDescription::members() {
  using D = NoiseDescription;
  const std::string deviation = "the noise's standard deviation or precision";
  static const MemberTable table = member_table<D>(
      "NoiseDescription", "Gaussian noise of a measured value.",
      {
          member<&D::mean>("mean", "", "mean")
              .with_title("the noise's mean")
              .with_limits(-kMaxSize, kMaxSize, "finite"),
          member<&D::stddev>("stddev", "", "standard deviation")
              .with_title(deviation)
              .with_limits(0, kMaxSize, "0 or more"),
          member<&D::bias_mean>("bias_mean", "", "mean of a bias, which is drawn once")
              .with_title("the bias's mean")
              .with_limits(-kMaxSize, kMaxSize, "finite"),
          member<&D::bias_stddev>("bias_stddev", "", "standard deviation of the bias")
              .with_title(deviation)
              .with_limits(0, kMaxSize, "0 or more"),
          member<&D::precision>("precision", "", "values are rounded to multiples of it; 0: not rounded")
              .with_title(deviation)
              .with_limits(0, kMaxSize, "0 or more"),
      });
  return table;
}

double NormalSource::uniform() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1;
}

double NormalSource::next() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0;
  double v = 0;
  double square = 0;
  do {
    u = uniform();
    v = uniform();
    square = u * u + v * v;
  } while (square >= 1 || square == 0);
  const double scale = std::sqrt(-2 * std::log(square) / square);
  spare_ = v * scale;
  has_spare_ = true;
  return u * scale;
}

Noise::Noise(const NoiseDescription& description, const MeasurementContext& context, ObjectId sensor,
             std::uint64_t channel)
    : description_(scaled_noise(description, context.noise_scale)),
      active_(description_.mean != 0 || description_.stddev > 0 || description_.bias_mean != 0 ||
              description_.bias_stddev > 0 || description_.precision > 0),
      normal_(seed_of(context.seed, sensor, 2 * channel, bits_of(context.time))) {
  // The bias does not depend on time: it is equal in all measurements.
  NormalSource once(seed_of(context.seed, sensor, 2 * channel + 1, 0));
  bias_ = description_.bias_mean + description_.bias_stddev * once.next();
}

double Noise::operator()(double value) {
  double noisy = value + bias_ + description_.mean;
  if (description_.stddev > 0) noisy += description_.stddev * normal_.next();
  if (description_.precision > 0) noisy = std::round(noisy / description_.precision) * description_.precision;
  return noisy;
}

void distort(double& value, const NoiseDescription& description, const MeasurementContext& context, ObjectId sensor,
             std::uint64_t channel) {
  Noise noise(description, context, sensor, channel);
  if (noise.active()) value = noise(value);
}

void distort(Vector3& value, const std::array<NoiseDescription, 3>& descriptions, const MeasurementContext& context,
             ObjectId sensor, std::uint64_t first_channel) {
  double* component = value.data();
  for (const NoiseDescription& description : descriptions) {
    distort(*component++, description, context, sensor, first_channel++);
  }
}

}  // namespace bubblesim
