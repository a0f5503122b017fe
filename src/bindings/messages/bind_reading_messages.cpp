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
#include "lidar_messages.hpp"
#include "motion_messages.hpp"
#include "number_list.hpp"
#include "sensors/held_reading.hpp"
#include "vector_messages.hpp"
#include "world/world_poses.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
namespace make = reading_messages;
using make::Header;
using messages::FieldReader;
using messages::Fields;

constexpr NumberList<3> kExact{};
constexpr NumberList<4> kNoTurn{{0, 0, 0, 1}};

/// The time of the messages of a step.
struct Clock {
  messages::Stamp now;
};

/// A frame whose messages are stamped with the present time of a clock.
struct StampedFrame {
  std::shared_ptr<const Clock> clock;
  std::string frame;

  Header header() const { return {clock->now, frame}; }
};

template <class PutFields>
class ReadingMessage final : public FieldReader {
 public:
  ReadingMessage(Header header, PutFields put_fields)
      : header_(std::move(header)), put_fields_(std::move(put_fields)) {}
  void read(Fields& fields) const override { put_fields_(fields, header_); }

 private:
  Header header_;
  PutFields put_fields_;
};

/// A message that holds what `put_fields` captures.
template <class PutFields>
std::unique_ptr<FieldReader> message(Header header, PutFields put_fields) {
  return std::make_unique<ReadingMessage<PutFields>>(std::move(header), std::move(put_fields));
}

Vector3 vector_of(const NumberList<3>& v) { return {v[0], v[1], v[2]}; }
Quaternion rotation_of(const NumberList<4>& q) { return {q[3], q[0], q[1], q[2]}; }

/// Adds three of the numbers to each vector.
void add(const NumberList<6>& numbers, Vector3& first, Vector3& second) {
  first += Vector3(numbers[0], numbers[1], numbers[2]);
  second += Vector3(numbers[3], numbers[4], numbers[5]);
}

void bind_scans(py::module_& m) {
  m.def(
      "laser_scan",
      [](const StampedFrame& frame, Held<LidarScan> scan, std::optional<int> ring) {
        if (ring && (*ring < 0 || *ring >= scan->vertical.samples)) throw py::index_error("no such ring of the scan");
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::laser_scan(fields, header, *scan, ring); });
      },
      py::arg("header"), py::arg("scan"), py::arg("ring") = py::none(),
      "Return a sensor_msgs/LaserScan of one ring, or of all one after the other.");
  m.def(
      "lidar_cloud",
      [](const StampedFrame& frame, Held<LidarScan> scan, double least, double most, bool organized) {
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::lidar_cloud(fields, header, *scan, {least, most, organized});
        });
      },
      py::arg("header"), py::arg("scan"), py::arg("least") = make::CloudOptions().least,
      py::arg("most") = make::CloudOptions().most, py::arg("organized") = make::CloudOptions().organized,
      "Return a sensor_msgs/PointCloud2 of the returns between two ranges, m: x, y, z, intensity, ring and time, as in "
      "velodyne_pointcloud. An organized cloud has all rays, and NaN for those without a return.");
  m.def(
      "lidar_points",
      [](const StampedFrame& frame, Held<LidarScan> scan) {
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::lidar_points(fields, header, *scan); });
      },
      py::arg("header"), py::arg("scan"),
      "Return a sensor_msgs/PointCloud with intensities; rays without a return end at the maximum range.");
  m.def(
      "nearest_range", [](const Held<LidarScan>& scan) { return make::nearest_range(*scan); }, py::arg("scan"),
      "Return the nearest range, m; infinite without a return.");
  m.def(
      "range",
      [](const StampedFrame& frame, int radiation, double field_of_view, double min_range, double max_range,
         double range) {
        const make::RangeReading reading{static_cast<std::uint8_t>(radiation), field_of_view, min_range, max_range,
                                         range};
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::range(fields, header, reading); });
      },
      py::arg("header"), py::arg("radiation"), py::arg("field_of_view"), py::arg("min_range"), py::arg("max_range"),
      py::arg("range"), "Return a sensor_msgs/Range; radians and metres.");
}

