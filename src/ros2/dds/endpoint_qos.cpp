// SPDX-License-Identifier: BSD-3-Clause
#include "dds/endpoint_qos.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim::ros2 {
namespace {

constexpr std::uint32_t kMostBlocking = 10'000'000;  // ns that a subscriber that is stopped may hold up write()
// s and ns after which a subscriber is asked what it lacks, as long as it has not confirmed all: Fast DDS's own 3 s are
// longer than a node may take to end.
const Duration kHeartbeat{0, 50'000'000};
constexpr std::int32_t kLeastKept = 10;     // messages of which lost parts can be sent again
constexpr std::int32_t kUsualLimit = 5000;  // messages in the history of an endpoint

Duration duration(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>(std::lround((seconds - whole) * 1e9))};
}

/// What writers and readers have in common.
template <class EndpointQos>
EndpointQos common(EndpointQos wanted, const messages::Qos& qos) {
  wanted.reliability().kind = qos.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  wanted.durability().kind = qos.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  const auto depth = static_cast<std::int32_t>(qos.depth);
  wanted.history().kind = depth == 0 ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  wanted.history().depth = std::max(depth, 1);
  wanted.resource_limits().max_samples = std::max(depth, kUsualLimit);
  wanted.resource_limits().max_samples_per_instance = std::max(depth, kUsualLimit);
  wanted.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  wanted.data_sharing().off();  // it is shared memory
  if (qos.deadline) wanted.deadline().period = duration(*qos.deadline);
  if (qos.lifespan) wanted.lifespan().duration = duration(*qos.lifespan);
  return wanted;
}

}  // namespace

dds::DataWriterQos writer_qos(const messages::Qos& qos) {
  dds::DataWriterQos wanted = common(dds::DATAWRITER_QOS_DEFAULT, qos);
  wanted.reliability().max_blocking_time = {0, kMostBlocking};
  if (qos.reliable && !qos.transient_local && qos.depth != 0) {
    wanted.history().depth = std::max(wanted.history().depth, kLeastKept);
  }
  wanted.reliable_writer_qos().times.heartbeatPeriod = kHeartbeat;
  wanted.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;  // a third of the time of the asynchronous one
  return wanted;
}

dds::DataReaderQos reader_qos(const messages::Qos& qos) { return common(dds::DATAREADER_QOS_DEFAULT, qos); }

}  // namespace bubblesim::ros2
