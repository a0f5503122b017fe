# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's LinearBatteryPlugin: a battery whose voltage is linear in its charge, with a constant load."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass

from bubblesim._core import MotorMode
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.program.output import write_line

_FULL = 0.9  # as gz-sim: charging ends at this part of the capacity
_HOUR = 3600.0  # s
_CHARGING, _DISCHARGING, _NOT_CHARGING, _FULLY_CHARGED = 1, 2, 3, 4  # of sensor_msgs/BatteryState


@dataclass
class LinearBattery:
    """Open-circuit voltage ``constant + linear (1 - charge / capacity)`` before a resistance."""

    constant: float  # V
    linear: float  # V
    capacity: float  # Ah
    charge: float  # Ah
    resistance: float  # Ohm
    smoothing: float  # s: the current approaches that of the load exponentially
    voltage: float  # V
    current: float = 0.0  # A, out of the battery

    @property
    def part(self) -> float:
        """The charge as a part of the capacity."""
        return self.charge / self.capacity

    def draw(self, power: float, charging: float, duration: float) -> None:
        """Supply a power in W and take a charging current in A, constant for a time in s."""
        if self.voltage < 1e-3 and charging == 0.0:
            return
        wanted = power / max(self.voltage, 1e-3) - charging
        done = -math.expm1(-duration / self.smoothing)
        drawn = wanted * duration + (self.current - wanted) * self.smoothing * done  # A s
        self.current += (wanted - self.current) * done
        self.charge = min(max(self.charge - drawn / _HOUR, 0.0), self.capacity)
        self.voltage = self.constant + self.linear * (1.0 - self.part) - self.resistance * self.current


class GzBattery(Plugin):
    """It drains while a joint is commanded, and after a message on a <power_draining_topic>; empty, motors are off."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        name = p.text("battery_name", "")
        if not name:
            raise p.fail("battery_name", "is empty: it is a part of the topic")
        self._first_voltage = p.length("voltage", 0.0)
        capacity = p.length("capacity", 0.0)
        if p.given("voltage") is None:
            raise p.fail("voltage", "is missing: the voltage at the start, V")
        if p.given("capacity") is None:
            raise p.fail("capacity", "is missing: Ah")
        self._first_charge = p.number("initial_charge", capacity, least=0.0)
        if self._first_charge > capacity:
            raise p.fail("initial_charge", f"is {self._first_charge:g} Ah, it must be at most <capacity>, {capacity:g}")
        self._battery = LinearBattery(
            constant=p.number("open_circuit_voltage_constant_coef", 0.0),
            linear=p.number("open_circuit_voltage_linear_coef", 0.0),
            capacity=capacity,
            charge=self._first_charge,
            resistance=p.number("resistance", 0.0, least=0.0),
            smoothing=p.length("smooth_current_tau", 1.0),
            voltage=self._first_voltage,
        )
        self._load = p.number("power_load", 0.0, least=0.0)  # W
        self._drains_at_start = p.flag("start_draining", default=False)
        recharge = p.flag("enable_recharge", default=False)
        self._charging_current = capacity / p.length("charging_time", 1.0) if recharge else 0.0  # h: A
        if recharge and p.given("charging_time") is None:
            raise p.fail("charging_time", "is missing: the hours of a full charge")
        begin, end = p.names("power_draining_topic"), p.names("stop_power_draining_topic")
        p.ignore("recharge_by_topic", "fix_issue_225", "start_on_motion", "soc_threshold")
        p.check()
        self._rate = Rate(50.0, self.simulation)
        joints = [part for part in self.parts_of_model() if self.world.kind(part) == "joint"]
        counts = {joint: self.world.joint_axes(joint) for joint in joints}
        # Ball joints, which have three axes, have no motor.
        self._axes = [(joint, axis) for joint, count in counts.items() if count < 3 for axis in range(count)]
        self._charges = self._drains = False
        self._modes: list[int] = []  # of the motors of an empty battery, before they were switched off
        base = f"/model/{self.world.name(context.model)}/battery/{name}"
        self._name = name
        self._publisher = self.advertise(f"{base}/state", "sensor_msgs/BatteryState", 10)
        for topic in begin:
            self.subscribe(topic, "geometry_msgs/Twist", self._sets("_drains", value=True))
        for topic in end:
            self.subscribe(topic, "geometry_msgs/Twist", self._sets("_drains", value=False))
        if recharge:
            self.subscribe(f"{base}/recharge/start", "std_msgs/Bool", self._sets("_charges", value=True))
            self.subscribe(f"{base}/recharge/stop", "std_msgs/Bool", self._sets("_charges", value=False))

    def _sets(self, attribute: str, *, value: bool) -> Callable[[Message], None]:
        return lambda _: setattr(self, attribute, value)

    def reset(self) -> None:
        """Return to the initial charge."""
        battery = self._battery
        battery.charge, battery.current, battery.voltage = self._first_charge, 0.0, self._first_voltage
        self._charges, self._drains = False, self._drains_at_start
        self._modes = []
        self._rate.reset()

    def _is_commanded(self, joint: int, axis: int) -> bool:
        mode = self.world.motor_mode(joint, axis)
        if mode == MotorMode.VELOCITY:
            return bool(self.world.target_velocity(joint, axis) != 0.0)
        return bool(mode == MotorMode.EFFORT and self.world.target_effort(joint, axis) != 0.0)

    def actuate(self) -> None:
        """Switch the motors off while the battery is empty."""
        if self._battery.charge > 0.0:
            for (joint, axis), mode in zip(self._axes, self._modes, strict=False):
                self.world.set_motor_mode(joint, MotorMode(mode), axis)
            self._modes = []
            return
        if not self._modes:
            self._modes = [int(self.world.motor_mode(*axis)) for axis in self._axes]
        for joint, axis in self._axes:
            self.world.set_motor_mode(joint, MotorMode.NONE, axis)

    def publish(self) -> None:
        """Draw the current of this step, and publish at 50 Hz."""
        battery = self._battery
        drains = self._drains or any(self._is_commanded(*axis) for axis in self._axes)
        if drains or self._charges:
            had_charge = battery.charge > 0.0
            load = self._load if drains and (had_charge or self._charges) else 0.0
            charging = self._charging_current if self._charges and battery.part < _FULL else 0.0
            battery.draw(load, charging, self.simulation.time_step)
            if had_charge and battery.charge == 0.0:
                write_line(sys.stderr, f"warning: {self.parameters.title}: battery {self._name} is empty")
        if self._rate.due() and self.is_needed(self._publisher):
            seconds, nanoseconds = self.bridge.now()
            stamp = float(seconds + nanoseconds * 1e-9)
            self.bridge.publish(self._publisher, self._message(stamp, drains=drains))

    def _message(self, stamp: float, *, drains: bool) -> Message:
        battery = self._battery
        if self._charges:
            status = _CHARGING
        elif drains:
            status = _DISCHARGING
        else:
            status = _FULLY_CHARGED if battery.part > _FULL else _NOT_CHARGING
        return {
            "header": {"stamp": stamp},
            "voltage": battery.voltage,
            "current": battery.current,
            "charge": battery.charge,
            "capacity": battery.capacity,
            "percentage": battery.part,
            "power_supply_status": status,
            "present": True,
        }
