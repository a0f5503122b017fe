// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"

namespace bubblesim::reading_messages {

void put(Fields& fields, const Header& header) {
  fields.message("header", [&] {
    fields.put("stamp", header.stamp);
    fields.put("frame_id", std::string_view(header.frame));
  });
}

void put(Fields& fields, std::string_view name, const Vector3& vector) {
  fields.message(name, [&] {
    fields.put("x", vector.x());
    fields.put("y", vector.y());
    fields.put("z", vector.z());
  });
}

void put(Fields& fields, std::string_view name, const Quaternion& rotation) {
  fields.message(name, [&] {
    fields.put("x", rotation.x());
    fields.put("y", rotation.y());
    fields.put("z", rotation.z());
    fields.put("w", rotation.w());
  });
}

void put(Fields& fields, std::string_view name, const Pose& pose) {
  fields.message(name, [&] {
    put(fields, "position", pose.position);
    put(fields, "orientation", pose.orientation);
  });
}

}  // namespace bubblesim::reading_messages
