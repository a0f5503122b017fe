# SPDX-License-Identifier: BSD-3-Clause
"""The plugins of all models."""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Iterator
from typing import Any

from bubblesim.gazebo_plugins.own_plugins import OwnPluginError
from bubblesim.gazebo_plugins.parameters import ParameterError, Parameters
from bubblesim.gazebo_plugins.plugin import FailedInSubstepError, Plugin, PluginContext, StepTime
from bubblesim.gazebo_plugins.registry import library, plugin_class
from bubblesim.gazebo_plugins.saved_state import collected, restored
from bubblesim.gazebo_plugins.sensors.gz_sensor import GzSensor, publishes_as_gz
from bubblesim.gazebo_plugins.sensors.sensor_topic import NoPlugin, SensorTopic
from bubblesim.gazebo_plugins.step_length import StepLength, rate_of
from bubblesim.gazebo_plugins.transforms import Transforms
from bubblesim.gazebo_plugins.unknown_plugins import UnknownPlugins, plugins_below
from bubblesim.program.output import write_line

_WORLD = -1


class GazeboPlugins:
    """Created by the simulator's node, which calls ``actuate`` and ``publish`` in each step and reports models."""

    def __init__(self, simulation: Any, bridge: Any, *, follows_rates: bool = False) -> None:
        """Create the plugins of the models in the world.

        :param follows_rates: the time step of the simulation becomes short enough for their rates.
        """
        self._simulation = simulation
        self._bridge = bridge
        self._step_time = StepTime(bridge)
        self._transforms = Transforms(bridge)
        self._plugins: list[Plugin] = []
        self._actuators: dict[int, Any] = {}
        self._unknown = UnknownPlugins()
        self._step = StepLength(simulation, enabled=follows_rates)
        for description in simulation.plugins:
            self._add(description, _WORLD, _WORLD, None)
        self._systems = {library(description.filename) for description in simulation.plugins}
        # A robot file loaded without a world is treated as gazebo_ros spawns it, with topics at the root.
        namespace = "" if simulation.is_model_file else None
        for model in simulation.world.models:
            self.model_added(model, namespace)

    def model_added(self, model: int, namespace: str | None = None) -> None:
        """Create the plugins of a model added to the world; ``namespace`` is the default of their namespaces.

        Without a bridge only those that act without ROS are created, but unsupported plugins are still reported.
        """
        world = self._simulation.world
        with_plugin: set[int] = set()
        systems = set(self._systems)
        for owner, description in plugins_below(world, model):
            systems.add(library(description.filename))
            self._step.need(rate_of(description))
            if self._add(description, owner, model, namespace):
                with_plugin.add(owner)
        for sensor in world.parts(model, "sensor") if self._bridge is not None else ():
            self._step.need(world.sensor_topic(sensor)[2])
            if world.sensor_topic(sensor)[0]:
                self._make(SensorTopic, NoPlugin(world.path(sensor)), sensor, model, namespace)
            elif sensor not in with_plugin and publishes_as_gz(world, sensor, systems):
                self._make(GzSensor, NoPlugin(world.path(sensor), "topic"), sensor, model, namespace)

    def model_removing(self, model: int) -> None:
        """Close the plugins of a model that is about to be removed."""
        leaving = [plugin for plugin in self._plugins if plugin.context.model == model]
        self._plugins = [plugin for plugin in self._plugins if plugin.context.model != model]
        for plugin in leaving:
            self._close(plugin)

    def reset(self) -> None:
        """Reset all plugins after a world reset."""
        self._each("reset")
        self._step.fit()

    def save_state(self) -> bytes:
        """Return the state of all plugins; empty without plugins."""
        states = {key: collected(plugin) for key, plugin in self._keyed()}
        return json.dumps(states).encode() if states else b""

    def restore_state(self, state: bytes) -> None:
        """Restore the states of the plugins that are there, as far as they were saved."""
        states = json.loads(state)
        for key, plugin in self._keyed():
            if key in states:
                restored(states[key], plugin)

    def _keyed(self) -> Iterator[tuple[str, Plugin]]:
        for number, plugin in enumerate(self._plugins):
            yield f"{number} {plugin.context.owner} {type(plugin).__name__}", plugin

    def actuate(self) -> None:
        """Call ``actuate`` of all plugins."""
        self._each("actuate")

    def publish(self) -> None:
        """Publish the results of all plugins."""
        if not self._plugins or self._bridge is None:
            return
        self._step_time.begin_step()
        self._each("publish")
        self._transforms.publish()

    def _add(self, description: Any, owner: int, model: int, namespace: str | None) -> bool:
        """Create a plugin; return whether its owner is published by it."""
        try:
            kind = plugin_class(description.filename)
        except OwnPluginError as error:
            self._left_out(f"{Parameters(description).title}: {error}")
            return False
        if kind is None:
            self._unknown.report(description)
            return False
        if self._bridge is None and not kind.acts_without_ros:
            return False
        if kind.of_world != (owner == _WORLD):
            place = "in the <world>, not in a <model>" if kind.of_world else "in a <model>, not in the <world>"
            text = f"plugin '{description.name}' ({description.filename}) is ignored: it must be {place}"
            self._unknown.warn(description, text)
            return False
        self._make(kind, description, owner, model, namespace)
        return True

    def _make(self, kind: type[Plugin], description: Any, owner: int, model: int, namespace: str | None) -> None:
        parameters = Parameters(description)
        outside = self._bridge, self._step_time, self._transforms
        context = PluginContext(
            self._simulation, *outside, owner, model, parameters, namespace, self._actuators, self._step.need
        )
        try:
            plugin = kind(context)
            plugin.reset()
        except Exception as error:
            context.close()
            self._left_out(f"{error}" if isinstance(error, ParameterError) else f"{parameters.title}: {error}")
            return
        self._plugins.append(plugin)
        for hint in parameters.hints:
            self._hint(hint)
        if unused := parameters.unused():
            text = f"plugin '{description.name}' ({description.filename}) has unknown parameters: {', '.join(unused)}"
            self._unknown.warn(description, text)

    def _left_out(self, problem: str) -> None:
        write_line(sys.stderr, "\n".join(f"error: {line}" for line in problem.splitlines()))

    def _hint(self, text: str) -> None:
        write_line(sys.stderr, f"warning: {text}")

    def _each(self, phase: str) -> None:
        for plugin in list(self._plugins):
            try:
                getattr(plugin, phase)()
            except Exception as error:  # an error of one plugin must not end the others
                self._disable(plugin, "a physics substep" if isinstance(error, FailedInSubstepError) else phase, error)

    def _disable(self, plugin: Plugin, phase: str, error: Exception) -> None:
        """Report a plugin with its model, and the line that failed, and call it no more."""
        model = plugin.context.model
        of = "" if model == _WORLD else f" of {self._simulation.world.path(model)}"
        last = traceback.extract_tb(error.__traceback__)[-1]
        place = "" if isinstance(error, FailedInSubstepError) else f" ({last.filename}:{last.lineno})"
        text = f"{plugin.parameters.title}{of} failed in {phase}{place} and is disabled: {error}"
        write_line(sys.stderr, f"error: {text}")
        self._plugins.remove(plugin)
        self._close(plugin)

    def _close(self, plugin: Plugin) -> None:
        try:
            plugin.close()
        except Exception as error:  # as in _each
            write_line(sys.stderr, f"error: {plugin.parameters.title} failed in close: {error}")
