# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_kobuki: the base of the TurtleBot 2, with its drive, cliff sensors, bumpers and IMU."""

from __future__ import annotations

from bubblesim._core import read_imu, read_lidar, read_sensor
from bubblesim._core.reading_messages import imu, joint_state
from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.controllers.planar_motion import Pose2D, Velocity, moved
from bubblesim.gazebo_plugins.drives.kobuki_events import SIDES, bumpers_pressed, cliff_reading
from bubblesim.gazebo_plugins.drives.odometry import Motion, Odometry, motion_on_plane, variances
from bubblesim.gazebo_plugins.drives.two_sided_drive import STILL, TwoSidedDrive, WheelGroup
from bubblesim.gazebo_plugins.plugin import FASTEST, Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings

_BASE = "mobile_base"  # namespace of the topics of the Kobuki's driver
_ONLY_YAW = 1e6, 1e6, 0.05  # variances: roll and pitch are unknown


class Kobuki(Plugin):
    """Parameters are the plugin's. A sensor that it does not name is not used, and its topics are not published.

    As in the Kobuki's driver, the odometry uses the distances from the wheels and the heading from the gyroscope.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._joints = [self.joint(f"{side}_wheel_joint_name", f"wheel_{side}_joint") for side in ("left", "right")]
        geometry = DifferentialDrive(p.length("wheel_diameter", 0.07) / 2, p.length("wheel_separation", 0.23), FASTEST)
        torque = p.number("torque", 1.0, least=0.0)
        self._timeout = p.number("velocity_command_timeout", 0.6, least=0.0)
        self._threshold = p.number("cliff_detection_threshold", 0.04, least=0.0)
        cliffs = {side: self._sensor(f"cliff_sensor_{side}_name", "LidarScan") for side in SIDES}
        cliffs["center"] = cliffs["center"] or self._sensor("cliff_sensor_front_name", "LidarScan")  # old name
        self._cliffs = {side: sensor for side, sensor in cliffs.items() if sensor is not None}
        self._bumper = self._sensor("bumper_name", "ContactReading")
        self._imu = self._sensor("imu_name", "ImuReading")
        transform = p.flag("publish_tf", default=False)
        p.ignore("base_collision_model_link")
        p.check()
        self._drive = TwoSidedDrive(self, WheelGroup(geometry, self._joints[:1], self._joints[1:]), torque=torque)
        self._advertise(transform)
        self._reset_state()

    def _sensor(self, parameter: str, kind: str) -> int | None:
        """Return the handle of the sensor named by a parameter."""
        given = self.parameters.given(parameter)
        if given is None:
            return None
        sensor = self.part_named(given.rpartition("::")[2], parameter, "sensor")
        found = type(read_sensor(self.simulation, sensor)[1]).__name__
        if found != kind:
            raise self.parameters.fail(parameter, f"names a sensor that measures a {found}, expected a {kind}")
        return sensor

    def _advertise(self, transform: bool) -> None:
        self._odometry = Odometry(
            self,
            topic="odom",
            frame=self.frame("odom"),
            base_frame=self.frame("base_footprint"),
            transform=transform,
            pose_variances=variances(0.1, 0.1, 0.05),
        )
        self._states = self.advertise("joint_states", "sensor_msgs/JointState", 1)
        if self._imu is not None:
            self._imus = self.advertise(f"{_BASE}/sensors/imu_data", "sensor_msgs/Imu", 1)
            self._turns = NewReadings(self, read_imu, sensor=self._imu)
        if self._cliffs:
            self._cliff_events = self.advertise(f"{_BASE}/events/cliff", "kobuki_msgs/CliffEvent", 10)
        if self._bumper is not None:
            self._bumper_events = self.advertise(f"{_BASE}/events/bumper", "kobuki_msgs/BumperEvent", 10)
        self.subscribe(f"{_BASE}/commands/velocity", "geometry_msgs/Twist", self._command)
        self.subscribe(f"{_BASE}/commands/motor_power", "kobuki_msgs/MotorPower", self._switch)
        self.subscribe(f"{_BASE}/commands/reset_odometry", "std_msgs/Empty", self._reset_odometry)

    def _reset_state(self) -> None:
        self._powered = True
        self._commanded = -float("inf")  # s
        self._pose = Pose2D()
        self._over_cliff = dict.fromkeys(self._cliffs, False)
        self._pressed = dict.fromkeys(SIDES, False)

    def reset(self) -> None:
        """Stop."""
        self._drive.reset()
        self._reset_state()
        if self._imu is not None:
            self._turns.reset()

    def _command(self, twist: Message) -> None:
        self._drive.set_command(twist)
        self._commanded = self.simulation.time

    def _switch(self, message: Message) -> None:
        self._powered = message["state"] == 1

    def _reset_odometry(self, _: Message) -> None:
        self._pose = Pose2D()

    def actuate(self) -> None:
        """Command the wheels; stop them if the last command is too old."""
        if self._powered and self.simulation.time - self._commanded <= self._timeout:
            self._drive.keep(self._drive.target)
        else:
            self._drive.keep(STILL)

    def publish(self) -> None:
        """Publish states, and events of cliff sensors and bumpers."""
        self._odometry.publish(self._moved())
        if self.is_needed(self._states):
            states = joint_state(self.world, self.header(self.frame("base_link")), self._joints)
            self.bridge.publish(self._states, states)
        if self._imu is not None and self.is_needed(self._imus) and (reading := self._turns.take()):
            self.bridge.publish(self._imus, imu(self.header(self.frame("base_link")), reading, _ONLY_YAW))
        if self._cliffs and self.is_needed(self._cliff_events):
            self._publish_cliffs()
        if self._bumper is not None and self.is_needed(self._bumper_events):
            self._publish_bumpers()

    def _moved(self) -> Motion:
        velocity = self._drive.encoder_velocity()
        if self._imu is not None:
            turning = float(read_imu(self.simulation, self._imu).angular_velocity[2])
            velocity = Velocity(velocity.linear, turning)
        self._pose = moved(self._pose, velocity, self.simulation.time_step)
        return motion_on_plane(self._pose, velocity)

    def _publish_cliffs(self) -> None:
        for side, sensor in self._cliffs.items():
            distance = float(read_lidar(self.simulation, sensor).ranges[0, 0])
            over_cliff = distance >= self._threshold
            if over_cliff != self._over_cliff[side]:
                self._over_cliff[side] = over_cliff
                event = {"sensor": SIDES[side], "state": int(over_cliff), "bottom": cliff_reading(distance)}
                self.bridge.publish(self._cliff_events, event)

    def _publish_bumpers(self) -> None:
        _, reading = read_sensor(self.simulation, self._bumper)
        points = [point for contact in reading.contacts for point in contact.points]
        pose = self.world.pose(self.context.model)
        pressed = bumpers_pressed(pose, [(point.position.tolist(), point.normal.tolist()) for point in points])
        for side in SIDES:
            if (side in pressed) != self._pressed[side]:
                self._pressed[side] = side in pressed
                event = {"bumper": SIDES[side], "state": int(side in pressed)}
                self.bridge.publish(self._bumper_events, event)
