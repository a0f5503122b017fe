# SPDX-License-Identifier: BSD-3-Clause
"""Messages made of readings, as rospy reads them, in the scene `sensors`: a room with known walls."""

from typing import Any

import numpy as np
import pytest
from bubblesim._core import messages, read_contacts, read_imu
from bubblesim._core import reading_messages as make

import bubblesim
from message_support import genpy_class

CLOCK = make.Clock()
CLOCK.set(12, 345)
HEADER = make.Header(CLOCK, "frame")
POSE = [1.0, 2.0, 3.0, 0.0, 0.6, 0.0, 0.8]
LINEAR, ANGULAR = (4.0, 5.0, 6.0), (0.4, 0.5, 0.6)


@pytest.fixture(scope="module")
def room() -> bubblesim.Simulation:
    return bubblesim.Simulation("sensors")


def read(name: str, message: Any) -> Any:
    """Return rospy's object of a message."""
    received = genpy_class(name)().deserialize(messages.encode(name, message))
    if hasattr(received, "header"):
        header = received.header
        assert (header.seq, header.stamp.secs, header.stamp.nsecs, header.frame_id) == (0, 12, 345, "frame")
    return received


def xyz(vector: Any) -> tuple[float, ...]:
    return vector.x, vector.y, vector.z


def pose_of(pose: Any) -> list[float]:
    q = pose.orientation
    return [*xyz(pose.position), *xyz(q), q.w]


def matrix(*diagonal: float) -> tuple[float, ...]:
    return tuple(np.diag(diagonal).ravel())


def points(cloud: Any) -> np.ndarray[Any, Any]:
    """Return the points of a PointCloud2 by field name."""
    assert not cloud.is_bigendian
    assert cloud.row_step == cloud.point_step * cloud.width
    kinds = {4: "<u2", 7: "<f4"}
    point = np.dtype(
        {
            "names": [field.name for field in cloud.fields],
            "formats": [kinds[field.datatype] for field in cloud.fields],
            "offsets": [field.offset for field in cloud.fields],
            "itemsize": cloud.point_step,
        }
    )
    assert {field.count for field in cloud.fields} == {1}
    return np.frombuffer(cloud.data, point).reshape(cloud.height, cloud.width)


@pytest.mark.parametrize("ring", [None, 0, 3])
def test_a_scan_has_all_rings_or_one(room: bubblesim.Simulation, ring: int | None) -> None:
    scan = room.object("/RingLidar").reading
    message = read("sensor_msgs/LaserScan", make.laser_scan(HEADER, scan, ring))
    kept = slice(None) if ring is None else slice(ring, ring + 1)
    assert message.ranges == tuple(scan.ranges[kept].ravel())
    assert message.intensities == tuple(scan.intensities[kept].ravel())
    assert message.angle_increment == pytest.approx((message.angle_max - message.angle_min) / 899)
    assert (message.angle_min, message.angle_max) == pytest.approx((scan.angles[0], scan.angles[-1]))
    assert (message.range_min, message.range_max) == pytest.approx((0.1, 8.0))


@pytest.mark.parametrize("ring", [-1, 16])
def test_a_scan_of_a_ring_that_is_missing_is_refused(room: bubblesim.Simulation, ring: int) -> None:
    with pytest.raises(IndexError, match="ring"):
        make.laser_scan(HEADER, room.object("/RingLidar").reading, ring)


