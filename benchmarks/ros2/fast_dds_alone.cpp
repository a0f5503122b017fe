// SPDX-License-Identifier: BSD-3-Clause
// Fast DDS with ready bytes, for publish.py: set up as in the node, but without messages, bridge and Python. It has a
// participant of its own, and runs in the process of the node, where the caches are as cold as they are for the node.
#include <pybind11/pybind11.h>

#include <chrono>
#include <memory>
#include <string>

#include "bubblesim/messages/registry.hpp"
#include "graph/names.hpp"

namespace {

using namespace bubblesim;
using Clock = std::chrono::steady_clock;

ros2::Participant& participant() {
  static ros2::Participant alone(ros2::read_environment());
  return alone;
}

class Publisher {
 public:
  /// `cdr`: a message of `type`, such as std_msgs/Float32, without its header.
  Publisher(const std::string& topic, const std::string& type, const pybind11::bytes& cdr) {
    const auto& found = ros2::listed(messages::find_message(type, messages::RosVersion::kRos2), type.c_str());
    const std::string_view bytes = cdr;
    message_.begin(messages::Layout::kCdr);
    message_.put_bytes(bytes.data(), bytes.size());
    writer_ =
        std::make_unique<ros2::Writer>(participant(), ros2::message_topic(topic, found), messages::Qos(), nullptr);
  }

  bool has_subscriber() const {
    ros2::dds::PublicationMatchedStatus status;
    (**writer_).get_publication_matched_status(status);
    return status.current_count > 0;
  }

  /// Returns the seconds that the write took.
  double write() {
    const Clock::time_point begin = Clock::now();
    ros2::write(**writer_, message_);
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

 private:
  messages::WireBuffer message_;
  std::unique_ptr<ros2::Writer> writer_;
};

}  // namespace

PYBIND11_MODULE(fast_dds_alone, module) {
  pybind11::class_<Publisher>(module, "Publisher")
      .def(pybind11::init<const std::string&, const std::string&, const pybind11::bytes&>())
      .def("has_subscriber", &Publisher::has_subscriber)
      .def("write", &Publisher::write);
}