void bind_images(py::module_& m) {
  m.def(
      "color_image",
      [](const StampedFrame& frame, Held<CameraImage> image) {
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::color_image(fields, header, *image); });
      },
      py::arg("header"), py::arg("image"), "Return a sensor_msgs/Image, rgb8.");
  m.def(
      "depth_image",
      [](const StampedFrame& frame, Held<CameraImage> image, const std::optional<std::pair<double, double>>& limits) {
        std::optional<make::DepthLimits> depths;
        if (limits) depths = make::DepthLimits{limits->first, limits->second};
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::depth_image(fields, header, *image, depths);
        });
      },
      py::arg("header"), py::arg("image"), py::arg("limits") = py::none(),
      "Return a sensor_msgs/Image of depths in metres, 32FC1; those not between the limits are NaN.");
  m.def(
      "camera_cloud",
      [](const StampedFrame& frame, Held<CameraImage> image, std::pair<double, double> limits, bool optical) {
        const make::DepthLimits depths{limits.first, limits.second};
        const CloudAxes axes = optical ? CloudAxes::kOptical : CloudAxes::kSensor;
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::camera_cloud(fields, header, *image, depths, axes);
        });
      },
      py::arg("header"), py::arg("image"), py::arg("limits"), py::arg("optical"),
      "Return a sensor_msgs/PointCloud2 with colours, in the sensor's axes, or with z forward and x to the right. "
      "Points whose depth is not between the limits, m, are NaN.");
  m.def(
      "camera_info",
      [](const StampedFrame& frame, int width, int height, double focal_length, double x, double y, double baseline,
         const NumberList<5>& distortion) {
        const make::Pinhole camera{width, height, focal_length, x, y, baseline, distortion};
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::camera_info(fields, header, camera); });
      },
      py::arg("header"), py::arg("width"), py::arg("height"), py::arg("focal_length"), py::arg("x"), py::arg("y"),
      py::arg("baseline"), py::arg("distortion"),
      "Return a sensor_msgs/CameraInfo of a pinhole camera; pixels and metres.");
  m.def(
      "compressed_image",
      [](const StampedFrame& frame, std::string format, const py::array_t<std::uint8_t, py::array::c_style>& data) {
        const std::string_view bytes(reinterpret_cast<const char*>(data.data()), static_cast<std::size_t>(data.size()));
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::compressed_image(fields, header, format, bytes);
        });
      },
      py::arg("header"), py::arg("format"), py::arg("data").noconvert(), py::keep_alive<0, 3>(),
      "Return a sensor_msgs/CompressedImage.");
}

/// `variances`: of orientation and angular velocity.
std::unique_ptr<FieldReader> imu_message(const StampedFrame& frame, const ImuReading& reading,
                                         const NumberList<3>& variances,
                                         const NumberList<3>& linear_acceleration_variances) {
  const make::ImuVariances all{variances, variances, linear_acceleration_variances};
  return message(frame.header(),
                 [=](Fields& fields, const Header& header) { make::imu(fields, header, reading, all); });
}

