// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.reading_messages: standard messages made of readings.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/messages/fields.hpp"
#include "bubblesim/world.hpp"
#include "camera_messages.hpp"
#include "contact_messages.hpp"
#include "guarded.hpp"
#include "held_readings.hpp"
#include "lidar_messages.hpp"
#include "motion_messages.hpp"
#include "vector_messages.hpp"
#include "world_poses.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
namespace make = reading_messages;
using make::Header;
using messages::FieldReader;
using messages::Fields;

using Numbers3 = std::array<double, 3>;
using Numbers4 = std::array<double, 4>;
using Numbers6 = std::array<double, 6>;

constexpr Numbers3 kExact{};
constexpr Numbers4 kNoTurn{0, 0, 0, 1};

template <class PutFields>
class ReadingMessage final : public FieldReader {
 public:
  explicit ReadingMessage(PutFields put_fields) : put_fields_(std::move(put_fields)) {}
  void read(Fields& fields) const override { put_fields_(fields); }

 private:
  PutFields put_fields_;
};

/// A message that holds what `put_fields` captures.
template <class PutFields>
std::unique_ptr<FieldReader> message(PutFields put_fields) {
  return std::make_unique<ReadingMessage<PutFields>>(std::move(put_fields));
}

Vector3 vector_of(const Numbers3& v) { return {v[0], v[1], v[2]}; }
Quaternion rotation_of(const Numbers4& q) { return {q[3], q[0], q[1], q[2]}; }

/// Adds three of the numbers to each vector.
void add(const Numbers6& numbers, Vector3& first, Vector3& second) {
  first += Vector3(numbers[0], numbers[1], numbers[2]);
  second += Vector3(numbers[3], numbers[4], numbers[5]);
}

void bind_scans(py::module_& m) {
  m.def(
      "laser_scan",
      [](Header header, HeldScan scan, std::optional<int> ring) {
        if (ring && (*ring < 0 || *ring >= scan->vertical.samples)) throw py::index_error("no such ring of the scan");
        return message([=](Fields& fields) { make::laser_scan(fields, header, *scan, ring); });
      },
      py::arg("header"), py::arg("scan"), py::arg("ring") = py::none(),
      "Return a sensor_msgs/LaserScan of one ring, or of all one after the other.");
  m.def(
      "lidar_cloud",
      [](Header header, HeldScan scan, double least, double most, bool organized) {
        return message([=](Fields& fields) { make::lidar_cloud(fields, header, *scan, {least, most, organized}); });
      },
      py::arg("header"), py::arg("scan"), py::arg("least") = make::CloudOptions().least,
      py::arg("most") = make::CloudOptions().most, py::arg("organized") = make::CloudOptions().organized,
      "Return a sensor_msgs/PointCloud2 of the returns between two ranges, m: x, y, z, intensity, ring and time, as in "
      "velodyne_pointcloud. An organized cloud has all rays, and NaN for those without a return.");
  m.def(
      "lidar_points",
      [](Header header, HeldScan scan) {
        return message([=](Fields& fields) { make::lidar_points(fields, header, *scan); });
      },
      py::arg("header"), py::arg("scan"),
      "Return a sensor_msgs/PointCloud with intensities; rays without a return end at the maximum range.");
  m.def(
      "nearest_range", [](const HeldScan& scan) { return make::nearest_range(*scan); }, py::arg("scan"),
      "Return the nearest range, m; infinite without a return.");
  m.def(
      "range",
      [](Header header, int radiation, double field_of_view, double min_range, double max_range, double range) {
        const make::RangeReading reading{static_cast<std::uint8_t>(radiation), field_of_view, min_range, max_range,
                                         range};
        return message([=](Fields& fields) { make::range(fields, header, reading); });
      },
      py::arg("header"), py::arg("radiation"), py::arg("field_of_view"), py::arg("min_range"), py::arg("max_range"),
      py::arg("range"), "Return a sensor_msgs/Range; radians and metres.");
}

