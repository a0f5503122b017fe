#python
# SPDX-License-Identifier: BSD-3-Clause
# The tricycle that takes velocities: Twist on /cmd_vel, as teleoperation and navigation send them. It tells what
# tricycle.py tells: /front_sonar and tf.
include tricycle

from bubblesim.controllers.planar_motion import Velocity
from bubblesim.controllers.tricycle_drive import Tricycle, front_wheel

PATIENCE = 0.6  # s without a command, after which it stops


def sysCall_init():
    find_parts()
    self.tricycle = Tricycle()
    self.last_command = None  # when the last one came
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
    if self.last_command is not None and sim.getSimulationTime() - self.last_command > PATIENCE:
        self.last_command = None
        sim.setJointTargetVelocity(self.motor, 0.0)
