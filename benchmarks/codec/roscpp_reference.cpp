// SPDX-License-Identifier: BSD-3-Clause
// Timed loops for codec.py: bubblesim's codec and roscpp's serialization, both called from C++ to exclude the cost of
// Python calls. Each function returns the time of `count` conversions in seconds.
#include <nav_msgs/Odometry.h>
#include <pybind11/pybind11.h>
#include <ros/serialization.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <chrono>
#include <string>

#include "bubblesim/messages/registry.hpp"
#include "message_codec.hpp"

namespace {

namespace py = pybind11;
namespace ser = ros::serialization;
using bubblesim::messages::WireBuffer;
using bubblesim::messages::WireView;

template <class Action>
double timed(int count, Action action) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < count; ++i) action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

WireView view_of(const py::bytes& data) {
  char* bytes = nullptr;
  Py_ssize_t size = 0;
  PyBytes_AsStringAndSize(data.ptr(), &bytes, &size);
  return {reinterpret_cast<const std::uint8_t*>(bytes), static_cast<std::size_t>(size)};
}

/// dict -> bytes in roscpp's format: length prefix, then the message.
double encode_seconds(const std::string& type_name, const py::dict& message, int count) {
  const auto* type = bubblesim::messages::find_message(type_name);
  return timed(count, [&] {
    WireBuffer out;
    bubblesim::bindings::encode(*type, message.ptr(), out);
    out.release();
  });
}

double decode_seconds(const std::string& type_name, const py::bytes& data, int count) {
  const auto* type = bubblesim::messages::find_message(type_name);
  return timed(count, [&] { bubblesim::bindings::decode(*type, view_of(data)); });
}

template <class Message>
double roscpp_encode(const py::bytes& data, int count) {
  Message message;
  WireView bytes = view_of(data);
  const std::size_t size = bytes.left();
  ser::IStream stream(const_cast<std::uint8_t*>(bytes.take(size)), static_cast<std::uint32_t>(size));
  ser::deserialize(stream, message);
  return timed(count, [&] { ser::serializeMessage(message); });
}

double roscpp_encode_seconds(const std::string& type_name, const py::bytes& data, int count) {
  if (type_name == "sensor_msgs/Image") return roscpp_encode<sensor_msgs::Image>(data, count);
  if (type_name == "sensor_msgs/PointCloud2") return roscpp_encode<sensor_msgs::PointCloud2>(data, count);
  if (type_name == "nav_msgs/Odometry") return roscpp_encode<nav_msgs::Odometry>(data, count);
  throw py::value_error("no roscpp reference for " + type_name);
}

}  // namespace

PYBIND11_MODULE(roscpp_reference, m) {
  bubblesim::bindings::init_message_codec();
  m.def("encode_seconds", &encode_seconds);
  m.def("decode_seconds", &decode_seconds);
  m.def("roscpp_encode_seconds", &roscpp_encode_seconds);
}
