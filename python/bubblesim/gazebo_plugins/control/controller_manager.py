# SPDX-License-Identifier: BSD-3-Clause
"""The services of controller_manager: controllers are loaded, started, stopped and unloaded between steps."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

from bubblesim.gazebo_plugins.control.controller import Controller, Robot, interface_name
from bubblesim.gazebo_plugins.control.controller_types import CONTROLLERS
from bubblesim.gazebo_plugins.control.own_controllers import own_controller
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerError, ControllerParameters, read_parameter
from bubblesim.gazebo_plugins.plugin import Message
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.program.output import write_line

_STRICT = 2


class ControllerManager:
    """The controllers of a robot, by name."""

    def __init__(self, robot: Robot) -> None:
        """Advertise the services below NAMESPACE/controller_manager."""
        self._robot = robot
        self._controllers: dict[str, Controller] = {}
        for name, kind, answer in (
            ("list_controller_types", "ListControllerTypes", self._list_types),
            ("list_controllers", "ListControllers", self._list),
            ("load_controller", "LoadController", self._answering(self._load)),
            ("reload_controller_libraries", "ReloadControllerLibraries", self._answering(self._reload)),
            ("switch_controller", "SwitchController", self._answering(self._switch)),
            ("unload_controller", "UnloadController", self._answering(self._unload)),
        ):
            service = f"{robot.namespace.rstrip('/')}/controller_manager/{name}"
            robot.plugin.advertise_service(service, f"controller_manager_msgs/{kind}", answer)

    def publish(self) -> None:
        """Publish what the running controllers publish; one that fails is stopped."""
        for controller in list(self._controllers.values()):
            if controller.state != "running":
                continue
            try:
                controller.publish()
            except Exception as error:  # an error of one controller must not end the others
                write_line(sys.stderr, f"error: controller {controller.name} failed and is stopped: {error}")
                controller.stop()

    def reset(self) -> None:
        """Reset the controllers after a reset of the world."""
        for controller in self._controllers.values():
            controller.reset()

    def close(self) -> None:
        """Unload all controllers."""
        for controller in self._controllers.values():
            controller.close()
        self._controllers.clear()

    def _answering(self, action: Callable[[Message], None]) -> Callable[[Message], Message]:
        """Return the handler of a service: an error is logged, and ok is false."""

        def answer(request: Message) -> Message:
            try:
                action(request)
            except Exception as error:  # also of a controller with a defect
                write_line(sys.stderr, f"error: controller manager {self._robot.namespace}: {error}")
                return {"ok": False}
            return {"ok": True}

        return answer

    def _list_types(self, _: Message) -> Message:
        return {
            "types": sorted(CONTROLLERS),
            "base_classes": ["controller_interface::ControllerBase"] * len(CONTROLLERS),
        }

    def _list(self, _: Message) -> Message:
        return {
            "controller": [
                {
                    "name": each.name,
                    "state": each.state,
                    "type": each.type,
                    "claimed_resources": [
                        {"hardware_interface": interface_name(kind), "resources": names}
                        for kind, names in each.claimed.items()
                    ],
                }
                for each in self._controllers.values()
            ]
        }

    def _load(self, request: Message) -> None:
        name = request["name"]
        if name in self._controllers:
            raise ControllerError(f"a controller '{name}' is loaded already")
        full = f"{self._robot.namespace.rstrip('/')}/{name}"
        values = read_parameter(full)
        if not isinstance(values, dict) or "type" not in values:
            raise ControllerError(f"there is no parameter {full}/type: load the parameters of '{name}' before it")
        parameters = ControllerParameters(full, values)
        kind = CONTROLLERS.get(parameters.text("type")) or own_controller(parameters.text("type"))
        if kind is None:
            hint = did_you_mean(nearest_names(values["type"], sorted(CONTROLLERS)))
            raise ControllerError(f"{full}: the type {values['type']} is not supported{hint}")
        self._controllers[name] = kind(self._robot, name, parameters)

    def _unload(self, request: Message) -> None:
        controller = self._named(request["name"])
        if controller.state == "running":
            raise ControllerError(f"the controller '{controller.name}' runs: stop it before it is unloaded")
        controller.close()
        del self._controllers[controller.name]

    def _reload(self, request: Message) -> None:
        running = [each.name for each in self._controllers.values() if each.state == "running"]
        if running and not request["force_kill"]:
            raise ControllerError(f"controllers run: {', '.join(running)}")
        for name in running:
            self._controllers[name].stop()
        self.close()

    def _switch(self, request: Message) -> None:
        strict = request["strictness"] == _STRICT
        stopping = self._usable(request["stop_controllers"], "running", strict=strict)
        starting = self._usable(request["start_controllers"], "initialized", "stopped", strict=strict, also=stopping)
        remaining = [each for each in self._controllers.values() if each.state == "running" and each not in stopping]
        taken = {joint: each.name for each in remaining for names in each.claimed.values() for joint in names}
        for controller in starting:
            for joint in (joint for names in controller.claimed.values() for joint in names):
                if joint in taken:
                    raise ControllerError(
                        f"'{controller.name}' cannot start: the joint '{joint}' is commanded by '{taken[joint]}'"
                    )
                taken[joint] = controller.name
        for controller in stopping:
            controller.stop()
        for controller in starting:
            controller.start()

    def _usable(
        self, names: Sequence[str], *states: str, strict: bool, also: Sequence[Controller] = ()
    ) -> list[Controller]:
        """Return the controllers that are in one of the states; without ``strict`` the others are left out."""
        found = []
        for name in dict.fromkeys(names):
            try:
                controller = self._named(name)
                if controller.state not in states and controller not in also:
                    raise ControllerError(f"the controller '{name}' is {controller.state}")
            except ControllerError:
                if strict:
                    raise
                continue
            found.append(controller)
        return found

    def _named(self, name: str) -> Controller:
        if name not in self._controllers:
            raise ControllerError(
                f"there is no controller '{name}'; loaded are {', '.join(self._controllers) or 'none'}"
            )
        return self._controllers[name]