def test_a_lidar_cloud_has_the_returns_between_two_ranges(room: bubblesim.Simulation) -> None:
    scan = room.object("/RingLidar").reading
    message = read("sensor_msgs/PointCloud2", make.lidar_cloud(HEADER, scan, 2.0, 4.0))
    cloud = points(message)[0]
    met = (scan.ranges > 2.0) & (scan.ranges < 4.0)
    assert 0 < met.sum() < met.size
    assert (len(cloud), message.is_dense) == (met.sum(), True)
    places = np.stack([cloud[axis] for axis in "xyz"], axis=1)
    np.testing.assert_allclose(np.linalg.norm(places, axis=1), scan.ranges[met], rtol=1e-6)
    rings, samples = np.nonzero(met)
    np.testing.assert_allclose(np.arcsin(cloud["z"] / scan.ranges[met]), scan.elevations[rings], atol=1e-6)
    turns = np.arctan2(cloud["y"], cloud["x"]) - scan.angles[samples]
    np.testing.assert_allclose(np.remainder(turns + np.pi, 2 * np.pi), np.pi, atol=1e-6)
    assert cloud["ring"].tolist() == rings.tolist()
    assert cloud["intensity"].tolist() == scan.intensities[met].tolist()
    assert not cloud["time"].any()


def test_an_organized_cloud_has_all_rays(room: bubblesim.Simulation) -> None:
    scan = room.object("/RingLidar").reading
    message = read("sensor_msgs/PointCloud2", make.lidar_cloud(HEADER, scan, organized=True))
    cloud = points(message)
    assert (cloud.shape, message.is_dense) == (scan.ranges.shape, False)
    np.testing.assert_array_equal(np.isnan(cloud["x"]), np.isinf(scan.ranges))
    np.testing.assert_allclose(cloud["x"][np.isfinite(scan.ranges)].max(), 4.0, atol=0.05)  # the front wall


def test_lidar_points_without_a_return_end_at_the_maximum_range(room: bubblesim.Simulation) -> None:
    scan = room.object("/RingLidar").reading
    message = read("sensor_msgs/PointCloud", make.lidar_points(HEADER, scan))
    lengths = np.linalg.norm([xyz(point) for point in message.points], axis=1)
    np.testing.assert_allclose(lengths, np.minimum(scan.ranges, 8.0).ravel(), rtol=1e-6)
    assert [channel.name for channel in message.channels] == ["intensities"]
    assert message.channels[0].values == tuple(scan.intensities.ravel())


def test_a_range_is_what_it_is_given(room: bubblesim.Simulation) -> None:
    message = read("sensor_msgs/Range", make.range(HEADER, 1, 0.2, 0.1, 4.0, np.inf))
    assert (message.radiation_type, message.range) == (1, np.inf)
    assert (message.field_of_view, message.min_range, message.max_range) == pytest.approx((0.2, 0.1, 4.0))
    scan = room.object("/Lidar").reading
    assert make.nearest_range(scan) == scan.ranges.min()


def test_a_picture_has_its_pixels(room: bubblesim.Simulation) -> None:
    image = room.object("/Camera").reading
    message = read("sensor_msgs/Image", make.color_image(HEADER, image))
    assert (message.width, message.height, message.step) == (640, 480, 1920)
    assert (message.encoding, message.is_bigendian) == ("rgb8", 0)
    assert message.data == image.rgb.tobytes()


@pytest.mark.parametrize("limits", [None, (2.0, 4.5)])
def test_depths_outside_of_limits_are_no_numbers(
    room: bubblesim.Simulation, limits: tuple[float, float] | None
) -> None:
    image = room.object("/DepthCamera").reading
    height, width = image.depth.shape
    message = read("sensor_msgs/Image", make.depth_image(HEADER, image, limits))
    assert (message.width, message.height, message.step) == (width, height, 4 * width)
    assert (message.encoding, message.is_bigendian) == ("32FC1", 0)
    depths = np.frombuffer(message.data, "<f4").reshape(height, width)
    inside = np.full(depths.shape, True) if limits is None else (image.depth > limits[0]) & (image.depth < limits[1])
    assert limits is None or 0 < inside.sum() < inside.size
    np.testing.assert_array_equal(depths, np.where(inside, image.depth, np.nan))


