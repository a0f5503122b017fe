// SPDX-License-Identifier: BSD-3-Clause
#include "dds/participant.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "bubblesim/signals_blocked.hpp"
#include "dds/endpoint_qos.hpp"

namespace bubblesim::ros2 {
namespace {

constexpr std::uint32_t kMostLocalPeers = 32;      // participants of a machine that are looked for
constexpr std::uint32_t kFirstAnnouncements = 20;  // in the first two seconds; the default of 5 makes peers late
constexpr std::int32_t kAnnouncementPeriod = 1;    // s
constexpr const char* kLoopback = "127.0.0.1";
constexpr const char* kAnyAddress = "0.0.0.0";
constexpr const char* kMulticast = "239.255.0.1";  // of RTPS, as are the ports
constexpr std::uint32_t kFirstPort = 7400;
constexpr std::uint32_t kPortsOfDomain = 250;

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// `port` 0: Fast DDS chooses it; of a peer, it tries those of kMostLocalPeers participants.
rtps::Locator_t locator(const std::string& address, std::uint32_t port = 0) {
  rtps::Locator_t place;
  place.kind = LOCATOR_KIND_UDPv4;
  place.port = port;
  IpLocator::setIPv4(place, address);
  return place;
}

/// The IPv4 addresses of a host. Throws std::invalid_argument if it has none.
std::vector<std::string> addresses_of(const std::string& host) {
  const auto [v4, v6] = IpLocator::resolveNameDNS(host);
  std::vector<std::string> addresses(v4.begin(), v4.end());
  if (addresses.empty()) throw std::invalid_argument("ROS_STATIC_PEERS: '" + host + "' has no IPv4 address");
  return addresses;
}

/// Who is looked for, and where this participant is found.
template <class Protocol>
void set_range(Protocol& protocol, const Environment& environment) {
  auto& builtin = protocol.builtin;
  if (environment.range == Range::kOff) builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol::NONE;
  for (const std::string& host : environment.peers) {
    for (const std::string& address : addresses_of(host)) builtin.initialPeersList.push_back(locator(address));
  }
  if (environment.range == Range::kSubnet) {
    if (!environment.peers.empty()) {  // without peers it is the default
      const auto domain = static_cast<std::uint32_t>(environment.domain);
      builtin.initialPeersList.push_back(locator(kMulticast, kFirstPort + kPortsOfDomain * domain));
    }
    return;
  }
  // No whitelist of interfaces: peers that are limited to this machine still name its other addresses, and listen on
  // all. Our sockets are bound to all addresses as well, but only announced on loopback, unless others know of us.
  const rtps::Locator_t place = locator(environment.peers.empty() ? kLoopback : kAnyAddress);
  builtin.metatrafficMulticastLocatorList.clear();
  builtin.metatrafficUnicastLocatorList.push_back(place);
  builtin.initialPeersList.push_back(locator(kLoopback));
  if (environment.peers.empty()) protocol.default_unicast_locator_list.push_back(place);
}

dds::DomainParticipantQos participant_qos(const Environment& environment) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name("bubblesim");
  qos.user_data().setValue(bytes_of("enclave=/;"));  // without it, ROS 2's middlewares do not see the participant
  qos.transport().use_builtin_transports = false;
  const auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = kMostLocalPeers;
  qos.transport().user_transports.push_back(udp);
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration_announcementperiod = {kAnnouncementPeriod, 0};
  discovery.initial_announcements.count = kFirstAnnouncements;
  set_range(qos.wire_protocol(), environment);
  return qos;
}

/// Fast DDS logs to stdout otherwise.
void log_to_stderr() {
  auto consumer = std::make_unique<dds::StdoutErrConsumer>();
  consumer->stderr_threshold(dds::Log::Kind::Info);
  dds::Log::ClearConsumers();
  dds::Log::RegisterConsumer(std::move(consumer));
  dds::Log::SetVerbosity(dds::Log::Kind::Error);
}

[[noreturn]] void throw_refused(const TopicName& name) {
  throw std::runtime_error("Fast DDS does not create the topic " + name.topic + " of type " + name.type);
}

}  // namespace

/// One for all endpoints of a topic.
class Participant::Topic {
 public:
  Topic(dds::DomainParticipant& participant, const TopicName& name)
      : participant_(participant), topic_(participant.create_topic(name.topic, name.type, dds::TOPIC_QOS_DEFAULT)) {
    if (topic_ == nullptr) throw_refused(name);
  }
  ~Topic() { participant_.delete_topic(topic_); }
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;

  dds::Topic* get() const { return topic_; }

 private:
  dds::DomainParticipant& participant_;
  dds::Topic* topic_;
};

