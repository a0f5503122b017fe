// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.FrameMemory and FrameReader: frames for other processes.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "bubblesim/frame_memory.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

py::object head_of(FrameReader& reader) {
  const std::optional<FrameHead> head = reader.head();
  if (!head) return py::none();
  return py::make_tuple(head->count, head->revision, head->notices, head->time, head->state, head->closed != 0);
}

/// The bytes that the page of the window reads: 0 and count (uint32 each), simulation time and time of writing (float64
/// each), revision, state, links, axes (uint32 each); then 7 float32 for each link, and one for each axis.
py::object packed(FrameReader& reader) {
  struct Packed {
    std::uint32_t zero, count;
    double time, written;
    std::uint32_t revision, state, links, axes;
  };
  static_assert(sizeof(Packed) == 40);
  const auto copy = reader.read();
  if (!copy) return py::none();
  const FrameHead& head = copy->head;
  const Packed first{0,
                     static_cast<std::uint32_t>(head.count),
                     head.time,
                     head.written,
                     static_cast<std::uint32_t>(head.revision),
                     head.state,
                     head.links,
                     head.axes};
  const std::size_t numbers = copy->numbers.size();
  std::string bytes(sizeof first + 4 * numbers, '\0');
  bytes.replace(0, sizeof first, reinterpret_cast<const char*>(&first), sizeof first);
  bytes.replace(sizeof first, 4 * numbers, reinterpret_cast<const char*>(copy->numbers.data()), 4 * numbers);
  return py::bytes(bytes);
}

}  // namespace

void bind_frame_memory(py::module_& module) {
  py::class_<FrameMemory>(module, "FrameMemory", "Frames for other processes; see Runner.share_frames.")
      .def_property_readonly("path", &FrameMemory::path, "Where processes of the same user open it.")
      .def("notice", &FrameMemory::notice, "Count something that readers should ask for.");
  py::class_<FrameReader>(module, "FrameReader", "Reads the frames of another process, by the path of its memory.")
      .def(py::init<const std::string&>(), py::arg("path"))
      .def("head", &head_of, "Return (count, revision, notices, time, state, closed), or None for now.")
      .def("packed", &packed,
           "Return the last frame as bytes, or None for now: uint32 0 and count, float64 simulation time and time of\n"
           "writing (monotonic), uint32 revision, state, links, axes, then float32 poses (x, y, z, quaternion x, y,\n"
           "z, w) and joint positions.");
}

}  // namespace bubblesim::bindings
