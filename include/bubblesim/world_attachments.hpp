// SPDX-License-Identifier: BSD-3-Clause
// Links of any models that are attached to each other and detached while the simulation runs.
#pragma once

#include <cstdint>
#include <vector>

#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world_part.hpp"

namespace bubblesim {

/// Unique among the attachments of a world until it is reset.
using AttachmentId = std::uint32_t;

struct Attachment {
  AttachmentId id = 0;
  ObjectId parent = kNoObject;  ///< link
  ObjectId child = kNoObject;   ///< link
};

/// An attachment holds two links where they are to each other, as a fixed joint does: the models become one mechanism
/// for the solver, and the two links do not collide with each other. It is no object of the tree. It ends when it is
/// detached, when one of the models is removed, and when the world is reset.
class WorldAttachments : public WorldPart {
 public:
  using WorldPart::WorldPart;

  /// A link of a static model holds the other one at its place in the world. If one of the links is put elsewhere by
  /// World::set_pose(), they are held as they are then. Devices may attach in their updates. Throws NoSuchObject;
  /// WrongObject for other objects than links, for a link and itself, and if both are static.
  AttachmentId attach(ObjectId parent, ObjectId child);
  /// Does nothing if it has ended.
  void detach(AttachmentId attachment);
  /// Whether it has not ended.
  bool contains(AttachmentId attachment) const;
  /// In the order in which they were made.
  std::vector<Attachment> all() const;
};

}  // namespace bubblesim
