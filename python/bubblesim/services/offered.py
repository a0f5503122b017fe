# SPDX-License-Identifier: BSD-3-Clause
"""The services and topics of the node to control the simulation."""

from __future__ import annotations

from bubblesim._core.messages import RosVersion
from bubblesim.both_bridges import bridge_of
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.drawing_markers import DrawingMarkers
from bubblesim.services.gazebo_properties import GazeboProperties
from bubblesim.services.gazebo_services import GazeboServices
from bubblesim.services.gazebo_topics import GazeboTopics
from bubblesim.services.model_services import ModelServices
from bubblesim.services.object_services import ObjectServices
from bubblesim.services.reset_services import advertise_reset_services
from bubblesim.services.simulate_steps import SimulateSteps
from bubblesim.services.simulation_topics import SimulationTopics
from bubblesim.services.standard_services import StandardServices
from bubblesim.services.state_services import advertise_state_services


class NodeServices:
    """Created by the simulator's node, which calls ``process_input`` and ``publish`` in each step."""

    def __init__(self, host: ScriptHost, *, gazebo_compat: bool, node_name: str) -> None:
        """Advertise all of them through the host's bridge; Gazebo's only with ``gazebo_compat``."""
        ObjectServices(host.simulation, host.bridge)  # referenced by its callbacks
        ModelServices(host)
        # A node with the name gazebo, as in launch files, has /gazebo/reset_simulation among Gazebo's services.
        is_gazebo = gazebo_compat and node_name == "/gazebo"
        advertise_reset_services(host.bridge, host, taken=["~reset_simulation"] if is_gazebo else [])
        advertise_state_services(host.bridge, host)
        ros2 = bridge_of(host.bridge, RosVersion.ROS2)
        has_action = ros2.version == RosVersion.ROS2
        self._steps = SimulateSteps(getattr(ros2, "unobserved", ros2), host.runner) if has_action else None
        StandardServices(host, has_action=has_action)
        self._topics = SimulationTopics(host.bridge, host.runner)
        self._drawings = DrawingMarkers(host.bridge, host.simulation, host.shared)
        self._gazebo: GazeboTopics | None = None
        if gazebo_compat:
            GazeboServices(host)
            GazeboProperties(host.bridge, host.simulation)
            self._gazebo = GazeboTopics(host.bridge, host.simulation.world)

    def process_input(self) -> None:
        """Publish the state after input was processed."""
        if self._steps is not None:
            self._steps.process_input()
        self._topics.publish_state()

    def publish(self) -> None:
        """Publish at the end of a step, after all other messages of the step."""
        if self._gazebo is not None:
            self._gazebo.publish()
        if self._steps is not None:
            self._steps.publish()
        self._drawings.publish()
        self._topics.publish_step_done()
