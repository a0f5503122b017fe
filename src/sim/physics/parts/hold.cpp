// SPDX-License-Identifier: BSD-3-Clause
#include "physics/parts/hold.hpp"

#include <algorithm>
#include <optional>

#include "physics/parts/put_for_a_moment.hpp"

namespace bubblesim {

void join(dWorldID world, dJointGroupID group, const Hold& hold) {
  std::optional<PutForAMoment> holder;
  if (hold.holder != nullptr) holder.emplace(*hold.holder, Pose());
  const PutForAMoment link(*hold.link, hold.in_holder);
  dJointID joint = dJointCreateFixed(world, group);
  dJointAttach(joint, hold.link->body.get(), hold.holder == nullptr ? nullptr : hold.holder->body.get());
  dJointSetFixed(joint);
}

bool are_held(const Holds& holds, const Link& a, const Link& b) {
  return std::any_of(holds.begin(), holds.end(), [&](const Hold& hold) {
    const ObjectId parent = hold.attachment.parent;
    const ObjectId child = hold.attachment.child;
    return (parent == a.object && child == b.object) || (parent == b.object && child == a.object);
  });
}

}  // namespace bubblesim
