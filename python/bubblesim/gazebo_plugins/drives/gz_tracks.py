# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's TrackController and TrackedVehicle: links whose surfaces run like belts, and a vehicle on two or more."""

from __future__ import annotations

import math

from bubblesim.controllers.planar_motion import Pose2D, Velocity, moved
from bubblesim.gazebo_plugins.drives.gz_odometry import drive_odometry
from bubblesim.gazebo_plugins.drives.odometry import motion_on_plane
from bubblesim.gazebo_plugins.drives.speed_limiter import SpeedLimiter
from bubblesim.gazebo_plugins.parameters import Parameters
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.geometry.rotations import matrix, quaternion_of_rpy


class GzTrackController(Plugin):
    """A track along x of <track_orientation>. Friction is Coulomb's, so that a center of rotation is not needed."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self._link = self.part_named(p.text("link", ""), "link", "link")
        below = f"/model/{self.world.name(context.model)}/link/{self.world.name(self._link)}"
        topic = p.text("velocity_topic", f"{below}/track_cmd_vel")
        turned = matrix(quaternion_of_rpy(p.numbers("track_orientation", (0.0, 0.0, 0.0))))
        self._axis = [row[1] for row in turned]  # y of the track, in the link
        self._max_age = p.number("max_command_age", math.inf, least=0.0)  # s
        self._limiter = SpeedLimiter.of(p)
        p.ignore("center_of_rotation_topic", "debug")
        p.check()
        self._wanted = 0.0  # m/s
        self._commanded_at = 0.0  # s of simulated time
        context.actuators[self._link] = self
        context.endpoints.append(lambda: context.actuators.pop(self._link, None))
        self.subscribe(topic, "std_msgs/Float64", self._command)

    def _command(self, message: Message) -> None:
        if self.usable("command", (message["data"],)):
            self.run_at(message["data"])

    def run_at(self, speed: float) -> None:
        """Command a speed in m/s; positive ones drive along the track."""
        self._wanted = speed
        self._commanded_at = self.simulation.time

    def reset(self) -> None:
        """Stop."""
        self._wanted = self._commanded_at = 0.0
        self._limiter.reset()

    def actuate(self) -> None:
        """Run at the command, within the limits."""
        if self.simulation.time - self._commanded_at > self._max_age:
            self._wanted = 0.0
        speed = self._limiter.limited(self._wanted, self.simulation.time_step)
        self.world.set_belt(self._link, self._axis, speed)


class GzTrackedVehicle(Plugin):
    """Commands the tracks that have a TrackController. The odometry is that of the commands, as in gz-sim."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        model = self.world.name(context.model)
        self._left, self._right = (self._tracks(f"{side}_track") for side in ("left", "right"))
        self._separation = p.length("tracks_separation", 1.0)  # m
        self._first_efficiency = self._efficiency = p.length("steering_efficiency", 0.5)
        self._limiters = [SpeedLimiter.of(p.inner(f"{kind}_velocity")) for kind in ("linear", "angular")]
        self._rate = Rate(p.number("odom_publish_frequency", 50.0, least=0.0), self.simulation)
        p.ignore("body_link", "tracks_height", "track_height", "tf_topic", "debug")
        topic = p.text("topic", f"/model/{model}/cmd_vel")
        efficiency_topic = p.text("steering_efficiency_topic", f"/model/{model}/steering_efficiency")
        self._odometry = None if self.bridge is None else drive_odometry(self)
        p.check()
        self._wanted = Velocity(0.0, 0.0)
        self._velocity = Velocity(0.0, 0.0)
        self._pose = Pose2D()
        self.subscribe(topic, "geometry_msgs/Twist", self._command)
        self.subscribe(efficiency_topic, "std_msgs/Float64", self._steer)

    def _tracks(self, side: str) -> list[int]:
        elements: list[Parameters] = self.parameters.all_of(side)
        if not elements:
            raise self.parameters.fail(side, "is missing: it names the <link> of a track")
        for element in elements:
            element.ignore("velocity_topic", "center_of_rotation_topic")
        return [self.part_named(element.text("link", ""), side, "link") for element in elements]

    def _command(self, twist: Message) -> None:
        wanted = twist["linear"]["x"], twist["angular"]["z"]
        if self.usable("Twist", wanted):
            self._wanted = Velocity(*wanted)

    def _steer(self, message: Message) -> None:
        if message["data"] > 0.0 and self.usable("steering_efficiency", (message["data"],)):
            self._efficiency = message["data"]

    def reset(self) -> None:
        """Stop, and begin the odometry anew."""
        self._wanted = self._velocity = Velocity(0.0, 0.0)
        self._efficiency = self._first_efficiency
        self._pose = Pose2D()
        self._rate.reset()
        for limiter in self._limiters:
            limiter.reset()

    def actuate(self) -> None:
        """Command the tracks."""
        step = self.simulation.time_step
        wanted = zip(self._limiters, (self._wanted.linear, self._wanted.angular), strict=True)
        self._velocity = Velocity(*(limiter.limited(value, step) for limiter, value in wanted))
        aside = self._velocity.angular * self._separation / 2 / self._efficiency
        for tracks, speed in ((self._left, -aside), (self._right, aside)):
            for track in tracks:
                controller: GzTrackController | None = self.context.actuators.get(track)
                if controller is not None:
                    controller.run_at(self._velocity.linear + speed)
        self._pose = moved(self._pose, self._velocity, step)

    def publish(self) -> None:
        """Publish the odometry."""
        if self._odometry is not None and self._rate.due():
            self._odometry.publish(motion_on_plane(self._pose, self._velocity))
