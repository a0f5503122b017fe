// SPDX-License-Identifier: BSD-3-Clause
// Attaches links to each other.
#include <algorithm>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/world_attachments.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/fnv1a.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

const Link& link_named(const WorldState& state, ObjectId id) {
  const Object& object = state.tree().at(id);
  if (object.kind == ObjectKind::kLink) return state.link(id);
  throw WrongObject(state.shown(id) + " is a " + std::string(kind_name(object.kind)) + ": links are attached");
}

/// The holder is the parent, unless the child is static.
Hold hold_of(const WorldState& state, const Attachment& attachment) {
  const Link& parent = link_named(state, attachment.parent);
  const Link& child = link_named(state, attachment.child);
  if (&parent == &child) throw WrongObject(state.shown(attachment.child) + " cannot be attached to itself");
  if (parent.body == nullptr && child.body == nullptr) {
    throw WrongObject(state.shown(attachment.parent) + " and " + state.shown(attachment.child) +
                      " are both static: one of them must be able to move");
  }
  const bool is_child_held = child.body != nullptr;
  Hold hold;
  hold.attachment = attachment;
  hold.link = is_child_held ? &child : &parent;
  hold.model = &state.model_of(hold.link->object);
  const Link& holder = is_child_held ? parent : child;
  if (holder.body == nullptr) return hold;
  hold.holder = &holder;
  hold.holder_model = &state.model_of(holder.object);
  return hold;
}

void take_pose(Hold& hold) {
  const Pose link = link_pose(*hold.link);
  const Pose pose = hold.holder == nullptr ? link : link_pose(*hold.holder).inverse() * link;
  hold.in_holder = {pose.position, pose.orientation.normalized()};
}

/// They move from now on: they are not at rest as before.
void wake_both(WorldState& state, const Hold& hold) {
  for (const Link* link : {hold.link, hold.holder}) {
    if (link == nullptr) continue;
    command(state.moving, link->body.get());
    state.model_of(link->object).rest.time = 0;
  }
}

}  // namespace

void hold_moved(WorldState& state, const std::set<ObjectId>& links) {
  for (Hold& hold : state.holds) {
    const bool is_link_moved = links.count(hold.link->object) > 0;
    const bool is_holder_moved = hold.holder != nullptr && links.count(hold.holder->object) > 0;
    if (is_link_moved != is_holder_moved) take_pose(hold);
  }
}

void forget_holds(WorldState& state, ObjectId model) {
  const auto is_of_it = [&](const Hold& hold) {
    const auto belongs = [&](ObjectId link) { return state.tree().outermost_model_of(link) == model; };
    return belongs(hold.attachment.parent) || belongs(hold.attachment.child);
  };
  state.holds.erase(std::remove_if(state.holds.begin(), state.holds.end(), is_of_it), state.holds.end());
}

void transfer_holds(StateArchive& archive, WorldState& state) {
  if (archive.restores()) state.holds.clear();
  std::size_t count = archive.count(state.holds.size());
  for (std::size_t i = 0; i < count; ++i) {
    Attachment attachment = archive.restores() ? Attachment{} : state.holds[i].attachment;
    Pose in_holder = archive.restores() ? Pose() : state.holds[i].in_holder;
    archive(attachment.id, attachment.parent, attachment.child, in_holder);
    if (!archive.restores()) continue;
    if (!state.tree().contains(attachment.parent) || !state.tree().contains(attachment.child)) {
      throw InvalidInput("the saved state attaches a link that is not there");
    }
    if (!within(in_holder.position, kMaxDistance) || !within(in_holder.orientation.norm() - 1, 1e-3)) {
      throw InvalidInput("the saved state attaches a link in a pose that is not usable");
    }
    Hold hold = hold_of(state, attachment);
    hold.in_holder = in_holder;
    state.holds.push_back(std::move(hold));
  }
  archive(state.attachments_made);
}

void add_holds(Fnv1a& hash, const WorldState& state) {
  for (const Hold& hold : state.holds) {
    for (const std::uint64_t number :
         {static_cast<std::uint64_t>(hold.attachment.id), static_cast<std::uint64_t>(hold.attachment.parent),
          static_cast<std::uint64_t>(hold.attachment.child)}) {
      hash.add(number);
    }
    add_pose(hash, hold.in_holder);
  }
}

AttachmentId WorldAttachments::attach(ObjectId parent, ObjectId child) {
  Hold hold = hold_of(state(), {state().attachments_made + 1, parent, child});
  take_pose(hold);
  wake_both(state(), hold);
  state().holds.push_back(std::move(hold));
  return ++state().attachments_made;
}

void WorldAttachments::detach(AttachmentId attachment) {
  Holds& holds = state().holds;
  const auto found =
      std::find_if(holds.begin(), holds.end(), [&](const Hold& hold) { return hold.attachment.id == attachment; });
  if (found == holds.end()) return;
  wake_both(state(), *found);
  holds.erase(found);
}

bool WorldAttachments::contains(AttachmentId attachment) const {
  const Holds& holds = state().holds;
  return std::any_of(holds.begin(), holds.end(), [&](const Hold& hold) { return hold.attachment.id == attachment; });
}

std::vector<Attachment> WorldAttachments::all() const {
  std::vector<Attachment> found;
  for (const Hold& hold : state().holds) found.push_back(hold.attachment);
  return found;
}

}  // namespace bubblesim