void bind_images(py::module_& m) {
  m.def(
      "color_image",
      [](Header header, HeldImage image) {
        return message([=](Fields& fields) { make::color_image(fields, header, *image); });
      },
      py::arg("header"), py::arg("image"), "Return a sensor_msgs/Image, rgb8.");
  m.def(
      "depth_image",
      [](Header header, HeldImage image, const std::optional<std::pair<double, double>>& limits) {
        std::optional<make::DepthLimits> depths;
        if (limits) depths = make::DepthLimits{limits->first, limits->second};
        return message([=](Fields& fields) { make::depth_image(fields, header, *image, depths); });
      },
      py::arg("header"), py::arg("image"), py::arg("limits") = py::none(),
      "Return a sensor_msgs/Image of depths in metres, 32FC1; those not between the limits are NaN.");
  m.def(
      "camera_cloud",
      [](Header header, HeldImage image, std::pair<double, double> limits, bool optical) {
        const make::DepthLimits depths{limits.first, limits.second};
        const CloudAxes axes = optical ? CloudAxes::kOptical : CloudAxes::kSensor;
        return message([=](Fields& fields) { make::camera_cloud(fields, header, *image, depths, axes); });
      },
      py::arg("header"), py::arg("image"), py::arg("limits"), py::arg("optical"),
      "Return a sensor_msgs/PointCloud2 with colours, in the sensor's axes, or with z forward and x to the right. "
      "Points whose depth is not between the limits, m, are NaN.");
  m.def(
      "camera_info",
      [](Header header, int width, int height, double focal_length, double x, double y, double baseline,
         const std::array<double, 5>& distortion) {
        const make::Pinhole camera{width, height, focal_length, x, y, baseline, distortion};
        return message([=](Fields& fields) { make::camera_info(fields, header, camera); });
      },
      py::arg("header"), py::arg("width"), py::arg("height"), py::arg("focal_length"), py::arg("x"), py::arg("y"),
      py::arg("baseline"), py::arg("distortion"),
      "Return a sensor_msgs/CameraInfo of a pinhole camera; pixels and metres.");
  m.def(
      "compressed_image",
      [](Header header, std::string format, const py::array_t<std::uint8_t, py::array::c_style>& data) {
        const std::string_view bytes(reinterpret_cast<const char*>(data.data()), static_cast<std::size_t>(data.size()));
        return message([=](Fields& fields) { make::compressed_image(fields, header, format, bytes); });
      },
      py::arg("header"), py::arg("format"), py::arg("data").noconvert(), py::keep_alive<0, 3>(),
      "Return a sensor_msgs/CompressedImage.");
}

/// `variances`: of orientation and angular velocity.
std::unique_ptr<FieldReader> imu_message(Header header, const ImuReading& reading, const Numbers3& variances,
                                         const Numbers3& linear_acceleration_variances) {
  const make::ImuVariances all{variances, variances, linear_acceleration_variances};
  return message([=](Fields& fields) { make::imu(fields, header, reading, all); });
}

void bind_vectors(py::module_& m) {
  m.def(
      "imu",
      [](Header header, const HeldImu& reading, const Numbers3& variances,
         const Numbers3& linear_acceleration_variances, const Numbers4& turn, const std::optional<Numbers6>& noise) {
        ImuReading changed = *reading;
        if (turn != kNoTurn) changed.orientation = rotation_of(turn) * changed.orientation;
        if (noise) add(*noise, changed.angular_velocity, changed.linear_acceleration);
        return imu_message(std::move(header), changed, variances, linear_acceleration_variances);
      },
      py::arg("header"), py::arg("reading"), py::arg("variances") = kExact,
      py::arg("linear_acceleration_variances") = kExact, py::arg("turn") = kNoTurn, py::arg("noise") = py::none(),
      "Return a sensor_msgs/Imu. `variances` are those of orientation and angular velocity, `turn` is a rotation after "
      "that of the reading, and `noise` is added to angular velocity and linear acceleration.");
  m.def(
      "imu_of_values",
      [](Header header, const Numbers4& q, const Numbers3& angular_velocity, const Numbers3& linear_acceleration,
         const Numbers3& variances, const Numbers3& linear_acceleration_variances) {
        const ImuReading reading{rotation_of(q), vector_of(angular_velocity), vector_of(linear_acceleration)};
        return imu_message(std::move(header), reading, variances, linear_acceleration_variances);
      },
      py::arg("header"), py::arg("orientation"), py::arg("angular_velocity"), py::arg("linear_acceleration"),
      py::arg("variances"), py::arg("linear_acceleration_variances"),
      "Return a sensor_msgs/Imu; `variances` are those of orientation and angular velocity.");
  m.def(
      "nav_sat_fix",
      [](Header header, double latitude, double longitude, double altitude, int status, int service,
         const std::optional<Numbers3>& variances) {
        constexpr std::uint8_t kDiagonalKnown = 2;
        const NavSatReading reading{latitude, longitude, altitude, Vector3::Zero()};
        make::FixQuality quality;
        quality.status = static_cast<std::int8_t>(status);
        quality.service = static_cast<std::uint16_t>(service);
        quality.variances = variances.value_or(Numbers3{});
        quality.variances_kind = variances ? kDiagonalKnown : 0;
        return message([=](Fields& fields) { make::nav_sat_fix(fields, header, reading, quality); });
      },
      py::arg("header"), py::arg("latitude"), py::arg("longitude"), py::arg("altitude"), py::arg("status") = 0,
      py::arg("service") = 1, py::arg("variances") = py::none(),
      "Return a sensor_msgs/NavSatFix: degrees, m; `variances` of the position, m^2, None if unknown.");
  m.def(
      "magnetic_field",
      [](Header header, const Numbers3& field) {
        return message([=](Fields& fields) { make::magnetic_field(fields, header, vector_of(field)); });
      },
      py::arg("header"), py::arg("field"), "Return a sensor_msgs/MagneticField, T.");
  m.def(
      "point",
      [](Header header, const Numbers3& point) {
        return message([=](Fields& fields) { make::point(fields, header, vector_of(point)); });
      },
      py::arg("header"), py::arg("point"), "Return a geometry_msgs/PointStamped.");
  m.def(
      "vector",
      [](Header header, const Numbers3& vector) {
        return message([=](Fields& fields) { make::vector(fields, header, vector_of(vector)); });
      },
      py::arg("header"), py::arg("vector"), "Return a geometry_msgs/Vector3Stamped.");
  m.def(
      "wrench",
      [](Header header, const HeldForceTorque& held, const std::optional<Numbers6>& noise) {
        ForceTorqueReading reading = *held;
        if (noise) add(*noise, reading.force, reading.torque);
        return message([=](Fields& fields) { make::wrench(fields, header, reading); });
      },
      py::arg("header"), py::arg("reading"), py::arg("noise") = py::none(),
      "Return a geometry_msgs/WrenchStamped; `noise` is added to force and torque.");
}

