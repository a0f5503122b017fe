# SPDX-License-Identifier: BSD-3-Clause
"""WheelSlip of gz-sim and of Gazebo: wheels that slip in proportion to the friction that they transmit."""

from __future__ import annotations

from collections.abc import Callable

from bubblesim._core import WheelSlip as Slip
from bubblesim.gazebo_plugins.drives.wheels import wheel_radius
from bubblesim.gazebo_plugins.parameters import Parameters
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext


class WheelSlip(Plugin):
    """Parameters are those of gz-sim. Topics are Gazebo's, below wheel_slip in the namespace of the model."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        elements = p.all_of("wheel")
        if not elements:
            raise p.fail("wheel", "is missing: it names the link of a wheel, and its compliances")
        wheels = [self._read_wheel(element) for element in elements]
        p.ignore("ros")
        p.check()
        self._slip = Slip(self.simulation, [wheel for _, wheel in wheels])
        context.endpoints.append(self._slip.remove)
        self.subscribe("wheel_slip/lateral_compliance", "std_msgs/Float64", self._setting("lateral"))
        self.subscribe("wheel_slip/longitudinal_compliance", "std_msgs/Float64", self._setting("longitudinal"))
        self._publishers: list[int] = []  # one for each wheel
        if self.bridge is not None:
            topics = [f"wheel_slip/{self.world.name(link)}" for link, _ in wheels]
            self._publishers = [self.advertise(topic, "geometry_msgs/Vector3", 1) for topic in topics]

    def _read_wheel(self, element: Parameters) -> tuple[int, tuple[int, float, float, float, float]]:
        """Return the link of a wheel, and what _core.WheelSlip takes of it."""
        name = element.text("link_name", "")
        link = self.part_named(name, "link_name", "link")
        joints = [part for part in self.parts_of_model() if self.world.kind(part) == "joint"]
        axles = [joint for joint in joints if self.world.joint_links(joint)[1] == link]
        if len(axles) != 1:
            raise element.fail(
                "link_name", f"is '{name}', which is the child of {len(axles)} joints: it must be of one"
            )
        given = element.given("wheel_radius") is not None
        radius = element.length("wheel_radius", 0.0) if given else wheel_radius(self, axles[0])
        if radius is None:
            raise element.fail("wheel_radius", "is missing, and the wheel is neither a sphere nor a cylinder")
        if element.given("wheel_normal_force") is None:
            raise element.fail("wheel_normal_force", "is missing: about that on the wheel at rest, N")
        force = element.length("wheel_normal_force", 1.0)
        lateral = element.number("slip_compliance_lateral", 0.0, least=0.0)
        return link, (axles[0], radius, force, lateral, element.number("slip_compliance_longitudinal", 0.0, least=0.0))

    def _setting(self, direction: str) -> Callable[[Message], None]:
        def set_compliance(message: Message) -> None:
            if self.usable(f"{direction}_compliance", (message["data"],)):
                self._slip.set_compliance(**{direction: message["data"]})

        return set_compliance

    def publish(self) -> None:
        """Publish for each wheel, m/s: the slip along and across its way, and the speed of its circumference."""
        for number, publisher in enumerate(self._publishers):
            if self.is_needed(publisher):
                x, y, z = map(float, self._slip.slip(number))
                self.bridge.publish(publisher, {"x": x, "y": y, "z": z})
