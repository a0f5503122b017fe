# SPDX-License-Identifier: BSD-3-Clause
"""The class of each plugin."""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from bubblesim.gazebo_plugins.control.ros_control import Ros2Control, RosControl
from bubblesim.gazebo_plugins.drives.ackermann_drive import AckermannDrive
from bubblesim.gazebo_plugins.drives.diff_drive import DiffDrive
from bubblesim.gazebo_plugins.drives.gazebo_drives import GazeboDiffDrive, GazeboSkidSteerDrive
from bubblesim.gazebo_plugins.drives.gz_ackermann_steering import GzAckermannSteering
from bubblesim.gazebo_plugins.drives.gz_diff_drive import GzDiffDrive
from bubblesim.gazebo_plugins.drives.gz_odometry_publisher import GzOdometryPublisher
from bubblesim.gazebo_plugins.drives.gz_tracks import GzTrackController, GzTrackedVehicle
from bubblesim.gazebo_plugins.drives.gz_velocity_control import GzVelocityControl
from bubblesim.gazebo_plugins.drives.kobuki import Kobuki
from bubblesim.gazebo_plugins.drives.planar_move import ForceBasedMove, PlanarMove
from bubblesim.gazebo_plugins.drives.skid_steer_drive import SkidSteerDrive
from bubblesim.gazebo_plugins.drives.tricycle_drive import TricycleDrive
from bubblesim.gazebo_plugins.drives.wheel_slip import WheelSlip
from bubblesim.gazebo_plugins.forces.buoyancy import GzBuoyancy, ModelBuoyancy
from bubblesim.gazebo_plugins.forces.hydrodynamics import Hydrodynamics
from bubblesim.gazebo_plugins.forces.lift_drag import LiftDrag
from bubblesim.gazebo_plugins.forces.multicopter_motor import MulticopterMotor
from bubblesim.gazebo_plugins.forces.multicopter_velocity import MulticopterVelocity
from bubblesim.gazebo_plugins.forces.wind_effects import WindEffects
from bubblesim.gazebo_plugins.joints.detachable_joint import DetachableJoint
from bubblesim.gazebo_plugins.joints.grasp_fix import GraspFix
from bubblesim.gazebo_plugins.joints.gz_joint_controllers import (
    GzApplyJointForce,
    GzJointController,
    GzJointPositionController,
)
from bubblesim.gazebo_plugins.joints.joint_pose_trajectory import JointPoseTrajectory
from bubblesim.gazebo_plugins.joints.joint_state_publisher import GzJointStatePublisher, JointStatePublisher
from bubblesim.gazebo_plugins.joints.mimic_joint import MimicJoint
from bubblesim.gazebo_plugins.own_plugins import own_plugin
from bubblesim.gazebo_plugins.plugin import Plugin
from bubblesim.gazebo_plugins.sensors.baro import Baro
from bubblesim.gazebo_plugins.sensors.block_laser import BlockLaser, VelodyneLaser
from bubblesim.gazebo_plugins.sensors.bumper import Bumper
from bubblesim.gazebo_plugins.sensors.camera import Camera
from bubblesim.gazebo_plugins.sensors.depth_camera import DepthCamera, OpenniKinect
from bubblesim.gazebo_plugins.sensors.ft_sensor import FtSensor
from bubblesim.gazebo_plugins.sensors.gps import Gps
from bubblesim.gazebo_plugins.sensors.gz_battery import GzBattery
from bubblesim.gazebo_plugins.sensors.imu import HectorImu, ImuSensor, LinkImu
from bubblesim.gazebo_plugins.sensors.laser import Laser
from bubblesim.gazebo_plugins.sensors.magnetic import Magnetic
from bubblesim.gazebo_plugins.sensors.multi_camera import MultiCamera
from bubblesim.gazebo_plugins.sensors.p3d import P3D
from bubblesim.gazebo_plugins.sensors.range import HectorSonar, Range
from bubblesim.gazebo_plugins.sensors.ray_sensor import RaySensor
from bubblesim.messages.names import did_you_mean, nearest_names

