// SPDX-License-Identifier: BSD-3-Clause
// The devices of bubblesim._core, which are called before physics substeps.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/grasp.hpp"
#include "bubblesim/joint_ramps.hpp"
#include "bubblesim/planar_drive.hpp"
#include "bubblesim/planar_force_drive.hpp"
#include "bubblesim/spatial_drive.hpp"
#include "bubblesim/timed_efforts.hpp"
#include "bubblesim/wheel_slip.hpp"
#include "devices/attached.hpp"
#include "devices/number_target.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

void bind_timed_efforts(py::module_& module) {
  using Efforts = Attached<TimedEfforts>;
  py::class_<Efforts> efforts(module, "TimedEfforts",
                              "Wrenches on links and efforts on joints during intervals of simulation time.");
  efforts.def(py::init([](World& world) { return attach(world, std::make_shared<TimedEfforts>(), kNoObject, 0); }),
              py::arg("world"), py::keep_alive<1, 2>());
  Guarded(efforts)
      .def(
          "add_wrench",
          [](Efforts& e, ObjectId link, const Numbers3& force, const Numbers3& torque,
             const std::optional<Numbers3>& point, double start, double duration) {
            e.device->add_wrench(e.world, link, {to_vector3(force), to_vector3(torque)},
                                 point ? std::make_optional(to_vector3(*point)) : std::nullopt, {start, duration});
          },
          py::arg("link"), py::arg("force"), py::arg("torque"), py::arg("point"), py::arg("start"), py::arg("duration"),
          "Apply a wrench in world axes at a point of the link, None for its centre of mass; s of simulation time, a "
          "negative duration until it is cleared.")
      .def(
          "add_effort",
          [](Efforts& e, ObjectId joint, double effort, double start, double duration) {
            e.device->add_effort(e.world, joint, effort, {start, duration});
          },
          py::arg("joint"), py::arg("effort"), py::arg("start"), py::arg("duration"),
          "Push the links of a joint along its first axis, within the force limit of its motor.")
      .def("clear_wrenches", [](Efforts& e, ObjectId link) { e.device->clear_wrenches(link); })
      .def("clear_efforts", [](Efforts& e, ObjectId joint) { e.device->clear_efforts(joint); });
}

void bind_joint_ramps(py::module_& module) {
  py::class_<NumberTarget>(module, "NumberTarget", "Takes the numbers of messages; see Bridge.subscribe_numbers().")
      .def(
          "__call__",
          [](const NumberTarget& target, const std::vector<double>& numbers) { return target.take(numbers); },
          py::arg("numbers"), "Take numbers; return whether they were usable.");
  using Ramps = Attached<JointRamps>;
  using Output = std::tuple<ObjectId, MotorMode, std::vector<double>>;
  py::class_<Ramps> ramps(module, "JointRamps", "Targets of joints that follow inputs at limited rates.");
  ramps.def(py::init([](World& world, ObjectId model, double rate, std::vector<double> rates,
                        const std::vector<Output>& outputs) {
              std::vector<JointRamps::Output> all;
              for (const auto& [joint, mode, factors] : outputs) all.push_back({joint, mode, factors});
              return attach(world, std::make_shared<JointRamps>(std::move(rates), std::move(all)), model, rate);
            }),
            py::arg("world"), py::arg("model"), py::arg("rate"), py::arg("rates"), py::arg("outputs"),
            py::keep_alive<1, 2>(),
            R"(Add it to a world.

:param rate: Hz, 0 for each physics substep.
:param rates: how fast each input may change, per s; infinite without a limit.
:param outputs: joint, MotorMode of its target, and a factor for each input.)");
  Guarded(ramps)
      .def(
          "set_targets", [](Ramps& r, std::vector<double> targets) { r.device->set_targets(std::move(targets)); },
          py::arg("targets"), "Set the targets of the inputs.")
      .def(
          "commands",
          [](Ramps& r, const std::vector<std::pair<std::vector<double>, double>>& rows, double most) {
            CommandMix mix{{}, most};
            for (const auto& [factors, divisor] : rows) mix.rows.push_back({factors, divisor});
            return NumberTarget{[&world = r.world, device = r.device, mix = std::move(mix)](const auto& commands) {
              std::optional<std::vector<double>> targets = mix.inputs(commands);
              if (!targets) return false;
              const AccessLock::Hold hold(world.access());
              device->set_targets(std::move(*targets));
              return true;
            }};
          },
          py::arg("rows"), py::arg("most"), py::keep_alive<0, 1>(),
          R"(Return a NumberTarget that sets the targets from commands.

:param rows: for each input the factors of the commands, and a divisor of their sum.
:param most: larger commands are not usable; larger inputs are scaled down together.)")
      .def(
          "stop", [](Ramps& r) { r.device->stop(); }, "Set inputs and targets to zero, without commanding the joints.")
      .def("remove", &Ramps::remove, "Remove it from the world.");
}

