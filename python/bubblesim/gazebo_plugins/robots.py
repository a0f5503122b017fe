# SPDX-License-Identifier: BSD-3-Clause
"""The devices of all models, in the phases of a step."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

from bubblesim.gazebo_plugins.device import Device, PluginContext, StepTime
from bubblesim.gazebo_plugins.parameters import ParameterError, Parameters
from bubblesim.gazebo_plugins.registry import DEVICES, library
from bubblesim.gazebo_plugins.sensors.gz_sensor import GzSensor, publishes_as_gz
from bubblesim.gazebo_plugins.sensors.sensor_topic import OwnTopic, SensorTopic
from bubblesim.gazebo_plugins.transforms import Transforms
from bubblesim.gazebo_plugins.unknown_plugins import UnknownPlugins, plugins_below
from bubblesim.output import write_line


class Devices:
    """Made by the simulator's node, which calls ``actuate`` and ``publish`` in every step and tells of models."""

    def __init__(self, simulation: Any, bridge: Any) -> None:
        """Make the devices of the models that are there."""
        self._simulation = simulation
        self._bridge = bridge
        self._pass_time = StepTime(bridge)
        self._transforms = Transforms(bridge)
        self._devices: list[Device] = []
        self._unknown = UnknownPlugins()
        for plugin in simulation.plugins:
            self._unknown.report(plugin)
        self._systems = {library(plugin.filename) for plugin in simulation.plugins}
        # A robot's file on its own is taken as gazebo_ros spawns it, with its topics at the root.
        namespace = "" if simulation.is_model_file else None
        for model in simulation.world.models:
            self.add_model(model, namespace)

    def add_model(self, model: int, namespace: str | None = None) -> None:
        """Make the devices of a model that has come into the world, in a namespace if not each has its own.

        Without a bridge there are none; what has none is reported all the same.
        """
        world = self._simulation.world
        with_device: set[int] = set()
        systems = set(self._systems)
        for owner, plugin in plugins_below(world, model):
            systems.add(library(plugin.filename))
            self._unknown.report(plugin)
            kind = DEVICES.get(library(plugin.filename))
            if kind is not None and self._bridge is not None:
                with_device.add(owner)
                self._make(kind, plugin, owner, model, namespace)
        for sensor in self._sensors_below(model) if self._bridge is not None else ():
            if world.sensor_topic(sensor)[0]:
                self._make(SensorTopic, OwnTopic(world.path(sensor)), sensor, model, namespace)
            elif sensor not in with_device and publishes_as_gz(world, sensor, systems):
                self._make(GzSensor, OwnTopic(world.path(sensor), "topic"), sensor, model, namespace)

    def remove_model(self, model: int) -> None:
        """Close the devices of a model that is about to leave the world."""
        leaving = [device for device in self._devices if device.context.model == model]
        self._devices = [device for device in self._devices if device.context.model != model]
        for device in leaving:
            device.close()

    def reset(self) -> None:
        """The world was put back to its start."""
        self._each("reset")

    def actuate(self) -> None:
        """Have all devices command their joints."""
        self._each("actuate")

    def publish(self) -> None:
        """Have all devices tell what they measure."""
        if not self._devices:
            return
        self._pass_time.begin_step()
        self._each("publish")
        self._transforms.publish()

    def _sensors_below(self, handle: int) -> Iterator[int]:
        if self._simulation.world.kind(handle) == "sensor":
            yield handle
        for child in self._simulation.world.children(handle):
            yield from self._sensors_below(child)

    def _make(self, kind: type[Device], plugin: Any, owner: int, model: int, namespace: str | None) -> None:
        parameters = Parameters(plugin)
        outside = self._bridge, self._pass_time, self._transforms
        context = PluginContext(self._simulation, *outside, owner, model, parameters, namespace)
        try:
            device = kind(context)
            device.reset()
        except Exception as error:
            context.close()
            text = f"{error}" if isinstance(error, ParameterError) else f"{parameters.title}: {error}"
            write_line(sys.stderr, "\n".join(f"error: {line}" for line in text.splitlines()))
            return
        self._devices.append(device)
        for hint in parameters.hints:
            write_line(sys.stderr, f"warning: {hint}")
        if unused := parameters.unused():
            text = f"plugin '{plugin.name}' ({plugin.filename}) has no parameters {', '.join(unused)}"
            self._unknown.warn(plugin, text)

    def _each(self, phase: str) -> None:
        for device in list(self._devices):
            try:
                getattr(device, phase)()
            except Exception as error:  # one device must not end the others
                write_line(sys.stderr, f"error: {device.parameters.title} failed in {phase} and is off: {error}")
                self._devices.remove(device)
                device.close()