Participant::Participant(const Environment& environment) {
  log_to_stderr();
  listener_.on_reader = [this](const DiscoveredEndpoint& reader) { note(remote_readers_, reader); };
  listener_.on_writer = [this](const DiscoveredEndpoint& writer) { note(remote_writers_, writer); };
  const SignalsBlocked blocked;
  participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<dds::DomainId_t>(environment.domain), participant_qos(environment), &listener_,
      dds::StatusMask::none());
  if (participant_ == nullptr) {
    throw std::runtime_error("ROS 2 cannot be used: Fast DDS opens no UDP socket in domain " +
                             std::to_string(environment.domain));
  }
  publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

Participant::~Participant() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

int Participant::revision() const {
  const std::lock_guard lock(mutex_);
  return endpoints_.revision;
}

NodeEndpoints Participant::endpoints() const {
  const std::lock_guard lock(mutex_);
  return endpoints_;
}

std::set<std::string> Participant::types_of_readers(const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  std::set<std::string> types;
  const auto found = remote_readers_.find(topic);
  if (found == remote_readers_.end()) return types;
  for (const auto& [guid, reader] : found->second) types.insert(reader.type);
  return types;
}

std::vector<DiscoveredEndpoint> Participant::remote_readers() const { return all_of(remote_readers_); }

std::vector<DiscoveredEndpoint> Participant::remote_writers() const { return all_of(remote_writers_); }

std::vector<DiscoveredEndpoint> Participant::all_of(const Endpoints& endpoints) const {
  const std::lock_guard lock(mutex_);
  std::vector<DiscoveredEndpoint> all;
  for (const auto& [topic, of_topic] : endpoints) {
    for (const auto& [guid, endpoint] : of_topic) all.push_back(endpoint);
  }
  return all;
}

void Participant::note(Endpoints& endpoints, const DiscoveredEndpoint& found) {
  const std::lock_guard lock(mutex_);
  auto& of_topic = endpoints[found.topic];
  if (found.removed) {
    of_topic.erase(found.guid);
  } else {
    of_topic[found.guid] = found;
  }
  if (of_topic.empty()) endpoints.erase(found.topic);
}

std::shared_ptr<Participant::Topic> Participant::topic(const TopicName& name) {
  const std::lock_guard lock(mutex_);
  if (types_.count(name.type) == 0) {
    dds::TypeSupport type(new BytesType(name.type));
    type.register_type(participant_);
    types_.emplace(name.type, type);
  }
  std::shared_ptr<Topic> topic = topics_[name.topic].lock();
  if (topic && topic->get()->get_type_name() != name.type) throw_refused(name);
  if (!topic) {
    topic = std::make_shared<Topic>(*participant_, name);
    topics_[name.topic] = topic;
  }
  return topic;
}

Writer::Writer(Participant& participant, const TopicName& name, const messages::Qos& qos,
               dds::DataWriterListener* listener, bool of_node)
    : participant_(participant), topic_(participant.topic(name)) {
  dds::DataWriterQos wanted = writer_qos(qos);
  wanted.user_data().setValue(bytes_of("typehash=" + name.type_hash + ";"));
  const SignalsBlocked blocked;
  writer_ = participant.publisher_->create_datawriter(topic_->get(), wanted, listener);
  if (writer_ == nullptr) throw_refused(name);
  if (!of_node) return;
  const std::lock_guard lock(participant.mutex_);
  participant.endpoints_.writers.insert(writer_->guid());
  ++participant.endpoints_.revision;
}

Writer::~Writer() {
  {
    const std::lock_guard lock(participant_.mutex_);
    participant_.endpoints_.revision += static_cast<int>(participant_.endpoints_.writers.erase(writer_->guid()));
  }
  writer_->set_listener(nullptr);
  participant_.publisher_->delete_datawriter(writer_);
}

Reader::Reader(Participant& participant, const TopicName& name, const messages::Qos& qos,
               dds::DataReaderListener* listener)
    : participant_(participant), topic_(participant.topic(name)) {
  dds::DataReaderQos wanted = reader_qos(qos);
  wanted.user_data().setValue(bytes_of("typehash=" + name.type_hash + ";"));
  const SignalsBlocked blocked;
  reader_ = participant.subscriber_->create_datareader(topic_->get(), wanted, listener);
  if (reader_ == nullptr) throw_refused(name);
  const std::lock_guard lock(participant.mutex_);
  participant.endpoints_.readers.insert(reader_->guid());
  ++participant.endpoints_.revision;
}

Reader::~Reader() {
  {
    const std::lock_guard lock(participant_.mutex_);
    participant_.endpoints_.revision += static_cast<int>(participant_.endpoints_.readers.erase(reader_->guid()));
  }
  reader_->set_listener(nullptr);
  participant_.subscriber_->delete_datareader(reader_);
}

}  // namespace bubblesim::ros2
