// SPDX-License-Identifier: BSD-3-Clause
// The node pointcloud_to_laserscan: converts PointCloud2 on cloud_in to LaserScan on scan while it has subscribers.
#include <tf2_ros/transform_listener.h>

#include <memory>

#include "cloud_to_scan.hpp"
#include "lazy_scans.hpp"
#include "parameters.hpp"
#include "placed_messages.hpp"
#include "run_node.hpp"
#include "transforms.hpp"

namespace {

using bubblesim::parameter;
using Cloud = sensor_msgs::PointCloud2;

const ros::Duration kMemory(60.0);  // of transforms: clouds arrive late on a busy machine

bubblesim::HeightBand read_heights(const ros::NodeHandle& own) {
  bubblesim::HeightBand heights;
  heights.min = parameter(own, "min_height", heights.min);
  heights.max = parameter(own, "max_height", heights.max);
  if (!(heights.max > heights.min)) throw std::invalid_argument("max_height must be above min_height");
  return heights;
}

bubblesim::ScanShape read_shape(const ros::NodeHandle& own) {
  bubblesim::ScanShape shape;
  shape.angle_min = parameter(own, "angle_min", shape.angle_min);
  shape.angle_max = parameter(own, "angle_max", shape.angle_max);
  shape.angle_increment = parameter(own, "angle_increment", shape.angle_increment);
  shape.scan_time = parameter(own, "scan_time", shape.scan_time);
  shape.range_min = parameter(own, "range_min", shape.range_min);
  shape.range_max = parameter(own, "range_max", shape.range_max);
  shape.use_inf = parameter(own, "use_inf", shape.use_inf);
  shape.inf_epsilon = parameter(own, "inf_epsilon", shape.inf_epsilon);
  check(shape);
  return shape;
}

class PointCloudToLaserScan {
 public:
  PointCloudToLaserScan()
      : target_frame_(parameter(own_, "target_frame", std::string())),
        queue_size_(parameter(own_, "queue_size", 10)),
        heights_(read_heights(own_)),
        shape_(read_shape(own_)) {
    const double tolerance = parameter(own_, "transform_tolerance", 0.01);
    if (!(tolerance >= 0.0)) throw std::invalid_argument("transform_tolerance must not be negative");
    if (queue_size_ < 1) throw std::invalid_argument("queue_size must be at least 1");
    if (target_frame_.empty()) {
      clouds_.registerCallback(&PointCloudToLaserScan::convert, this);
    } else {
      transforms_ = std::make_unique<tf2_ros::Buffer>(kMemory);
      listener_ = std::make_unique<tf2_ros::TransformListener>(*transforms_);
      placed_ = std::make_unique<bubblesim::PlacedMessages<Cloud>>(
          clouds_, *transforms_, target_frame_, queue_size_, node_,
          [this](const Cloud::ConstPtr& cloud) { convert(cloud); }, [](const auto&, auto) {}, ros::Duration(tolerance));
    }
    scans_ = std::make_unique<bubblesim::LazyScans>(
        node_, queue_size_, [this] { clouds_.subscribe(node_, "cloud_in", queue_size_); },
        [this] { clouds_.unsubscribe(); });
  }

 private:
  void convert(const Cloud::ConstPtr& cloud) {
    try {
      tf2::Transform to_scan = tf2::Transform::getIdentity();
      if (transforms_) {
        const auto found = transforms_->lookupTransform(target_frame_, cloud->header.frame_id, cloud->header.stamp);
        to_scan = bubblesim::to_tf2(found.transform);
      }
      sensor_msgs::LaserScan scan = bubblesim::cloud_to_scan(*cloud, to_scan, heights_, shape_);
      scan.header = cloud->header;
      if (transforms_) scan.header.frame_id = target_frame_;
      scans_->publish(scan);
    } catch (const tf2::TransformException& error) {
      ROS_WARN_THROTTLE(5.0, "dropped a cloud: %s", error.what());
    } catch (const std::invalid_argument& error) {
      ROS_ERROR_THROTTLE(5.0, "dropped a cloud: %s", error.what());
    }
  }

  ros::NodeHandle node_;
  ros::NodeHandle own_{"~"};
  std::string target_frame_;  // if empty, the cloud's frame
  int queue_size_;
  bubblesim::HeightBand heights_;
  bubblesim::ScanShape shape_;
  std::unique_ptr<tf2_ros::Buffer> transforms_;  // null without a target frame
  std::unique_ptr<tf2_ros::TransformListener> listener_;
  message_filters::Subscriber<Cloud> clouds_;
  std::unique_ptr<bubblesim::PlacedMessages<Cloud>> placed_;
  std::unique_ptr<bubblesim::LazyScans> scans_;
};

}  // namespace

int main(int argc, char** argv) {
  return bubblesim::run_node<PointCloudToLaserScan>(argc, argv, "pointcloud_to_laserscan");
}
