// SPDX-License-Identifier: BSD-3-Clause
// The controllers of ros_control: bubblesim._core.control.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/control/base_controllers.hpp"
#include "bubblesim/control/joint_controllers.hpp"
#include "bubblesim/control/omnidirectional_controllers.hpp"
#include "bubblesim/control/trajectory_controller.hpp"
#include "bubblesim/error.hpp"
#include "devices/attached.hpp"
#include "devices/number_target.hpp"

namespace bubblesim::bindings {

/// A controller of a manager that Python added to a world.
template <class Kind>
struct Loaded {
  World& world;
  std::shared_ptr<Kind> controller;
};

template <class Kind>
AccessLock& lock_of(const Loaded<Kind>& loaded) {
  return loaded.world.access();
}

namespace {

namespace py = pybind11;
using namespace control;  // NOLINT(google-build-using-namespace): all of it is bound here

using Manager = Attached<ControllerManager>;
using Numbers = std::vector<double>;
using JointTuple = std::tuple<std::string, ObjectId, CommandInterface, std::optional<PidGains>>;
using KnotTuple = std::tuple<double, double, std::optional<double>, std::optional<double>>;
using Range = std::optional<std::pair<double, double>>;

Manager make_manager(World& world, ObjectId model, const std::vector<JointTuple>& joints) {
  std::vector<ControlledJoint> controlled;
  for (const auto& [name, id, interface, gains] : joints) {
    ControlledJoint joint;
    joint.name = name;
    joint.id = id;
    joint.interface = interface;
    if (gains) joint.pid.emplace(*gains);
    controlled.push_back(std::move(joint));
  }
  const HoldWithGil hold(world.access());
  auto manager = std::make_shared<ControllerManager>(RobotHardware(world, std::move(controlled)));
  world.devices().add(manager, model);
  return {world, std::move(manager)};
}

/// A class of controllers, which a manager makes with `make`.
template <class Kind, class... Arguments>
py::class_<Loaded<Kind>> bind_controller(py::module_& module, const char* name, const char* text) {
  py::class_<Loaded<Kind>> kind(module, name, text);
  kind.def(py::init([](const Manager& manager, Arguments... arguments) {
             return Loaded<Kind>{manager.world, std::make_shared<Kind>(std::move(arguments)...)};
           }),
           py::keep_alive<1, 2>());
  Guarded(kind)
      .def("start", [](const Loaded<Kind>& loaded, Manager& manager) { manager.device->start(loaded.controller); })
      .def("stop", [](const Loaded<Kind>& loaded, Manager& manager) { manager.device->stop(*loaded.controller); })
      .def("runs",
           [](const Loaded<Kind>& loaded, Manager& manager) { return manager.device->runs(*loaded.controller); });
  return kind;
}

/// Takes the numbers of messages while the controller runs.
template <class Kind, class Take>
NumberTarget target_of(const Loaded<Kind>& loaded, const Take& take) {
  return {[&world = loaded.world, controller = loaded.controller, take](const std::vector<double>& numbers) {
    const AccessLock::Hold hold(world.access());
    return take(*controller, numbers);
  }};
}

std::optional<SpeedLimits::Range> to_range(const Range& range) {
  if (!range) return std::nullopt;
  if (!(range->first <= range->second)) throw InvalidInput("a limit is not usable: the least is above the most");
  return SpeedLimits::Range{range->first, range->second};
}

BaseController::Settings make_settings(double timeout, bool open_loop, std::size_t window,
                                       const std::array<std::array<Range, 3>, 3>& ranges) {
  BaseController::Settings settings{timeout, open_loop, window, {}};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    settings.limits[i] = {to_range(ranges[i][0]), to_range(ranges[i][1]), to_range(ranges[i][2])};
  }
  return settings;
}

template <class Kind>
void bind_base(py::class_<Loaded<Kind>>& kind) {
  kind.def(
      "commands",
      [](const Loaded<Kind>& loaded) {
        return target_of(loaded, [](Kind& controller, const std::vector<double>& numbers) {
          if (numbers.size() == 2) return controller.set_command({numbers[0], 0, numbers[1]});
          return numbers.size() == 3 && controller.set_command({numbers[0], numbers[1], numbers[2]});
        });
      },
      py::keep_alive<0, 1>(), "Return a NumberTarget for the three numbers of a command, or the first and the last.");
  Guarded(kind)
      .def(
          "odometry",
          [](const Loaded<Kind>& loaded) {
            const WheelOdometry& odometry = loaded.controller->odometry();
            const PlanarMotion& velocity = odometry.velocity();
            return std::make_tuple(odometry.x(), odometry.y(), odometry.heading(), velocity.forward, velocity.left,
                                   velocity.turn);
          },
          "Return x, y (m), heading (rad), m/s forward and to the left, and rad/s.")
      .def("limited_command", [](const Loaded<Kind>& loaded) { return loaded.controller->limited_command(); });
}

void bind_joint_controllers(py::module_& module) {
  auto forward = bind_controller<ForwardCommand, std::vector<std::size_t>>(module, "ForwardCommand",
                                                                           "Passes commands on to the joints.");
  Guarded(forward).def("set_commands", [](const Loaded<ForwardCommand>& loaded, Numbers commands) {
    loaded.controller->set_commands(std::move(commands));
  });
  auto pid = bind_controller<PidController, std::size_t, PidController::Kind, PidGains>(
      module, "PidController", "Commands a joint by the error of its position or velocity.");
  Guarded(pid)
      .def("set_command",
           [](const Loaded<PidController>& loaded, double command) { loaded.controller->set_command(command); })
      .def(
          "state",
          [](const Loaded<PidController>& loaded) {
            const PidController::State& s = loaded.controller->state();
            return std::make_tuple(s.set_point, s.process_value, s.process_value_dot, s.error, s.command);
          },
          "Return set point, process value, its rate, error and command.");
}

void bind_base_controllers(py::module_& module) {
  py::class_<BaseController::Settings>(module, "BaseSettings", "Timeout, odometry and limits of a base's controller.")
      .def(py::init(&make_settings), py::arg("timeout"), py::arg("open_loop"), py::arg("window"), py::arg("limits"),
           "Limits of each number of a command: (least, most) or None of velocity, acceleration and jerk.");
  py::class_<DiffDriveController::Wheels>(module, "DiffDriveWheels", "The wheels of a differential drive.")
      .def(py::init([](std::vector<std::size_t> left, std::vector<std::size_t> right, double separation,
                       double left_radius, double right_radius) {
             return DiffDriveController::Wheels{std::move(left), std::move(right), separation, left_radius,
                                                right_radius};
           }),
           py::arg("left"), py::arg("right"), py::arg("separation"), py::arg("left_radius"), py::arg("right_radius"));
  auto diff = bind_controller<DiffDriveController, DiffDriveController::Wheels, BaseController::Settings>(
      module, "DiffDriveController", "Drives wheels on two sides.");
  bind_base(diff);
  py::class_<AckermannSteeringController::Wheels>(module, "AckermannWheels", "A driven and a steered joint.")
      .def(py::init([](std::size_t rear, std::size_t steer, double wheel_base, double radius) {
             return AckermannSteeringController::Wheels{rear, steer, wheel_base, radius};
           }),
           py::arg("rear"), py::arg("steer"), py::arg("wheel_base"), py::arg("radius"));
  auto ackermann =
      bind_controller<AckermannSteeringController, AckermannSteeringController::Wheels, BaseController::Settings>(
          module, "AckermannSteeringController", "Drives one joint and steers another.");
  bind_base(ackermann);
  py::class_<MecanumDriveController::Wheels>(module, "MecanumWheels", "Wheels with rollers at 45 degrees.")
      .def(py::init([](const std::array<std::size_t, 4>& joints, double k, double radius) {
             return MecanumDriveController::Wheels{joints, k, radius};
           }),
           py::arg("joints"), py::arg("k"), py::arg("radius"),
           "Joints: front left, back left, back right, front right.");
  auto mecanum = bind_controller<MecanumDriveController, MecanumDriveController::Wheels, BaseController::Settings>(
      module, "MecanumDriveController", "Drives four wheels with rollers in any direction.");
  bind_base(mecanum);
  py::class_<FourWheelSteeringController::Wheels>(module, "FourWheelSteeringWheels", "Driven and steered wheels.")
      .def(py::init([](const std::array<std::size_t, 4>& driven, const std::array<std::size_t, 4>& steered,
                       double track, double base, double radius, bool by_angles) {
             return FourWheelSteeringController::Wheels{driven, steered, track, base, radius, by_angles};
           }),
           py::arg("driven"), py::arg("steered"), py::arg("track"), py::arg("base"), py::arg("radius"),
           py::arg("by_angles"), "Joints: front left, front right, rear left, rear right.");
  auto four =
      bind_controller<FourWheelSteeringController, FourWheelSteeringController::Wheels, BaseController::Settings>(
          module, "FourWheelSteeringController", "Drives and steers four wheels.");
  bind_base(four);
}

JointTolerance to_tolerance(const std::array<double, 3>& t) { return {t[0], t[1], t[2]}; }

std::vector<JointTolerance> to_tolerances(const std::vector<std::array<double, 3>>& tuples) {
  std::vector<JointTolerance> tolerances;
  for (const std::array<double, 3>& tuple : tuples) tolerances.push_back(to_tolerance(tuple));
  return tolerances;
}

/// Positions, velocities and accelerations.
std::array<Numbers, 3> to_columns(const std::vector<JointState>& states) {
  std::array<Numbers, 3> columns;
  for (const JointState& state : states) {
    columns[0].push_back(state.position);
    columns[1].push_back(state.velocity);
    columns[2].push_back(state.acceleration);
  }
  return columns;
}

void bind_trajectory_controller(py::module_& module) {
  using Trajectory = Loaded<TrajectoryController>;
  using Tolerances = std::tuple<std::vector<std::array<double, 3>>, std::vector<std::array<double, 3>>, double>;
  py::enum_<GoalStatus>(module, "GoalStatus", "What became of the goal of a trajectory.")
      .value("NONE", GoalStatus::kNone)
      .value("ACTIVE", GoalStatus::kActive)
      .value("REACHED", GoalStatus::kReached)
      .value("PATH_VIOLATED", GoalStatus::kPathViolated)
      .value("GOAL_MISSED", GoalStatus::kGoalMissed);
  py::class_<TrajectoryController::Settings>(module, "TrajectorySettings",
                                             "Joints and gains of a trajectory controller.")
      .def(py::init([](std::vector<std::size_t> joints, std::vector<PidGains> gains, Numbers velocity_feed,
                       std::vector<bool> wraps, double stop_duration) {
             return TrajectoryController::Settings{std::move(joints), std::move(gains), std::move(velocity_feed),
                                                   std::move(wraps), stop_duration};
           }),
           py::arg("joints"), py::arg("gains"), py::arg("velocity_feed"), py::arg("wraps"), py::arg("stop_duration"));
  auto kind = bind_controller<TrajectoryController, TrajectoryController::Settings>(module, "TrajectoryController",
                                                                                    "Joints follow splines.");
  Guarded(kind)
      .def(
          "follow",
          [](const Trajectory& loaded, const std::vector<std::vector<KnotTuple>>& joints, double start, double now,
             const std::optional<Tolerances>& given) {
            TrajectoryController::Knots knots;
            for (const std::vector<KnotTuple>& of_joint : joints) {
              std::vector<JointKnot>& all = knots.emplace_back();
              for (const auto& [time, position, velocity, acceleration] : of_joint) {
                all.push_back({time, position, velocity, acceleration});
              }
            }
            std::optional<GoalTolerances> goal;
            if (given) {
              const auto& [path, end, goal_time] = *given;
              goal = GoalTolerances{to_tolerances(path), to_tolerances(end), goal_time};
            }
            loaded.controller->follow(knots, start, now, goal);
          },
          py::arg("joints"), py::arg("start"), py::arg("now"), py::arg("goal"),
          R"(Follow points from `start` on.

:param joints: for each joint points of time, position, velocity and acceleration, the last two may be None.
:param goal: tolerances of each joint on the path and at the end, and s after the end; None for no goal.)")
      .def(
          "hold", [](const Trajectory& loaded, double now) { loaded.controller->hold(now); }, py::arg("now"))
      .def("goal_status", [](const Trajectory& loaded) { return loaded.controller->goal_status(); })
      .def("violating_joint", [](const Trajectory& loaded) { return loaded.controller->violating_joint(); })
      .def("desired", [](const Trajectory& loaded) { return to_columns(loaded.controller->desired()); })
      .def("actual", [](const Trajectory& loaded) { return to_columns(loaded.controller->actual()); })
      .def("error", [](const Trajectory& loaded) { return to_columns(loaded.controller->error()); })
      .def("at", [](const Trajectory& loaded, double time) { return to_columns(loaded.controller->at(time)); });
}

}  // namespace