/// What the drives in the plane have in common.
template <class Kind>
void bind_planar_commands(py::class_<Attached<Kind>>& drive) {
  using Drive = Attached<Kind>;
  Guarded(drive)
      .def(
          "set_velocity",
          [](Drive& d, double forward, double leftward, double turning) {
            d.device->set_velocity(forward, leftward, turning);
          },
          py::arg("forward"), py::arg("leftward"), py::arg("turning"), "m/s and rad/s.")
      .def("remove", &Drive::remove, "Remove it from the world.");
}

void bind_planar_drives(py::module_& module) {
  py::class_<Attached<PlanarDrive>> drive(module, "PlanarDrive", "Moves a model at a velocity along its own axes.");
  drive.def(py::init([](World& world, ObjectId model) {
              return attach(world, std::make_shared<PlanarDrive>(model), model, 0);
            }),
            py::arg("world"), py::arg("model"), py::keep_alive<1, 2>());
  bind_planar_commands(drive);

  py::class_<Attached<PlanarForceDrive>> force_drive(module, "PlanarForceDrive",
                                                     "Pushes a link by forces towards a velocity along its own axes.");
  force_drive.def(
      py::init([](Simulation& simulation, ObjectId link, double forward, double leftward, double turning) {
        return attach_to_model_of<PlanarForceDrive>(link, simulation, [&](const World& world) {
          return std::make_shared<PlanarForceDrive>(world, link, PlanarForceDrive::Gains{forward, leftward, turning});
        });
      }),
      py::arg("simulation"), py::arg("link"), py::arg("forward"), py::arg("leftward"), py::arg("turning"),
      py::keep_alive<1, 2>(), "The gains are in N s/m and N m s.");
  bind_planar_commands(force_drive);
}

void bind_spatial_drive(py::module_& module) {
  using Drive = Attached<SpatialDrive>;
  py::class_<Drive> drive(module, "SpatialDrive", "Gives a model or a link a velocity along its own axes.");
  drive.def(py::init([](Simulation& simulation, ObjectId object) {
              return attach_to_model_of<SpatialDrive>(object, simulation, [&](const World& world) {
                return std::make_shared<SpatialDrive>(world, object);
              });
            }),
            py::arg("simulation"), py::arg("object"), py::keep_alive<1, 2>());
  Guarded(drive)
      .def(
          "set_velocity",
          [](Drive& d, const Numbers3& linear, const Numbers3& angular) {
            d.device->set_velocity({to_vector3(linear), to_vector3(angular)});
          },
          py::arg("linear"), py::arg("angular"), "m/s and rad/s along the object's axes, before each substep.")
      .def("remove", &Drive::remove, "Remove it from the world.");
}

void bind_wheel_slip(py::module_& module) {
  using Slip = Attached<WheelSlip>;
  using Wheel = std::tuple<ObjectId, double, double, double, double>;
  py::class_<Slip> slip(module, "WheelSlip", "Wheels whose tyres slip in proportion to the friction.");
  slip.def(py::init([](Simulation& simulation, const std::vector<Wheel>& wheels) {
             std::vector<SlippingWheel> described;
             for (const auto& [joint, radius, force, lateral, longitudinal] : wheels) {
               described.push_back({joint, radius, force, {lateral, longitudinal}});
             }
             const ObjectId first = described.empty() ? kNoObject : described.front().joint;
             return attach_to_model_of<WheelSlip>(first, simulation, [&](const World& world) {
               return std::make_shared<WheelSlip>(world, std::move(described));
             });
           }),
           py::arg("simulation"), py::arg("wheels"), py::keep_alive<1, 2>(),
           R"(Add it to a simulation.

:param wheels: of a model; the joint of each, its radius in m, normal force in N, lateral and longitudinal compliance:
    slip ratio divided by the ratio of friction and normal force.)");
  Guarded(slip)
      .def(
          "set_compliance",
          [](Slip& s, std::optional<double> lateral, std::optional<double> longitudinal) {
            s.device->set_compliance(lateral, longitudinal);
          },
          py::arg("lateral") = py::none(), py::arg("longitudinal") = py::none(),
          "Of all wheels, until the next reset; None stays as it is.")
      .def(
          "slip", [](const Slip& s, std::size_t wheel) { return to_numpy(s.device->slip(s.world, wheel)); },
          py::arg("wheel"),
          "Return for a wheel, by its number, m/s: its velocity ahead less that of its circumference, its velocity\n"
          "along its axis, and that of its circumference.")
      .def("remove", &Slip::remove, "Remove it from the simulation.");
}

