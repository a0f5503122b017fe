// SPDX-License-Identifier: BSD-3-Clause
// Messages of one version of ROS as those of the other.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// Fields are those of the same name, where the case of letters does not count (CameraInfo has `K` in ROS 1 and `k` in
/// ROS 2). What only one type has is left out, or has its default.
class Translator {
 public:
  /// The types must live as long. Throws std::invalid_argument, with the field, if a value of `from` does not fit into
  /// the field of `to`.
  Translator(const MessageType& from, const MessageType& to);

  /// Throws WireError for bytes that are no message of the type.
  WireBuffer translate(WireView message) const;

 private:
  const MessageType& from_;
  const MessageType& to_;
};

}  // namespace bubblesim::messages
