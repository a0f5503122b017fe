// SPDX-License-Identifier: BSD-3-Clause
#include "world/bind_contacts.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "guarded.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {

namespace py = pybind11;

void bind_contacts(py::class_<World>& world) {
  Guarded(world)
      .def(
          "contact_points",
          [](const World& w) {
            py::list points;
            for (const TouchPoint& point : w.measurements().contact_points()) {
              const Vector3& at = point.position;
              points.append(py::make_tuple(at.x(), at.y(), at.z(), point.normal_force));
            }
            return points;
          },
          "Return x, y, z (m) and the normal force (N) of each contact point of the last physics substep.")
      .def(
          "contact_point",
          [](const World& w, std::size_t index, const std::vector<ObjectId>& links) -> py::object {
            const auto is_one = [&links](ObjectId link) {
              return std::find(links.begin(), links.end(), link) != links.end();
            };
            for (TouchPoint point : w.measurements().contact_points()) {
              if (!links.empty() && !is_one(point.first)) {
                if (!is_one(point.second)) continue;
                std::swap(point.first, point.second);
                point.normal = -point.normal;
                point.force = -point.force;
              }
              if (index-- > 0) continue;
              return py::make_tuple(point.first, point.second, to_list(point.position), to_list(point.force),
                                    to_list(point.normal));
            }
            return py::none();
          },
          py::arg("index"), py::arg("links"),
          "Return the contact point with an index from 0 among those of some links, or of all if none are given: the "
          "link, the other link, the position (m), the force on the link (N) and the direction in which the other one "
          "pushes it; None behind the last.");
}

}  // namespace bubblesim::bindings