void bind_grasp(py::module_& module) {
  using Gripper = Attached<Grasp>;
  py::class_<Gripper> grasp(module, "Grasp", "Attaches objects to a palm while fingers press them.");
  grasp.def(py::init([](Simulation& simulation, ObjectId palm, std::vector<ObjectId> fingers, double rate,
                        int min_contacts, std::optional<double> min_angle, int attach_updates, int detach_updates,
                        std::optional<double> slack) {
              World& world = simulation.world();
              const HoldWithGil hold(world.access());
              GraspDescription described{palm,           std::move(fingers), min_contacts, min_angle,
                                         attach_updates, detach_updates,     slack};
              return attach(world, std::make_shared<Grasp>(world, std::move(described)),
                            world.tree().outermost_model_of(palm), rate);
            }),
            py::arg("simulation"), py::arg("palm"), py::arg("fingers"), py::arg("rate") = 0.0, py::kw_only(),
            py::arg("min_contacts") = 2, py::arg("min_angle") = py::none(), py::arg("attach_updates") = 20,
            py::arg("detach_updates") = 40, py::arg("slack") = py::none(), py::keep_alive<1, 2>(),
            R"(Add it to a simulation.

:param palm: link to which an object is attached; fingers: links that press it.
:param rate: Hz of its updates, 0 for each physics substep.
:param min_contacts: contact points of the fingers with the object; min_angle: rad, between the forces of two fingers.
:param attach_updates: it is attached after more updates in which it is pressed; detach_updates: and detached after more
    in which it is not, with slack, m, only if a finger has moved away by more than that.)");
  Guarded(grasp)
      .def_property_readonly(
          "attached", [](const Gripper& g) { return g.device->attached(); }, "The link that is attached, or -1.")
      .def("remove", &Gripper::remove, "Remove it from the simulation.");
}

/// Calls a Python function before each substep. Made, called and destroyed in threads that may not hold the GIL.
class SubstepCall : public Device {
 public:
  explicit SubstepCall(py::function function)
      : function_(new py::function(std::move(function)), [](const py::function* held) {
          const py::gil_scoped_acquire gil;
          delete held;
        }) {}

  void update(World&, double time, double duration) override {
    const py::gil_scoped_acquire gil;
    try {
      (*function_)(time, duration);
    } catch (const py::error_already_set& error) {  // which must not leave the GIL
      throw std::runtime_error(std::string("a function that is called before substeps failed: ") + error.what());
    }
  }

 private:
  std::shared_ptr<const py::function> function_;
};

ContactFilter contact_filter(py::function function) {
  const std::shared_ptr<const py::function> held(new py::function(std::move(function)), [](const py::function* last) {
    const py::gil_scoped_acquire gil;
    delete last;
  });
  return [held](ObjectId first, ObjectId second) -> ContactAnswer {
    const py::gil_scoped_acquire gil;
    try {
      const py::object answer = (*held)(first, second);
      if (!py::isinstance<py::tuple>(answer)) return {answer.cast<bool>(), std::nullopt};
      const auto [resist, friction] = answer.cast<std::pair<bool, std::optional<double>>>();
      return {resist, friction && *friction >= 0 ? friction : std::nullopt};
    } catch (py::error_already_set& error) {
      error.discard_as_unraisable("a contact filter");
    } catch (const py::cast_error&) {  // another answer
    }
    return {};
  };
}

void bind_substep_calls(py::module_& module) {
  using Call = Attached<SubstepCall>;
  py::class_<Call> call(module, "SubstepCall",
                        "A function that is called with the time, s, and the duration of each physics substep before\n"
                        "it. It slows the simulation: devices in C++ do not.");
  call.def(py::init([](World& world, py::function function) {
             return attach(world, std::make_shared<SubstepCall>(std::move(function)), kNoObject, 0);
           }),
           py::arg("world"), py::arg("function"), py::keep_alive<1, 2>());
  Guarded(call).def("remove", &Call::remove, "Remove it from the world.");
  Guarded(module).def(
      "set_contact_filter",
      [](World& world, const std::optional<py::function>& function) {
        world.devices().set_contact_filter(function ? contact_filter(*function) : ContactFilter());
      },
      py::arg("world"), py::arg("function"),
      "Let a function of two links decide, in each substep in which they touch, whether they resist each other; a\n"
      "static link comes second. It returns that, or a tuple of that and of a coefficient of friction, >= 0, in place\n"
      "of the surfaces' own (None: their own). None removes it.");
}

}  // namespace

void bind_devices(py::module_& module) {
  bind_timed_efforts(module);
  bind_joint_ramps(module);
  bind_planar_drives(module);
  bind_spatial_drive(module);
  bind_wheel_slip(module);
  bind_grasp(module);
  bind_substep_calls(module);
}

}  // namespace bubblesim::bindings
