// SPDX-License-Identifier: BSD-3-Clause
#include "status/topic_traffic.hpp"

#include "master/master_call.hpp"

namespace bubblesim {
namespace {

using XmlRpc::XmlRpcValue;

std::uint32_t number(XmlRpcValue& value) { return static_cast<std::uint32_t>(static_cast<int&>(value)); }

}  // namespace

const TrafficReport& TopicTraffic::take_report() {
  report_.just_dropped.clear();
  XmlRpcValue stats = own_response("getBusStats");
  if (stats.getType() != XmlRpcValue::TypeArray || stats.size() < 2) return report_;
  // [publications, subscriptions, ...], both [[topic, [connection, ...]], ...]; a publication's connection is [number,
  // bytes, bytes of messages, messages, ...], a subscription's [number, bytes, messages, dropped, ...].
  const auto read = [](XmlRpcValue& topics, bool outgoing) {
    Counted counted;
    for (int i = 0; topics.getType() == XmlRpcValue::TypeArray && i < topics.size(); ++i) {
      XmlRpcValue& connections = topics[i][1];
      for (int k = 0; connections.getType() == XmlRpcValue::TypeArray && k < connections.size(); ++k) {
        XmlRpcValue& link = connections[k];
        Counts& counts = counted[{topics[i][0], link[0]}];
        counts.bytes = number(link[1]);
        counts.messages = number(link[outgoing ? 3 : 2]);
        counts.dropped = outgoing ? 0 : number(link[3]);
      }
    }
    return counted;
  };
  // roscpp's counters wrap at 2^32 and restart with each connection.
  const auto add = [this](const Counted& before, const Counted& now, TrafficReport::Total& total) {
    for (const auto& [connection, counts] : now) {
      const auto found = before.find(connection);
      const Counts old = found == before.end() ? Counts() : found->second;
      total.bytes += counts.bytes - old.bytes;
      total.messages += counts.messages - old.messages;
      const std::uint32_t dropped = counts.dropped - old.dropped;
      report_.dropped += dropped;
      if (dropped != 0) report_.just_dropped[connection.first] += dropped;
    }
  };
  Counted outgoing = read(stats[0], true);
  Counted incoming = read(stats[1], false);
  add(outgoing_, outgoing, report_.sent);
  add(incoming_, incoming, report_.received);
  outgoing_ = std::move(outgoing);
  incoming_ = std::move(incoming);
  return report_;
}

}  // namespace bubblesim