void bind_control(py::module_& core) {
  py::module_ module = core.def_submodule("control", "The controllers of ros_control.");
  py::enum_<CommandInterface>(module, "CommandInterface", "What a controller commands of a joint.")
      .value("POSITION", CommandInterface::kPosition)
      .value("VELOCITY", CommandInterface::kVelocity)
      .value("EFFORT", CommandInterface::kEffort);
  py::enum_<PidController::Kind>(module, "PidKind", "What a PidController controls.")
      .value("POSITION", PidController::Kind::kPosition)
      .value("VELOCITY", PidController::Kind::kVelocity);
  py::class_<PidGains>(module, "PidGains", "Gains of a PID controller, and limits of the integral's part.")
      .def(py::init([](double p, double i, double d, double i_max, double i_min, bool antiwindup) {
             return PidGains{p, i, d, i_max, i_min, antiwindup};
           }),
           py::arg("p"), py::arg("i"), py::arg("d"), py::arg("i_max"), py::arg("i_min"), py::arg("antiwindup"))
      .def_readonly("p", &PidGains::p)
      .def_readonly("i", &PidGains::i)
      .def_readonly("d", &PidGains::d)
      .def_readonly("i_max", &PidGains::i_max)
      .def_readonly("i_min", &PidGains::i_min)
      .def_readonly("antiwindup", &PidGains::antiwindup);
  py::class_<Manager> manager(module, "ControllerManager", "Runs controllers before each physics substep.");
  manager.def(py::init(&make_manager), py::arg("world"), py::arg("model"), py::arg("joints"), py::keep_alive<1, 2>(),
              "Joints: name, handle, CommandInterface, and PidGains or None.");
  Guarded(manager)
      .def(
          "joint_states",
          [](const Manager& m) {
            std::array<Numbers, 3> columns;
            m.device->robot().read(m.world);
            for (const ControlledJoint& joint : m.device->robot().joints()) {
              columns[0].push_back(joint.position);
              columns[1].push_back(joint.velocity);
              columns[2].push_back(joint.effort);
            }
            return columns;
          },
          "Return positions, velocities and efforts.")
      .def("set_interface",
           [](const Manager& m, std::size_t joint, CommandInterface interface) {
             m.device->robot().set_interface(m.world, joint, interface);
           })
      .def("is_continuous",
           [](const Manager& m, std::size_t joint) { return m.device->robot().joints().at(joint).is_continuous; })
      .def("remove", &Manager::remove, "Remove it from the world.");
  module.def(
      "transmissions",
      [](const World& world, ObjectId model) {
        const HoldWithGil hold(world.access());
        using Joint = std::tuple<std::string, std::vector<std::string>, std::optional<double>>;
        std::vector<std::tuple<std::string, std::string, std::vector<Joint>, std::vector<std::string>>> all;
        for (const TransmissionDescription& each : world.models().description(model).transmissions) {
          auto& [name, type, joints, of_actuators] = all.emplace_back();
          name = each.name;
          type = each.type;
          for (const TransmissionJoint& joint : each.joints) {
            joints.emplace_back(joint.name, joint.hardware_interfaces, joint.initial_position);
          }
          for (const TransmissionActuator& actuator : each.actuators) {
            of_actuators.insert(of_actuators.end(), actuator.hardware_interfaces.begin(),
                                actuator.hardware_interfaces.end());
          }
        }
        return all;
      },
      py::arg("world"), py::arg("model"),
      "Return the <transmission>s of a model: name, type, joints with their interfaces "
      "and initial positions, interfaces of the actuators.");
  bind_joint_controllers(module);
  bind_base_controllers(module);
  bind_trajectory_controller(module);
}

}  // namespace bubblesim::bindings
