// SPDX-License-Identifier: BSD-3-Clause
// The devices of bubblesim._core that push links: propellers, wings, drag, buoyancy and the wind.
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/buoyancy.hpp"
#include "bubblesim/drag.hpp"
#include "bubblesim/lift_drag.hpp"
#include "bubblesim/multicopter_velocity_control.hpp"
#include "bubblesim/rotor.hpp"
#include "bubblesim/wind.hpp"
#include "devices/attached.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

void bind_wind(py::module_& module) {
  using Air = Attached<Wind>;
  py::class_<Air> wind(module, "Wind",
                       "The wind of a simulation, the same everywhere: simulation.wind. It pushes links with\n"
                       "<enable_wind> by mass * force_factor * (wind - velocity), and rotors, wings and drag use it.");
  Guarded(wind)
      .def_property_readonly(
          "velocity", [](const Air& w) { return to_numpy(w.device->velocity()); },
          "m/s, world axes: of the last physics substep.")
      .def_property(
          "mean", [](const Air& w) { return to_numpy(w.device->mean()); },
          [](Air& w, const NumpyArray& mean) { w.device->set_mean(to_vector(mean, "mean")); },
          "m/s, world axes; until the next reset.")
      .def_property(
          "force_factor", [](const Air& w) { return w.device->force_factor(); },
          [](Air& w, double factor) { w.device->set_force_factor(factor); }, "1/s.")
      .def(
          "vary",
          [](Air& w, double rise_time, double sine_part, double sine_period, double speed_noise, double turn_time,
             double turn_sine, double turn_period, double turn_noise, double vertical_rise_time,
             double vertical_noise) {
            w.device->set_variation({rise_time, sine_part, sine_period, speed_noise, turn_time, turn_sine, turn_period,
                                     turn_noise, vertical_rise_time, vertical_noise});
          },
          py::kw_only(), py::arg("rise_time") = 1.0, py::arg("sine_part") = 0.0, py::arg("sine_period") = 1.0,
          py::arg("speed_noise") = 0.0, py::arg("turn_time") = 1.0, py::arg("turn_sine") = 0.0,
          py::arg("turn_period") = 1.0, py::arg("turn_noise") = 0.0, py::arg("vertical_rise_time") = 1.0,
          py::arg("vertical_noise") = 0.0,
          R"(Let the wind rise from 0 and vary about its mean, as gz-sim's WindEffects.

:param rise_time: s, time constant of the horizontal speed; vertical_rise_time: of the vertical wind; turn_time: of the
    direction.
:param sine_part: amplitude of a sine as a part of the speed, with the period sine_period in s; turn_sine, in rad, and
    turn_period: the same of the direction.
:param speed_noise: standard deviation, m/s; vertical_noise: of the vertical wind; turn_noise: of the direction, rad.
    New in each physics substep.)");
}

void bind_rotor(py::module_& module) {
  using Turning = Attached<Rotor>;
  py::class_<Turning> rotor(module, "Rotor",
                            "A propeller with the thrust k w |w| along the axis of its joint, a reaction torque, drag\n"
                            "across the axis and a first-order response: Gazebo's multicopter motor model.");
  const RotorDescription usual;
  rotor.def(py::init([](Simulation& simulation, ObjectId joint, bool clockwise, double thrust_coefficient,
                        double torque_length, double drag_coefficient, double rolling_coefficient, double max_speed,
                        double time_up, double time_down, double slowdown) {
              const RotorDescription description{
                  joint,     clockwise, thrust_coefficient, torque_length, drag_coefficient, rolling_coefficient,
                  max_speed, time_up,   time_down,          slowdown};
              return attach_to_model_of<Rotor>(joint, simulation, [&](World& world) {
                return std::make_unique<Rotor>(world, description, simulation.wind());
              });
            }),
            py::arg("simulation"), py::arg("joint"), py::arg("clockwise") = false, py::kw_only(),
            py::arg("thrust_coefficient") = usual.thrust_coefficient, py::arg("torque_length") = usual.torque_length,
            py::arg("drag_coefficient") = usual.drag_coefficient,
            py::arg("rolling_coefficient") = usual.rolling_coefficient, py::arg("max_speed") = usual.max_speed,
            py::arg("time_up") = usual.time_up, py::arg("time_down") = usual.time_down,
            py::arg("slowdown") = usual.slowdown, py::keep_alive<1, 2>(),
            R"(Add it to a simulation.

:param joint: handle of a revolute or continuous joint; its child is the propeller.
:param clockwise: turns clockwise seen from where the thrust points.
:param thrust_coefficient: N s^2.
:param torque_length: m, reaction torque divided by thrust.
:param drag_coefficient: kg: the drag is this times the speed in rad/s and the velocity across the axis relative to the
    wind; rolling_coefficient, kg m: the same for the rolling moment.
:param max_speed: rad/s.
:param time_up: s, time constant of rising speed; time_down: of falling speed.
:param slowdown: the joint turns this many times slower than the propeller.)");
  Guarded(rotor)
      .def(
          "set_speed", [](Turning& r, double speed) { r.device->set_speed(speed); }, py::arg("speed"),
          "Command the speed in rad/s. A target velocity of the joint, times slowdown, is a command too.")
      .def_property_readonly(
          "speed", [](const Turning& r) { return r.device->speed(); }, "rad/s, after the first-order response.")
      .def("remove", &Turning::remove, "Remove it from the simulation.");
}

