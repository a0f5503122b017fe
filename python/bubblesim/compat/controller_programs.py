# SPDX-License-Identifier: BSD-3-Clause
"""The programs spawner, unspawner and controller_manager, clients of the services of a controller manager."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

import rospy
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    LoadController,
    ReloadControllerLibraries,
    SwitchController,
    SwitchControllerRequest,
    UnloadController,
)
from std_msgs.msg import Bool

_STRICT = SwitchControllerRequest.STRICT
_FAILED = 1
_ENDLESS = 0.0


class ControllerManager:
    """The services of the controller manager in a namespace."""

    def __init__(self, namespace: str, timeout: float) -> None:
        """:param timeout: s to wait for the services; 0 without a limit."""
        prefix = f"{namespace.rstrip('/')}/" if namespace else ""
        self._prefix = f"{prefix}controller_manager/"
        self._timeout = timeout

    def _call(self, name: str, kind: Any, *request: Any) -> Any:
        service = self._prefix + name
        try:
            rospy.wait_for_service(service, self._timeout or None)
        except rospy.ROSException:
            if rospy.is_shutdown():
                raise
            raise ValueError(
                f"no controller manager: the service {rospy.resolve_name(service)} is not there; it comes with a robot "
                "that has the plugin libgazebo_ros_control.so"
            ) from None
        return rospy.ServiceProxy(service, kind)(*request)

    def load(self, controller: str) -> bool:
        """Load a controller; return whether that succeeded."""
        return bool(self._call("load_controller", LoadController, controller).ok)

    def unload(self, controller: str) -> bool:
        """Unload a controller that does not run."""
        return bool(self._call("unload_controller", UnloadController, controller).ok)

    def switch(self, start: Sequence[str], stop: Sequence[str]) -> bool:
        """Start and stop controllers between two updates."""
        request = list(start), list(stop), _STRICT, False, 0.0
        return bool(self._call("switch_controller", SwitchController, *request).ok)

    def reload(self) -> bool:
        """Unload all controllers."""
        return bool(self._call("reload_controller_libraries", ReloadControllerLibraries, True).ok)

    def controllers(self) -> list[Any]:
        """Return the states of the controllers that are loaded."""
        return list(self._call("list_controllers", ListControllers).controller)

    def types(self) -> list[tuple[str, str]]:
        """Return the types of controllers with their base classes."""
        answer = self._call("list_controller_types", ListControllerTypes)
        return list(zip(answer.types, answer.base_classes, strict=True))


def spawner(arguments: Sequence[str]) -> int:
    """Load controllers and start them, until the end of the program, which stops and unloads them."""
    parser = argparse.ArgumentParser(prog="spawner", description=spawner.__doc__, allow_abbrev=False)
    parser.add_argument("controllers", nargs="+", metavar="CONTROLLER", help="name of a controller's parameters")
    parser.add_argument("--stopped", action="store_true", help="do not start them")
    parser.add_argument("--wait-for", metavar="TOPIC", help="wait until this std_msgs/Bool is true")
    parser.add_argument("--namespace", default="", help="namespace of the controller manager")
    parser.add_argument("--timeout", type=float, default=30.0, help="s to wait for it (default 30)")
    parser.add_argument("--no-timeout", action="store_true", help="wait without a limit")
    parser.add_argument("--shutdown-timeout", type=float, help="accepted without an effect")
    options = parser.parse_args(arguments)
    rospy.init_node("spawner", anonymous=True)
    manager = ControllerManager(options.namespace, _ENDLESS if options.no_timeout else options.timeout)
    if options.wait_for:
        _wait_until_true(options.wait_for)
    loaded = []
    try:
        for controller in options.controllers:
            if not manager.load(controller):
                rospy.logerr(f"controller {controller} was not loaded: see the log of the simulator")
                continue
            loaded.append(controller)
        if loaded and not options.stopped and not manager.switch(loaded, []):
            rospy.logerr(f"not started: {', '.join(loaded)}: see the log of the simulator")
    except ValueError as error:
        rospy.logerr(str(error))
        return _FAILED
    if not loaded:
        return _FAILED
    rospy.loginfo(f"{'loaded' if options.stopped else 'started'}: {', '.join(loaded)}")
    rospy.on_shutdown(lambda: _remove(ControllerManager(options.namespace, 1.0), loaded))
    rospy.spin()
    return 0


def unspawner(arguments: Sequence[str]) -> int:
    """Stop controllers, until the end of the program, which starts them again."""
    parser = argparse.ArgumentParser(prog="unspawner", description=unspawner.__doc__, allow_abbrev=False)
    parser.add_argument("controllers", nargs="+", metavar="CONTROLLER")
    parser.add_argument("--namespace", default="", help="namespace of the controller manager")
    options = parser.parse_args(arguments)
    rospy.init_node("unspawner", anonymous=True)
    manager = ControllerManager(options.namespace, 30.0)
    try:
        if not manager.switch([], options.controllers):
            rospy.logerr(f"not stopped: {', '.join(options.controllers)}")
            return _FAILED
    except ValueError as error:
        rospy.logerr(str(error))
        return _FAILED
    rospy.on_shutdown(lambda: _ignoring_errors(lambda: manager.switch(options.controllers, [])))
    rospy.spin()
    return 0


def controller_manager(arguments: Sequence[str]) -> int:
    """Load, start, stop, unload or list controllers, once."""
    parser = argparse.ArgumentParser(
        prog="controller_manager", description=controller_manager.__doc__, allow_abbrev=False
    )
    names = "list", "list-types", "reload-libraries", "load", "unload", "start", "stop", "spawn", "kill"
    parser.add_argument("command", choices=names)
    parser.add_argument("controllers", nargs="*", metavar="CONTROLLER")
    options = parser.parse_args(arguments)
    rospy.init_node("controller_manager_client", anonymous=True)
    manager = ControllerManager("", 10.0)
    try:
        return 0 if _carry_out(manager, options.command, options.controllers) else _FAILED
    except (ValueError, rospy.ServiceException) as error:
        rospy.logerr(str(error))
        return _FAILED


def _carry_out(manager: ControllerManager, command: str, controllers: Sequence[str]) -> bool:
    if command == "list":
        for state in manager.controllers():
            claimed = "; ".join(
                f"{each.hardware_interface}: {', '.join(each.resources)}" for each in state.claimed_resources
            )
            print(f"'{state.name}' - '{state.type}' ( {state.state} ) {claimed}".rstrip())
        return True
    if command == "list-types":
        for kind, base in manager.types():
            print(f"{kind} [{base}]")
        return True
    if command == "reload-libraries":
        return manager.reload()
    succeeded = True
    for controller in controllers:
        if command in ("load", "spawn"):
            succeeded &= manager.load(controller)
        if command in ("start", "spawn"):
            succeeded &= manager.switch([controller], [])
        if command in ("stop", "kill"):
            succeeded &= manager.switch([], [controller])
        if command in ("unload", "kill"):
            succeeded &= manager.unload(controller)
    return succeeded


def _wait_until_true(topic: str) -> None:
    while not rospy.is_shutdown() and not rospy.wait_for_message(topic, Bool).data:
        rospy.loginfo_throttle(5.0, f"waiting until {topic} is true")


def _remove(manager: ControllerManager, controllers: Sequence[str]) -> None:
    def remove() -> None:
        manager.switch([], controllers)
        for controller in controllers:
            manager.unload(controller)

    _ignoring_errors(remove)


def _ignoring_errors(action: Any) -> None:
    """At the end of a launch the simulator may have ended before."""
    try:
        action()
    except (ValueError, rospy.ROSException, rospy.ServiceException):
        return
