// SPDX-License-Identifier: BSD-3-Clause
// The node depthimage_to_laserscan: converts depth images to LaserScan on scan while it has subscribers.
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>

#include "depth_to_scan.hpp"
#include "lazy_scans.hpp"
#include "parameters.hpp"
#include "run_node.hpp"

namespace {

using bubblesim::parameter;

constexpr int kQueue = 10;

bubblesim::DepthBand read_band(const ros::NodeHandle& own) {
  bubblesim::DepthBand band;
  band.scan_height = parameter(own, "scan_height", band.scan_height);
  band.scan_time = parameter(own, "scan_time", band.scan_time);
  band.range_min = parameter(own, "range_min", band.range_min);
  band.range_max = parameter(own, "range_max", band.range_max);
  check(band);
  return band;
}

class DepthImageToLaserScan {
 public:
  DepthImageToLaserScan()
      : frame_(parameter(own_, "output_frame_id", std::string("camera_depth_frame"))), band_(read_band(own_)) {
    pairs_.registerCallback(&DepthImageToLaserScan::convert, this);
  }

 private:
  void listen() {
    images_.subscribe(node_, "image", kQueue);
    cameras_.subscribe(node_, "camera_info", kQueue);
  }

  void stop_listening() {
    images_.unsubscribe();
    cameras_.unsubscribe();
  }

  void convert(const sensor_msgs::Image::ConstPtr& image, const sensor_msgs::CameraInfo::ConstPtr& camera) {
    try {
      sensor_msgs::LaserScan scan = bubblesim::depth_to_scan(*image, *camera, band_);
      scan.header = image->header;
      if (!frame_.empty()) scan.header.frame_id = frame_;
      scans_.publish(scan);
    } catch (const std::invalid_argument& error) {
      ROS_ERROR_THROTTLE(5.0, "dropped a depth image: %s", error.what());
    }
  }

  ros::NodeHandle node_;
  ros::NodeHandle own_{"~"};
  std::string frame_;
  bubblesim::DepthBand band_;
  message_filters::Subscriber<sensor_msgs::Image> images_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> cameras_;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo> pairs_{images_, cameras_, kQueue};
  bubblesim::LazyScans scans_{node_, kQueue, [this] { listen(); }, [this] { stop_listening(); }};
};

}  // namespace

int main(int argc, char** argv) {
  return bubblesim::run_node<DepthImageToLaserScan>(argc, argv, "depthimage_to_laserscan");
}
