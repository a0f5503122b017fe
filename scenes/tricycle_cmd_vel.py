#python
# SPDX-License-Identifier: BSD-3-Clause
# ROS interface of the tricycle with velocity commands: subscribes to /cmd_vel (Twist) instead of /steering and /speed;
# publishes the same topics as tricycle.py.
include tricycle

from bubblesim.controllers.planar_motion import Velocity
from bubblesim.controllers.tricycle_drive import Tricycle, front_wheel

TIMEOUT = 0.6  # s without a command after which the tricycle stops


def sysCall_init():
    find_parts()
    self.tricycle = Tricycle()
    self.last_command = None  # its time; None when stopped
    if simROS:
        simROS.subscribe('/cmd_vel', 'geometry_msgs/Twist', on_velocity)


def on_velocity(twist):
    wanted = Velocity(twist['linear']['x'], twist['angular']['z'])
    try:
        wheel = front_wheel(self.tricycle, wanted, sim.getJointTargetPosition(self.steering))
    except ValueError as error:
        sim.addLog(sim.verbosity_scriptwarnings, f'/cmd_vel: {error}; ignored')
        return
    self.last_command = sim.getSimulationTime()
    sim.setJointTargetPosition(self.steering, wheel.steering)
    sim.setJointTargetVelocity(self.motor, wheel.speed)


def sysCall_actuation():
    if self.last_command is not None and sim.getSimulationTime() - self.last_command > TIMEOUT:
        self.last_command = None
        sim.setJointTargetVelocity(self.motor, 0.0)