@pytest.mark.parametrize("optical", [False, True])
@pytest.mark.parametrize("limits", [(-np.inf, np.inf), (2.0, 4.5)])
def test_points_of_a_camera_lie_on_the_rays_of_its_pixels(
    room: bubblesim.Simulation, limits: tuple[float, float], optical: bool
) -> None:
    image = room.object("/Camera").reading
    message = read("sensor_msgs/PointCloud2", make.camera_cloud(HEADER, image, limits, optical))
    cloud = points(message)
    inside = (image.depth > limits[0]) & (image.depth < limits[1])
    assert (cloud.shape, message.is_dense) == ((480, 640), bool(inside.all()))
    focal = 320 / np.tan(image.horizontal_fov / 2)
    right = (np.arange(640) - 319.5)[None, :] / focal * image.depth
    down = (np.arange(480) - 239.5)[:, None] / focal * image.depth
    expected = (right, down, image.depth) if optical else (image.depth, -right, -down)
    for axis, values in zip("xyz", expected, strict=True):
        np.testing.assert_allclose(cloud[axis][inside], values[inside], rtol=1e-5, atol=1e-6)
        assert np.isnan(cloud[axis][~inside]).all()
    colors = cloud["rgb"].view("<u4")
    red, green, blue = (image.rgb[:, :, i].astype(np.uint32) for i in range(3))
    np.testing.assert_array_equal(colors, red << 16 | green << 8 | blue)


def test_the_info_of_a_camera_has_its_matrices() -> None:
    distortion = [0.1, 0.2, 0.3, 0.4, 0.5]
    message = read("sensor_msgs/CameraInfo", make.camera_info(HEADER, 640, 480, 500.0, 319.0, 239.0, 0.1, distortion))
    assert (message.width, message.height, message.distortion_model) == (640, 480, "plumb_bob")
    assert tuple(distortion) == message.D
    assert message.K == (500, 0, 319, 0, 500, 239, 0, 0, 1)
    assert message.R == (1, 0, 0, 0, 1, 0, 0, 0, 1)
    assert message.P == (500, 0, 319, -50, 0, 500, 239, 0, 0, 0, 1, 0)


def test_a_compressed_image_keeps_its_bytes_alive() -> None:
    message = make.compressed_image(HEADER, "jpeg", np.arange(200, dtype=np.uint8))
    received = read("sensor_msgs/CompressedImage", message)
    assert (received.format, received.data) == ("jpeg", bytes(range(200)))


def test_an_imu_has_turn_noise_and_variances(room: bubblesim.Simulation) -> None:
    sensor = next(s for s in handles(room) if isinstance(room.object(s).reading, bubblesim.ImuReading))
    reading = read_imu(room, room.object(sensor).handle)
    exact = read("sensor_msgs/Imu", make.imu(HEADER, reading))
    assert [*xyz(exact.orientation), exact.orientation.w] == reading.orientation.tolist()
    assert xyz(exact.angular_velocity) == tuple(reading.angular_velocity)
    assert xyz(exact.linear_acceleration) == tuple(reading.linear_acceleration)
    assert exact.orientation_covariance == exact.linear_acceleration_covariance == (0,) * 9
    half = np.sqrt(0.5)
    turned = make.imu(HEADER, reading, (1, 2, 3), (4, 5, 6), (0, 0, half, half), (1, 2, 3, 10, 20, 30))
    changed = read("sensor_msgs/Imu", turned)
    x, y, z, w = reading.orientation
    expected = [half * (x - y), half * (y + x), half * (z + w), half * (w - z)]  # a quarter turn about z, after it
    np.testing.assert_allclose([*xyz(changed.orientation), changed.orientation.w], expected, atol=1e-12)
    assert changed.orientation_covariance == changed.angular_velocity_covariance == matrix(1, 2, 3)
    assert changed.linear_acceleration_covariance == matrix(4, 5, 6)
    assert xyz(changed.angular_velocity) == tuple(reading.angular_velocity + np.array([1, 2, 3]))
    assert xyz(changed.linear_acceleration) == tuple(reading.linear_acceleration + np.array([10, 20, 30]))


def handles(simulation: bubblesim.Simulation) -> list[str]:
    """Return the paths of all sensors."""
    return [each.path for each in simulation.objects if each.kind == "sensor"]