void bind_vectors(py::module_& m) {
  m.def(
      "imu",
      [](const StampedFrame& frame, const Held<ImuReading>& reading, const NumberList<3>& variances,
         const NumberList<3>& linear_acceleration_variances, const NumberList<4>& turn,
         const std::optional<NumberList<6>>& noise) {
        ImuReading changed = *reading;
        if (turn != kNoTurn) changed.orientation = rotation_of(turn) * changed.orientation;
        if (noise) add(*noise, changed.angular_velocity, changed.linear_acceleration);
        return imu_message(frame, changed, variances, linear_acceleration_variances);
      },
      py::arg("header"), py::arg("reading"), py::arg("variances") = kExact,
      py::arg("linear_acceleration_variances") = kExact, py::arg("turn") = kNoTurn, py::arg("noise") = py::none(),
      "Return a sensor_msgs/Imu. `variances` are those of orientation and angular velocity, `turn` is a rotation after "
      "that of the reading, and `noise` is added to angular velocity and linear acceleration.");
  m.def(
      "imu_of_values",
      [](const StampedFrame& frame, const NumberList<4>& q, const NumberList<3>& angular_velocity,
         const NumberList<3>& linear_acceleration, const NumberList<3>& variances,
         const NumberList<3>& linear_acceleration_variances) {
        const ImuReading reading{rotation_of(q), vector_of(angular_velocity), vector_of(linear_acceleration)};
        return imu_message(frame, reading, variances, linear_acceleration_variances);
      },
      py::arg("header"), py::arg("orientation"), py::arg("angular_velocity"), py::arg("linear_acceleration"),
      py::arg("variances"), py::arg("linear_acceleration_variances"),
      "Return a sensor_msgs/Imu; `variances` are those of orientation and angular velocity.");
  m.def(
      "nav_sat_fix",
      [](const StampedFrame& frame, double latitude, double longitude, double altitude, int status, int service,
         const std::optional<NumberList<3>>& variances) {
        constexpr std::uint8_t kDiagonalKnown = 2;
        const NavSatReading reading{latitude, longitude, altitude, Vector3::Zero()};
        make::FixQuality quality;
        quality.status = static_cast<std::int8_t>(status);
        quality.service = static_cast<std::uint16_t>(service);
        quality.variances = variances.value_or(NumberList<3>{});
        quality.variances_kind = variances ? kDiagonalKnown : 0;
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::nav_sat_fix(fields, header, reading, quality);
        });
      },
      py::arg("header"), py::arg("latitude"), py::arg("longitude"), py::arg("altitude"), py::arg("status") = 0,
      py::arg("service") = 1, py::arg("variances") = py::none(),
      "Return a sensor_msgs/NavSatFix: degrees, m; `variances` of the position, m^2, None if unknown.");
  m.def(
      "magnetic_field",
      [](const StampedFrame& frame, const NumberList<3>& field) {
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::magnetic_field(fields, header, vector_of(field));
        });
      },
      py::arg("header"), py::arg("field"), "Return a sensor_msgs/MagneticField, T.");
  m.def(
      "fluid_pressure",
      [](const StampedFrame& frame, double pressure, double variance) {
        return message(frame.header(), [=](Fields& fields, const Header& header) {
          make::fluid_pressure(fields, header, pressure, variance);
        });
      },
      py::arg("header"), py::arg("pressure"), py::arg("variance") = 0.0,
      "Return a sensor_msgs/FluidPressure, Pa and Pa^2.");
  m.def(
      "point",
      [](const StampedFrame& frame, const NumberList<3>& point) {
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::point(fields, header, vector_of(point)); });
      },
      py::arg("header"), py::arg("point"), "Return a geometry_msgs/PointStamped.");
  m.def(
      "vector",
      [](const StampedFrame& frame, const NumberList<3>& vector) {
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::vector(fields, header, vector_of(vector)); });
      },
      py::arg("header"), py::arg("vector"), "Return a geometry_msgs/Vector3Stamped.");
  m.def(
      "wrench",
      [](const StampedFrame& frame, const Held<ForceTorqueReading>& held, const std::optional<NumberList<6>>& noise) {
        ForceTorqueReading reading = *held;
        if (noise) add(*noise, reading.force, reading.torque);
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::wrench(fields, header, reading); });
      },
      py::arg("header"), py::arg("reading"), py::arg("noise") = py::none(),
      "Return a geometry_msgs/WrenchStamped; `noise` is added to force and torque.");
}

