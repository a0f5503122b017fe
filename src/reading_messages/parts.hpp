// SPDX-License-Identifier: BSD-3-Clause
// Parts that many messages have: headers, vectors, rotations, poses and covariances.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "bubblesim/math.hpp"
#include "bubblesim/messages/fields.hpp"

namespace bubblesim::reading_messages {

using messages::Fields;

/// std_msgs/Header; its sequence number is that of the connection.
struct Header {
  messages::Stamp stamp;
  std::string frame;
};

/// Variances on the diagonal of a covariance matrix; the other elements are zero.
template <std::size_t size>
using Variances = std::array<double, size>;

void put(Fields& fields, const Header& header);
/// geometry_msgs/Vector3 or Point.
void put(Fields& fields, std::string_view name, const Vector3& vector);
/// geometry_msgs/Quaternion.
void put(Fields& fields, std::string_view name, const Quaternion& rotation);
/// geometry_msgs/Pose.
void put(Fields& fields, std::string_view name, const Pose& pose);

/// A covariance matrix, row by row.
template <std::size_t size>
void put(Fields& fields, std::string_view name, const Variances<size>& variances) {
  std::array<double, size * size> matrix{};
  for (std::size_t i = 0; i < size; ++i) matrix[i * (size + 1)] = variances[i];
  fields.array(name, matrix);
}

}  // namespace bubblesim::reading_messages