# By the name that ``library`` returns.
PLUGINS: dict[str, type[Plugin]] = {
    "BuoyancyPlugin": ModelBuoyancy,
    "DiffDrivePlugin": GazeboDiffDrive,
    "LiftDragPlugin": LiftDrag,
    "SkidSteerDrivePlugin": GazeboSkidSteerDrive,
    "WheelSlipPlugin": WheelSlip,
    "WindPlugin": WindEffects,
    "gazebo_ros_ackermann_drive": AckermannDrive,
    "gazebo_ros_block_laser": BlockLaser,
    "gazebo_ros_bumper": Bumper,
    "gazebo_ros_camera": Camera,
    "gazebo_ros_depth_camera": DepthCamera,
    "gazebo_ros_diff_drive": DiffDrive,
    "gazebo_ros2_control": Ros2Control,
    "gazebo_ros_control": RosControl,
    "gazebo_ros_force_based_move": ForceBasedMove,
    "gazebo_ros_ft_sensor": FtSensor,
    "gazebo_grasp_fix": GraspFix,
    "gazebo_ros_gpu_laser": Laser,
    "gazebo_ros_imu": LinkImu,
    "gazebo_ros_imu_sensor": ImuSensor,
    "gazebo_ros_joint_pose_trajectory": JointPoseTrajectory,
    "gazebo_ros_joint_state_publisher": JointStatePublisher,
    "gazebo_ros_kobuki": Kobuki,
    "gazebo_ros_laser": Laser,
    "gazebo_ros_multicamera": MultiCamera,
    "gazebo_ros_openni_kinect": OpenniKinect,
    "gazebo_ros_p3d": P3D,
    "gazebo_ros_planar_move": PlanarMove,
    "gazebo_ros_range": Range,
    "gazebo_ros_ray_sensor": RaySensor,
    "gazebo_ros_skid_steer_drive": SkidSteerDrive,
    "gazebo_ros_tricycle_drive": TricycleDrive,
    "gazebo_mimic_joint_plugin": MimicJoint,
    "hector_gazebo_ros_baro": Baro,
    "hector_gazebo_ros_gps": Gps,
    "hector_gazebo_ros_imu": HectorImu,
    "hector_gazebo_ros_magnetic": Magnetic,
    "hector_gazebo_ros_sonar": HectorSonar,
    "gazebo_ros_wheel_slip": WheelSlip,
    "gazebo_ros_velodyne_gpu_laser": VelodyneLaser,
    "gazebo_ros_velodyne_laser": VelodyneLaser,
    "gz_ros2_control-system": Ros2Control,
    "ign_ros2_control-system": Ros2Control,
    "gz-ackermann-steering-system": GzAckermannSteering,
    "gz-buoyancy-system": GzBuoyancy,
    "gz-detachable-joint-system": DetachableJoint,
    "gz-diff-drive-system": GzDiffDrive,
    "gz-hydrodynamics-system": Hydrodynamics,
    "gz-lift-drag-system": LiftDrag,
    "gz-linearbatteryplugin-system": GzBattery,
    "gz-multicopter-control-system": MulticopterVelocity,
    "gz-multicopter-motor-model-system": MulticopterMotor,
    "gz-odometry-publisher-system": GzOdometryPublisher,
    "gz-track-controller-system": GzTrackController,
    "gz-tracked-vehicle-system": GzTrackedVehicle,
    "gz-wheel-slip-system": WheelSlip,
    "gz-wind-effects-system": WindEffects,
    "gz-velocity-control-system": GzVelocityControl,
    "roboticsgroup_gazebo_mimic_joint_plugin": MimicJoint,
    "roboticsgroup_upatras_gazebo_mimic_joint_plugin": MimicJoint,
    "rotors_gazebo_motor_model": MulticopterMotor,
    "gz-apply-joint-force-system": GzApplyJointForce,
    "gz-joint-controller-system": GzJointController,
    "gz-joint-position-controller-system": GzJointPositionController,
    "gz-joint-state-publisher-system": GzJointStatePublisher,
}

# Built into the simulator here, or part of Gazebo's user interface.
NOT_NEEDED = frozenset(
    {
        "gazebo_ros_api_plugin",
        "gazebo_ros_paths_plugin",
        "gazebo_ros_init",
        "gazebo_ros_factory",
        "RayPlugin",
        "CameraPlugin",
        "DepthCameraPlugin",
        "ImuSensorPlugin",
        "ContactPlugin",
        "gz-physics-system",
        "gz-sensors-system",
        "gz-scene-broadcaster-system",
        "gz-user-commands-system",
        "gz-contact-system",
        "gz-imu-system",
        "gz-forcetorque-system",
        "gz-navsat-system",
        "gz-altimeter-system",
        "gz-magnetometer-system",
        "gz-air-pressure-system",
        "gz-logical-camera-system",
    }
)


def library(filename: str) -> str:
    """Return the library of a file name without the parts that depend on system and version.

    libgazebo_ros_laser.so -> gazebo_ros_laser; libignition-gazebo6-diff-drive-system.so -> gz-diff-drive-system
    """
    name = PurePosixPath(filename).name.removesuffix(".so").removeprefix("lib")
    return re.sub(r"^(?:ignition-gazebo|gz-sim)\d*-", "gz-", name)


def plugin_class(filename: str) -> type[Plugin] | None:
    """Return the class of a plugin: of those here, or else of the user's; None if there is none.

    :raises OwnPluginError: if it is the user's and cannot be loaded.
    """
    return PLUGINS.get(library(filename)) or own_plugin(filename)


def why_unknown(name: str) -> str:
    """Return the message for a plugin that is not supported."""
    return f"plugin is not supported{did_you_mean(nearest_names(name, sorted(PLUGINS)))}; the model runs without it"
