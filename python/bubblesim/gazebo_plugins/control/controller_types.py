# SPDX-License-Identifier: BSD-3-Clause
"""The class of each type of controllers."""

from __future__ import annotations

from bubblesim.gazebo_plugins.control.base_controllers import (
    AckermannSteering,
    DiffDrive,
    FourWheelSteering,
    MecanumDrive,
)
from bubblesim.gazebo_plugins.control.controller import Controller
from bubblesim.gazebo_plugins.control.gripper_controller import GripperAction
from bubblesim.gazebo_plugins.control.joint_controllers import (
    ForwardController,
    ForwardGroupController,
    JointStateController,
    PidGroupController,
    PidJointController,
    of_kind,
)
from bubblesim.gazebo_plugins.control.sensor_controllers import ForceTorqueSensors, ImuSensors
from bubblesim.gazebo_plugins.control.trajectory_controller import JointTrajectory

CONTROLLERS: dict[str, type[Controller]] = {
    "ackermann_steering_controller/AckermannSteeringController": AckermannSteering,
    "diff_drive_controller/DiffDriveController": DiffDrive,
    "effort_controllers/GripperActionController": GripperAction,
    "effort_controllers/JointEffortController": ForwardController,
    "effort_controllers/JointGroupEffortController": ForwardGroupController,
    "effort_controllers/JointGroupPositionController": PidGroupController,
    "effort_controllers/JointPositionController": PidJointController,
    "effort_controllers/JointTrajectoryController": JointTrajectory,
    "effort_controllers/JointVelocityController": of_kind(PidJointController, "effort", "velocity"),
    "force_torque_sensor_controller/ForceTorqueSensorController": ForceTorqueSensors,
    "four_wheel_steering_controller/FourWheelSteeringController": FourWheelSteering,
    "imu_sensor_controller/ImuSensorController": ImuSensors,
    "joint_state_controller/JointStateController": JointStateController,
    "mecanum_drive_controller/MecanumDriveController": MecanumDrive,
    "position_controllers/GripperActionController": of_kind(GripperAction, "position"),
    "position_controllers/JointGroupPositionController": of_kind(ForwardGroupController, "position"),
    "position_controllers/JointPositionController": of_kind(ForwardController, "position"),
    "position_controllers/JointTrajectoryController": of_kind(JointTrajectory, "position"),
    "velocity_controllers/JointGroupVelocityController": of_kind(ForwardGroupController, "velocity"),
    "velocity_controllers/JointPositionController": of_kind(PidJointController, "velocity"),
    "velocity_controllers/JointTrajectoryController": of_kind(JointTrajectory, "velocity"),
    "velocity_controllers/JointVelocityController": of_kind(ForwardController, "velocity"),
}
