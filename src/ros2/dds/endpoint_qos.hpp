// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/messages/qos.hpp"
#include "dds/fast_dds.hpp"

namespace bubblesim::ros2 {

dds::DataWriterQos writer_qos(const messages::Qos& qos);
dds::DataReaderQos reader_qos(const messages::Qos& qos);

}  // namespace bubblesim::ros2
