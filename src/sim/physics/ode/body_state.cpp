// SPDX-License-Identifier: BSD-3-Clause
#include "physics/ode/body_state.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "bubblesim/error.hpp"
#include "physics/ode/ode_math.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

struct Part {
  const dReal* values;
  std::size_t count;
};

std::array<Part, 6> parts_of(dBodyID body) {
  return {{{dBodyGetPosition(body), 3},
           {dBodyGetQuaternion(body), 4},
           {dBodyGetLinearVel(body), 3},
           {dBodyGetAngularVel(body), 3},
           {dBodyGetForce(body), 3},
           {dBodyGetTorque(body), 3}}};
}

constexpr double kMaxForce = 1e12;  // N or N m, beyond what any wrench can sum up to

bool is_usable(const BodyNumbers& n) {
  const dReal square = n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6];
  return within({n[0], n[1], n[2]}, kMaxDistance) && within(square - 1, 1e-3) &&
         within({n[7], n[8], n[9]}, kMaxSpeed) && within({n[10], n[11], n[12]}, kMaxSpeed) &&
         std::all_of(n.begin() + 13, n.end(), [](dReal force) { return within(force, kMaxForce); });
}

}  // namespace

BodyNumbers numbers_of(dBodyID body) {
  BodyNumbers numbers;
  auto to = numbers.begin();
  for (const Part& part : parts_of(body)) to = std::copy_n(part.values, part.count, to);
  return numbers;
}

void set_body_pose(dBodyID body, const Pose& pose) {
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());  // its shapes note that they moved
  auto* quaternion = const_cast<dReal*>(dBodyGetQuaternion(body));
  std::copy_n(to_ode(pose.orientation).data(), 4, quaternion);
  dRfromQ(const_cast<dReal*>(dBodyGetRotation(body)), quaternion);
}

void set_numbers(dBodyID body, const BodyNumbers& numbers) {
  const dReal* n = numbers.data();
  set_body_pose(body, {to_vector(n), to_quaternion(n + 3)});
  dBodySetLinearVel(body, n[7], n[8], n[9]);
  dBodySetAngularVel(body, n[10], n[11], n[12]);
  dBodySetForce(body, n[13], n[14], n[15]);
  dBodySetTorque(body, n[16], n[17], n[18]);
}

void transfer_body(StateArchive& archive, dBodyID body) {
  BodyNumbers numbers{};
  if (!archive.restores()) numbers = numbers_of(body);
  std::uint8_t enabled = dBodyIsEnabled(body) != 0 ? 1 : 0;
  archive.bytes(numbers.data(), sizeof numbers);
  archive(enabled);
  if (!archive.restores()) return;
  if (!is_usable(numbers)) throw InvalidInput("the saved state of a body is not usable: its numbers are not finite");
  set_numbers(body, numbers);
  if (enabled != 0) {
    dBodyEnable(body);
  } else {
    dBodyDisable(body);
  }
}

}  // namespace bubblesim