def test_an_imu_may_be_made_of_values() -> None:
    made = make.imu_of_values(HEADER, POSE[3:], ANGULAR, LINEAR, (1, 2, 3), (4, 5, 6))
    message = read("sensor_msgs/Imu", made)
    assert [*xyz(message.orientation), message.orientation.w] == POSE[3:]
    assert (xyz(message.angular_velocity), xyz(message.linear_acceleration)) == (ANGULAR, LINEAR)
    assert message.orientation_covariance == message.angular_velocity_covariance == matrix(1, 2, 3)
    assert message.linear_acceleration_covariance == matrix(4, 5, 6)


def test_a_fix_states_whether_its_variances_are_known() -> None:
    message = read("sensor_msgs/NavSatFix", make.nav_sat_fix(HEADER, 52.0, 13.0, 30.0, 2, 3, (1.0, 2.0, 3.0)))
    assert (message.latitude, message.longitude, message.altitude) == (52, 13, 30)
    assert (message.status.status, message.status.service) == (2, 3)
    assert message.position_covariance == matrix(1, 2, 3)
    assert message.position_covariance_type == message.COVARIANCE_TYPE_DIAGONAL_KNOWN
    unknown = read("sensor_msgs/NavSatFix", make.nav_sat_fix(HEADER, 52.0, 13.0, 30.0))
    assert (unknown.status.status, unknown.status.service) == (0, 1)
    assert unknown.position_covariance_type == unknown.COVARIANCE_TYPE_UNKNOWN


def test_vectors_have_their_fields() -> None:
    assert xyz(read("sensor_msgs/MagneticField", make.magnetic_field(HEADER, LINEAR)).magnetic_field) == LINEAR
    pressure = read("sensor_msgs/FluidPressure", make.fluid_pressure(HEADER, 101325.0, 9.0))
    assert (pressure.fluid_pressure, pressure.variance) == (101325.0, 9.0)
    assert xyz(read("geometry_msgs/PointStamped", make.point(HEADER, LINEAR)).point) == LINEAR
    assert xyz(read("geometry_msgs/Vector3Stamped", make.vector(HEADER, LINEAR)).vector) == LINEAR


def test_odometry_has_pose_velocity_and_their_variances() -> None:
    made = make.odometry(HEADER, "base", POSE, LINEAR, ANGULAR, (1, 2, 3, 4, 5, 6), (7, 8, 9, 10, 11, 12))
    message = read("nav_msgs/Odometry", made)
    assert (message.child_frame_id, pose_of(message.pose.pose)) == ("base", POSE)
    assert (xyz(message.twist.twist.linear), xyz(message.twist.twist.angular)) == (LINEAR, ANGULAR)
    assert message.pose.covariance == matrix(1, 2, 3, 4, 5, 6)
    assert message.twist.covariance == matrix(7, 8, 9, 10, 11, 12)


def test_transforms_have_their_frames() -> None:
    other = make.Clock()
    other.set(1, 2)
    frames = [make.Transform(HEADER, "a", POSE), make.Transform(make.Header(other, "other"), "b", POSE)]
    first, second = read("tf2_msgs/TFMessage", make.transforms(frames)).transforms
    assert (first.child_frame_id, second.child_frame_id, second.header.frame_id) == ("a", "b", "other")
    assert (second.header.stamp.secs, second.header.stamp.nsecs) == (1, 2)
    rotation = first.transform.rotation
    assert [*xyz(first.transform.translation), *xyz(rotation), rotation.w] == POSE


def test_a_message_keeps_its_time() -> None:
    clock = make.Clock()
    header = make.Header(clock, "frame")
    clock.set(12, 345)
    message = make.point(header, LINEAR)
    clock.set(13, 0)
    assert read("geometry_msgs/PointStamped", message).header.stamp.secs == 12
    later = messages.decode(
        "geometry_msgs/PointStamped", messages.encode("geometry_msgs/PointStamped", make.point(header, LINEAR))
    )
    assert later["header"]["stamp"] == {"secs": 13, "nsecs": 0}