void bind_motions(py::module_& m) {
  m.def(
      "odometry",
      [](const StampedFrame& frame, std::string child_frame, const NumberList<7>& pose, const NumberList<3>& linear,
         const NumberList<3>& angular, const NumberList<6>& pose_variances, const NumberList<6>& velocity_variances) {
        const make::OdometryReading reading{std::move(child_frame),
                                            to_pose(pose),
                                            {vector_of(linear), vector_of(angular)},
                                            pose_variances,
                                            velocity_variances};
        return message(frame.header(),
                       [=](Fields& fields, const Header& header) { make::odometry(fields, header, reading); });
      },
      py::arg("header"), py::arg("child_frame"), py::arg("pose"), py::arg("linear"), py::arg("angular"),
      py::arg("pose_variances"), py::arg("velocity_variances"),
      "Return a nav_msgs/Odometry; variances are those of x, y, z and of the rotations about them.");
  Guarded(m).def(
      "joint_state",
      [](const World& world, const StampedFrame& frame, const std::vector<ObjectId>& joints) {
        make::JointReadings readings = make::read_joints(world, joints);
        return message(frame.header(), [readings = std::move(readings)](Fields& fields, const Header& header) {
          make::joint_state(fields, header, readings);
        });
      },
      py::arg("world"), py::arg("header"), py::arg("joints"),
      "Return a sensor_msgs/JointState of the joints' first axes; the effort is that of the motor, the mean over the "
      "step.");
  py::class_<make::TransformReading>(m, "Transform", "A pose of a frame in the frame of a header.")
      .def(py::init([](const StampedFrame& frame, std::string child_frame, const NumberList<7>& pose) {
             return make::TransformReading{frame.header(), std::move(child_frame), to_pose(pose)};
           }),
           py::arg("header"), py::arg("child_frame"), py::arg("pose"));
  m.def(
      "transforms",
      [](std::vector<make::TransformReading> transforms) {
        return message(Header(), [transforms = std::move(transforms)](Fields& fields, const Header&) {
          make::transforms(fields, transforms);
        });
      },
      py::arg("transforms"), "Return a tf2_msgs/TFMessage.");
}

}  // namespace

void bind_reading_messages(py::module_& core) {
  py::module_ m = core.def_submodule(
      "reading_messages", "Standard messages made of readings. Bridge.publish() and messages.encode() take them.");
  py::class_<FieldReader>(m, "ReadingMessage", "The fields of a message; it holds what it was made of.");
  py::class_<Clock, std::shared_ptr<Clock>>(m, "Clock", "The time of messages.")
      .def(py::init())
      .def(
          "set",
          [](Clock& clock, std::uint32_t sec, std::uint32_t nanosec) {
            clock.now = {sec, nanosec};
          },
          py::arg("sec"), py::arg("nanosec"));
  py::class_<StampedFrame>(
      m, "Header", "A std_msgs/Header with the present time of a clock. Its sequence number is that of the connection.")
      .def(py::init([](std::shared_ptr<Clock> clock, std::string frame) {
             return StampedFrame{std::move(clock), std::move(frame)};
           }),
           py::arg("clock").none(false), py::arg("frame"));
  bind_scans(m);
  bind_images(m);
  bind_vectors(m);
  bind_motions(m);
  Guarded(m).def(
      "contacts_state",
      [](const World& world, const StampedFrame& frame, ObjectId link, const Held<ContactReading>& reading,
         ObjectId reference) {
        auto touches = make::read_touches(world, link, *reading, reference);
        return message(frame.header(), [touches = std::move(touches)](Fields& fields, const Header& header) {
          make::contacts_state(fields, header, touches);
        });
      },
      py::arg("world"), py::arg("header"), py::arg("link"), py::arg("reading"), py::arg("reference") = kNoObject,
      "Return a gazebo_msgs/ContactsState of a link, in the frame of another object or of the world.");
}

}  // namespace bubblesim::bindings