void bind_velocity_control(py::module_& module) {
  using Control = Attached<MulticopterVelocityControl>;
  py::class_<Control> control(module, "MulticopterVelocityControl",
                              "Flies an airframe with rotors at a velocity along its own axes and a yaw rate, in each\n"
                              "physics substep: gz-sim's controller (Lee, Leok, McClamroch, CDC 2010).");
  control.def(py::init([](Simulation& simulation, ObjectId link, const std::vector<Attached<Rotor>*>& rotors,
                          const Numbers3& velocity_gain, const Numbers3& attitude_gain, const Numbers3& rate_gain,
                          const Numbers3& max_acceleration) {
                const VelocityControlDescription description{link, to_vector3(velocity_gain), to_vector3(attitude_gain),
                                                             to_vector3(rate_gain), to_vector3(max_acceleration)};
                std::vector<std::shared_ptr<Rotor>> devices;
                for (const Attached<Rotor>* rotor : rotors) devices.push_back(rotor->device);
                return attach_to_model_of<MulticopterVelocityControl>(link, simulation, [&](World& world) {
                  return std::make_unique<MulticopterVelocityControl>(world, description, std::move(devices));
                });
              }),
              py::arg("simulation"), py::arg("link"), py::arg("rotors"), py::kw_only(), py::arg("velocity_gain"),
              py::arg("attitude_gain"), py::arg("rate_gain"), py::arg("max_acceleration") = Numbers3{1e9, 1e9, 1e9},
              py::keep_alive<1, 2>(),
              R"(Add it to a simulation.

:param link: handle of the airframe.
:param rotors: Rotors of the same model.
:param velocity_gain: N s/m along the world's axes; attitude_gain: N m/rad about those of the link; rate_gain: N m s/rad.
:param max_acceleration: m/s^2 along the world's axes.)");
  Guarded(control)
      .def(
          "set_velocity",
          [](Control& c, const Numbers3& linear, double yaw_rate) {
            c.device->set_velocity(to_vector3(linear), yaw_rate);
          },
          py::arg("linear"), py::arg("yaw_rate") = 0.0, "m/s along the link's axes, rad/s about its z.")
      .def(
          "stop", [](Control& c) { c.device->stop(); }, "Stop the rotors, until the next command.")
      .def("remove", &Control::remove, "Remove it from the simulation.");
}

void bind_lift_drag(py::module_& module) {
  using Wing = Attached<LiftDrag>;
  py::class_<Wing> wing(module, "LiftDrag",
                        "A wing: lift and drag with coefficients proportional to the angle of attack, and a stall.\n"
                        "Formulas of Gazebo's LiftDrag.");
  const LiftDragDescription usual;
  wing.def(py::init([](Simulation& simulation, ObjectId link, double area, double density,
                       const Numbers3& centre_of_pressure, const Numbers3& forward, const Numbers3& upward,
                       bool radial_symmetry, double alpha0, double lift_slope, double drag_slope, double alpha_stall,
                       double lift_slope_stall, double drag_slope_stall, ObjectId control_joint, double control_slope) {
             const LiftDragDescription description{link,
                                                   area,
                                                   density,
                                                   to_vector3(centre_of_pressure),
                                                   to_vector3(forward),
                                                   to_vector3(upward),
                                                   radial_symmetry,
                                                   alpha0,
                                                   lift_slope,
                                                   drag_slope,
                                                   alpha_stall,
                                                   lift_slope_stall,
                                                   drag_slope_stall,
                                                   control_joint,
                                                   control_slope};
             return attach_to_model_of<LiftDrag>(link, simulation, [&](World& world) {
               return std::make_unique<LiftDrag>(world, description, simulation.wind());
             });
           }),
           py::arg("simulation"), py::arg("link"), py::kw_only(), py::arg("area") = usual.area,
           py::arg("density") = usual.density, py::arg("centre_of_pressure") = Numbers3{0, 0, 0},
           py::arg("forward") = Numbers3{1, 0, 0}, py::arg("upward") = Numbers3{0, 0, 1},
           py::arg("radial_symmetry") = false, py::arg("alpha0") = usual.alpha0,
           py::arg("lift_slope") = usual.lift_slope, py::arg("drag_slope") = usual.drag_slope,
           py::arg("alpha_stall") = usual.alpha_stall, py::arg("lift_slope_stall") = usual.lift_slope_stall,
           py::arg("drag_slope_stall") = usual.drag_slope_stall, py::arg("control_joint") = kNoObject,
           py::arg("control_slope") = usual.control_slope, py::keep_alive<1, 2>(),
           R"(Add it to a simulation. Vectors are in the link's frame; handles are those of objects.

:param area: m^2; density: kg/m^3, of the air; centre_of_pressure: m.
:param forward: direction of the chord; upward: of the lift.
:param radial_symmetry: about forward; upward follows the flow.
:param alpha0: rad, angle of attack when the air flows along forward.
:param lift_slope: 1/rad, lift coefficient divided by the angle of attack; drag_slope: of the drag.
:param alpha_stall: rad; lift_slope_stall, drag_slope_stall: the slopes beyond it.
:param control_joint: of a flap, -1 for none; control_slope: change of the lift coefficient by its position, 1/rad.)");
  Guarded(wing).def("remove", &Wing::remove, "Remove it from the simulation.");
}

void bind_drag(py::module_& module) {
  using Resisted = Attached<Drag>;
  py::class_<Resisted> drag(
      module, "Drag",
      "Linear and quadratic drag along and about the axes of a link:\n"
      "force = -linear v - quadratic |v| v, v being the velocity of the link's origin relative to\n"
      "the fluid, and torque alike (Fossen, Guidance and control of ocean vehicles, 1994).");
  drag.def(py::init([](Simulation& simulation, ObjectId link, const Numbers3& linear, const Numbers3& quadratic,
                       const Numbers3& angular_linear, const Numbers3& angular_quadratic, bool in_wind) {
             const DragDescription description{link,
                                               to_vector3(linear),
                                               to_vector3(quadratic),
                                               to_vector3(angular_linear),
                                               to_vector3(angular_quadratic),
                                               in_wind};
             return attach_to_model_of<Drag>(link, simulation, [&](World& world) {
               return std::make_unique<Drag>(world, description, simulation.wind());
             });
           }),
           py::arg("simulation"), py::arg("link"), py::kw_only(), py::arg("linear") = Numbers3{},
           py::arg("quadratic") = Numbers3{}, py::arg("angular_linear") = Numbers3{},
           py::arg("angular_quadratic") = Numbers3{}, py::arg("in_wind") = true, py::keep_alive<1, 2>(),
           R"(Add it to a simulation.

:param link: its handle.
:param linear: N s/m along its x, y and z; quadratic: N s^2/m^2.
:param angular_linear: N m s about its x, y and z; angular_quadratic: N m s^2.
:param in_wind: whether the fluid moves with the wind.)");
  Guarded(drag)
      .def(
          "set_current", [](Resisted& d, const Numbers3& current) { d.device->set_current(to_vector3(current)); },
          py::arg("current"), "Set the velocity of the fluid in m/s, world axes, until the next reset.")
      .def("remove", &Resisted::remove, "Remove it from the simulation.");
}

void bind_buoyancy(py::module_& module) {
  using Floating = Attached<Buoyancy>;
  using Layers = std::vector<std::pair<double, double>>;
  py::class_<Floating> buoyancy(
      module, "Buoyancy",
      "The weight of the fluids that the collision shapes of links displace, at the centroid\n"
      "of the displaced volume (Archimedes). Without drag and added mass.");
  buoyancy.def(
      py::init([](Simulation& simulation, double density, const Layers& layers, std::vector<std::string> paths) {
        std::vector<FluidLayer> fluids;
        for (const auto& [above, layer_density] : layers) fluids.push_back({above, layer_density});
        auto device = std::make_shared<Buoyancy>(density, std::move(fluids), std::move(paths));
        return attach(simulation.world(), std::move(device), kNoObject, 0);
      }),
      py::arg("simulation"), py::arg("density") = 1000.0, py::kw_only(), py::arg("layers") = Layers{},
      py::arg("paths") = std::vector<std::string>{}, py::keep_alive<1, 2>(),
      R"(Add it to a simulation.

:param density: kg/m^3, of the fluid below all layers.
:param layers: world z in m above which a layer begins, and its density, from the lowest to the highest. A lake with
    its surface at z = 0: [(0.0, 1.2)].
:param paths: of the models and links that it acts on, also if they are added later; empty: all.)");
  Guarded(buoyancy)
      .def(
          "set_volume",
          [](Floating& b, ObjectId link, double volume, const Numbers3& centre) {
            b.device->set_volume(b.world, link, volume, to_vector3(centre));
          },
          py::arg("link"), py::arg("volume"), py::arg("centre"),
          "Replace the collision shapes of a link by a volume in m^3 at a point in the link's frame.")
      .def("remove", &Floating::remove, "Remove it from the simulation.");
}

}  // namespace

void bind_forces(py::module_& module) {
  bind_wind(module);
  bind_rotor(module);
  bind_velocity_control(module);
  bind_lift_drag(module);
  bind_drag(module);
  bind_buoyancy(module);
}

}  // namespace bubblesim::bindings
