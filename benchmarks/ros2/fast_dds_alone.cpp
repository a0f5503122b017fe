// SPDX-License-Identifier: BSD-3-Clause
// Times Fast DDS with ready bytes, for publish.py: as the node sets it up, without messages, bridge and Python.
//   fast_dds_alone ROUNDS TYPE=FILE...
// FILE has the CDR of a message, without its header. Waits until each topic /dds/NAME of a TYPE such as
// std_msgs/Float32 has a subscriber, and prints for each type the median time of a write in microseconds.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bubblesim/messages/registry.hpp"
#include "graph/names.hpp"

namespace {

using namespace bubblesim;
using Clock = std::chrono::steady_clock;

struct Publisher {
  std::string type;
  messages::WireBuffer message;
  std::unique_ptr<ros2::Writer> writer;
  std::vector<double> times;  // us

  bool has_subscriber() const {
    ros2::dds::PublicationMatchedStatus status;
    (**writer).get_publication_matched_status(status);
    return status.current_count > 0;
  }
};

messages::WireBuffer message_in(const std::string& file) {
  std::ifstream input(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(input), {}};
  messages::WireBuffer message;
  message.begin(messages::Layout::kCdr);
  message.put_bytes(bytes.data(), bytes.size());
  return message;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  ros2::Participant participant(ros2::read_environment());
  std::vector<Publisher> publishers;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string name = argument.substr(0, argument.find('='));
    const auto& type = ros2::listed(messages::find_message(name, messages::RosVersion::kRos2), name.c_str());
    const ros2::TopicName topic = ros2::message_topic("/dds" + name.substr(name.find('/')), type);
    publishers.push_back({name,
                          message_in(argument.substr(name.size() + 1)),
                          std::make_unique<ros2::Writer>(participant, topic, messages::Qos(), nullptr),
                          {}});
  }
  const auto has_subscriber = [](const Publisher& publisher) { return publisher.has_subscriber(); };
  while (!std::all_of(publishers.begin(), publishers.end(), has_subscriber)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  for (int round = std::atoi(argv[1]); round > 0; --round) {
    for (Publisher& publisher : publishers) {
      const Clock::time_point begin = Clock::now();
      ros2::write(**publisher.writer, publisher.message);
      publisher.times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  for (Publisher& publisher : publishers) std::printf("%s %f\n", publisher.type.c_str(), median(publisher.times));
  return 0;
}