void bind_motions(py::module_& m) {
  m.def(
      "odometry",
      [](Header header, std::string child_frame, const Pose7& pose, const Numbers3& linear, const Numbers3& angular,
         const Numbers6& pose_variances, const Numbers6& velocity_variances) {
        const make::OdometryReading reading{std::move(child_frame),
                                            to_pose(pose),
                                            {vector_of(linear), vector_of(angular)},
                                            pose_variances,
                                            velocity_variances};
        return message([=](Fields& fields) { make::odometry(fields, header, reading); });
      },
      py::arg("header"), py::arg("child_frame"), py::arg("pose"), py::arg("linear"), py::arg("angular"),
      py::arg("pose_variances"), py::arg("velocity_variances"),
      "Return a nav_msgs/Odometry; variances are those of x, y, z and of the rotations about them.");
  Guarded(m).def(
      "joint_state",
      [](const World& world, Header header, const std::vector<ObjectId>& joints) {
        make::JointReadings readings = make::read_joints(world, joints);
        return message(
            [header, readings = std::move(readings)](Fields& fields) { make::joint_state(fields, header, readings); });
      },
      py::arg("world"), py::arg("header"), py::arg("joints"),
      "Return a sensor_msgs/JointState of the joints' first axes; the effort is that of the motor, the mean over the "
      "step.");
  py::class_<make::TransformReading>(m, "Transform", "A pose of a frame in the frame of a header.")
      .def(py::init([](Header header, std::string child_frame, const Pose7& pose) {
             return make::TransformReading{std::move(header), std::move(child_frame), to_pose(pose)};
           }),
           py::arg("header"), py::arg("child_frame"), py::arg("pose"));
  m.def(
      "transforms",
      [](std::vector<make::TransformReading> transforms) {
        return message([transforms = std::move(transforms)](Fields& fields) { make::transforms(fields, transforms); });
      },
      py::arg("transforms"), "Return a tf2_msgs/TFMessage.");
}

}  // namespace

void bind_reading_messages(py::module_& core) {
  py::module_ m = core.def_submodule(
      "reading_messages", "Standard messages made of readings. Bridge.publish() and messages.encode() take them.");
  py::class_<FieldReader>(m, "ReadingMessage", "The fields of a message; it holds what it was made of.");
  py::class_<Header>(m, "Header", "A std_msgs/Header; the sequence number is that of the connection.")
      .def(py::init([](std::uint32_t sec, std::uint32_t nanosec, std::string frame) {
             return Header{{sec, nanosec}, std::move(frame)};
           }),
           py::arg("sec"), py::arg("nanosec"), py::arg("frame"));
  bind_scans(m);
  bind_images(m);
  bind_vectors(m);
  bind_motions(m);
  Guarded(m).def(
      "contacts_state",
      [](const World& world, Header header, ObjectId link, const HeldContacts& reading, ObjectId reference) {
        auto touches = make::read_touches(world, link, *reading, reference);
        return message(
            [header, touches = std::move(touches)](Fields& fields) { make::contacts_state(fields, header, touches); });
      },
      py::arg("world"), py::arg("header"), py::arg("link"), py::arg("reading"), py::arg("reference") = kNoObject,
      "Return a gazebo_msgs/ContactsState of a link, in the frame of another object or of the world.");
}

}  // namespace bubblesim::bindings