ARM = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><model name="arm"><pose>{pose}</pose>
  <link name="base"><inertial><mass>1</mass></inertial>
    <collision name="foot"><geometry><box><size>0.4 0.4 0.2</size></box></geometry></collision>
    <sensor name="touch" type="contact"><contact><collision>foot</collision></contact></sensor></link>
  <link name="tip"><pose>0 0 1 0 0 0</pose><inertial><mass>0.1</mass></inertial></link>
  <joint name="elbow" type="revolute"><parent>base</parent><child>tip</child><axis><xyz>0 0 1</xyz></axis>
    <sensor name="wrench" type="force_torque"/></joint>
</model></sdf>
"""


@pytest.fixture(scope="module")
def arm() -> bubblesim.Simulation:
    simulation = bubblesim.Simulation("ball")
    simulation.add_model(ARM.format(pose="3 2 0.1 0 0 1.5707963267948966"))
    simulation.object("/arm/elbow").target_velocity = 0.5
    simulation.step(10)
    return simulation


def test_joints_have_position_velocity_and_effort(arm: bubblesim.Simulation) -> None:
    elbow = arm.object("/arm/elbow")
    message = read("sensor_msgs/JointState", make.joint_state(arm.world, HEADER, [elbow.handle]))
    assert message.name == ["elbow"]
    values = message.position, message.velocity, message.effort
    assert values == ((elbow.joint_position,), (elbow.joint_velocity,), (elbow.motor_effort,))


def test_a_wrench_has_noise(arm: bubblesim.Simulation) -> None:
    reading = arm.object("/arm/elbow/wrench").reading
    assert abs(reading.force[2]) == pytest.approx(0.1 * 9.81, rel=0.01)
    exact = read("geometry_msgs/WrenchStamped", make.wrench(HEADER, reading)).wrench
    assert (xyz(exact.force), xyz(exact.torque)) == (tuple(reading.force), tuple(reading.torque))
    noisy = read("geometry_msgs/WrenchStamped", make.wrench(HEADER, reading, (1, 2, 3, 4, 5, 6))).wrench
    assert xyz(noisy.force) == tuple(reading.force + np.array([1, 2, 3]))
    assert xyz(noisy.torque) == tuple(reading.torque + np.array([4, 5, 6]))


@pytest.mark.parametrize("reference", [None, "/arm/base"])
def test_contacts_are_in_the_frame_of_the_reference(arm: bubblesim.Simulation, reference: str | None) -> None:
    link = arm.object("/arm/base")
    reading = read_contacts(arm, arm.object("/arm/base/touch").handle)
    frame = -1 if reference is None else arm.object(reference).handle
    message = read("gazebo_msgs/ContactsState", make.contacts_state(arm.world, HEADER, link.handle, reading, frame))
    (state,) = message.states
    assert state.collision1_name == "arm::base::foot"
    assert state.info == f"{state.collision1_name} touches {state.collision2_name}"
    assert xyz(state.total_wrench.force)[2] == pytest.approx(1.1 * 9.81, rel=0.02)
    total = np.sum([xyz(wrench.force) for wrench in state.wrenches], axis=0)
    np.testing.assert_allclose(xyz(state.total_wrench.force), total, atol=1e-9)
    assert [xyz(normal) for normal in state.contact_normals] == [
        pytest.approx((0, 0, 1), abs=1e-3) for _ in state.depths
    ]
    assert state.depths == tuple(point.depth for contact in reading.contacts for point in contact.points)
    places = np.array([xyz(place) for place in state.contact_positions])
    # The foot is 0.4 m wide and at (3, 2) in the world.
    corner = np.abs(places[:, :2] - (0 if reference else (3, 2)))
    np.testing.assert_allclose(corner, 0.2, atol=0.01)


def test_a_message_of_another_type_is_refused(arm: bubblesim.Simulation) -> None:
    message = make.joint_state(arm.world, HEADER, [])
    with pytest.raises(ValueError, match="sensor_msgs/ChannelFloat32: name: expected string, found strings"):
        messages.encode("sensor_msgs/ChannelFloat32", message)
