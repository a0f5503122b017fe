// SPDX-License-Identifier: BSD-3-Clause
// A gripper to which an object is attached while its fingers press it, as in Gazebo: contacts alone let it slip.
#pragma once

#include <optional>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

struct GraspDescription {
  ObjectId palm = kNoObject;        ///< link to which the object is attached
  std::vector<ObjectId> fingers;    ///< links that press it
  int min_contacts = 2;             ///< contact points of the fingers with the object
  std::optional<double> min_angle;  ///< rad, between the forces of two fingers on the object; any if not set
  int attach_updates = 20;          ///< the object is attached after more updates in which it is pressed
  int detach_updates = 40;          ///< and detached after more updates in a row in which it is not
  std::optional<double> slack;      ///< m; it stays attached unless a finger has moved away by more than this, too
};

/// In each update, an object counts as pressed if the fingers touch one of its links in `min_contacts` points, two of
/// them if there are two or more; with `min_angle` also if the forces of two fingers enclose that angle or a greater
/// one, the smaller force being at least 0.3 of the other. Objects are links that can move, of other models. One object
/// at a time is attached. Fingers press it on, and the palm, if it is one of the fingers, does not count while it is
/// attached.
class Grasp final : public Device {
 public:
  /// Throws NoSuchObject; WrongObject unless palm and fingers are links; InvalidInput without fingers, and for numbers
  /// out of range.
  Grasp(const World& world, GraspDescription description);

  /// The link that is attached; kNoObject for none.
  ObjectId attached() const { return attachment_ == 0 ? kNoObject : object_; }

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  /// Where a finger presses the object.
  struct Press {
    ObjectId finger = kNoObject;
    Vector3 in_finger;
    Vector3 in_object;

    void transfer(StateArchive& archive) { archive(finger, in_finger, in_object); }
  };

  ObjectId pressed(const World& world) const;
  void attach(World& world);
  bool has_opened(const World& world) const;

  GraspDescription description_;
  ObjectId model_ = kNoObject;   // of the palm
  ObjectId object_ = kNoObject;  // that is pressed or attached
  int held_ = 0;                 // updates in which it was pressed
  int missed_ = 0;               // in a row, in which it was not
  AttachmentId attachment_ = 0;  // 0: none
  std::vector<Press> presses_;   // when it was attached
};

}  // namespace bubblesim
