// SPDX-License-Identifier: BSD-3-Clause
// The node mapper: builds a map from LaserScan on scan and odometry from tf, and localizes the base in it.
#include <nav_msgs/GetMap.h>
#include <nav_msgs/MapMetaData.h>
#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>
#include <tf2/utils.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "map_files.hpp"
#include "parameters.hpp"
#include "placed_messages.hpp"
#include "run_node.hpp"
#include "scan_mapper.hpp"
#include "transforms.hpp"

namespace {

using bubblesim::parameter;
using bubblesim::PlanarPose;
using Scan = sensor_msgs::LaserScan;

const ros::Duration kMemory(60.0);  // of transforms: scans arrive late on a busy machine
constexpr int kQueue = 100;         // scans that wait for tf or for the mapper

PlanarPose planar(const tf2::Transform& transform) {
  return {transform.getOrigin().x(), transform.getOrigin().y(), tf2::getYaw(transform.getRotation())};
}

tf2::Transform spatial(const PlanarPose& pose) {
  return tf2::Transform(tf2::Quaternion(tf2::Vector3(0, 0, 1), pose.heading), tf2::Vector3(pose.x, pose.y, 0.0));
}

class Mapper {
 public:
  Mapper()
      : base_frame_(parameter(own_, "base_frame", std::string("base_link"))),
        odom_frame_(parameter(own_, "odom_frame", std::string("odom"))),
        map_frame_(parameter(own_, "map_frame", std::string("map"))),
        map_update_interval_(parameter(own_, "map_update_interval", 5.0)),
        transform_delay_(parameter(own_, "tf_delay", 0.1)),
        options_(read_options(own_)),
        mapper_(options_) {
    if (!(map_update_interval_ >= 0.0)) throw std::invalid_argument("map_update_interval must not be negative");
    if (!(transform_delay_ >= 0.0)) throw std::invalid_argument("tf_delay must not be negative");
  }

 private:
  static bubblesim::ScanMapperOptions read_options(const ros::NodeHandle& own) {
    bubblesim::ScanMapperOptions options;
    options.cell_size = parameter(own, "delta", options.cell_size);
    options.max_usable_range = parameter(own, "maxUrange", options.max_usable_range);
    options.linear_update = parameter(own, "linearUpdate", options.linear_update);
    options.angular_update = parameter(own, "angularUpdate", options.angular_update);
    check(options);
    return options;
  }

  void take(const Scan::ConstPtr& scan) {
    const ros::Time stamp = scan->header.stamp;
    if (stamp < mapped_at_) {
      ROS_WARN("time jumped back from %.3f to %.3f s: restarting the map", mapped_at_.toSec(), stamp.toSec());
      start_anew();
    } else if (stamp == mapped_at_) {
      return;  // the same scan again
    }
    try {
      const auto odometry = bubblesim::to_tf2(transforms_.lookupTransform(odom_frame_, base_frame_, stamp).transform);
      const auto mount =
          bubblesim::to_tf2(transforms_.lookupTransform(base_frame_, scan->header.frame_id, stamp).transform);
      const bool upside_down = mount.getBasis()[2].z() < 0.0;
      const PlanarPose pose = mapper_.add(*scan, {planar(mount), upside_down}, planar(odometry));
      mapped_at_ = stamp;
      if (began_at_.isZero()) began_at_ = stamp;
      send_place(spatial(pose) * spatial(planar(odometry)).inverse(), stamp);
    } catch (const tf2::TransformException& error) {
      ROS_WARN_THROTTLE(5.0, "dropped a scan: %s", error.what());
    } catch (const std::invalid_argument& error) {
      ROS_ERROR_THROTTLE(5.0, "dropped a scan: %s", error.what());
    }
    if (published_at_.isZero() || stamp - published_at_ >= ros::Duration(map_update_interval_)) publish(stamp);
  }

  void lose(const Scan& scan, tf2_ros::FilterFailureReason reason) {
    // Scans from before the first scan in the map are older than the tf buffer.
    if (!began_at_.isZero() && scan.header.stamp > began_at_)
      ROS_WARN_THROTTLE(5.0, "dropped a scan of frame %s at %.3f s: no transform to %s (reason %d)",
                        scan.header.frame_id.c_str(), scan.header.stamp.toSec(), odom_frame_.c_str(),
                        static_cast<int>(reason));
  }

  void send_place(const tf2::Transform& odom_in_map, const ros::Time& stamp) {
    geometry_msgs::TransformStamped place;
    place.header.frame_id = map_frame_;
    place.header.stamp = stamp + ros::Duration(transform_delay_);  // valid until the next scan
    place.child_frame_id = odom_frame_;
    place.transform = bubblesim::to_message(odom_in_map);
    broadcaster_.sendTransform(place);
  }

  nav_msgs::OccupancyGrid map(const ros::Time& stamp) const {
    nav_msgs::OccupancyGrid map = mapper_.map();
    map.header.frame_id = map_frame_;
    map.header.stamp = stamp;
    map.info.map_load_time = stamp;
    return map;
  }

  void publish(const ros::Time& stamp) {
    published_at_ = stamp;
    const nav_msgs::OccupancyGrid current = map(stamp);
    maps_.publish(current);
    metadata_.publish(current.info);
  }

  void start_anew() {
    mapper_ = bubblesim::ScanMapper(options_);
    mapped_at_ = began_at_ = published_at_ = ros::Time();
    placed_.clear();
  }

  bool save(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& answer) {
    try {
      answer.message = bubblesim::write_map(map(mapped_at_), parameter(own_, "map_file", std::string("map"))).string();
      answer.success = 1;
    } catch (const std::exception& error) {
      answer.message = error.what();
    }
    return true;
  }

  bool reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    start_anew();
    return true;
  }

  bool give(nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response& answer) {
    answer.map = map(mapped_at_);
    return true;
  }

  ros::NodeHandle node_;
  ros::NodeHandle own_{"~"};
  std::string base_frame_;
  std::string odom_frame_;
  std::string map_frame_;
  double map_update_interval_;  // s
  double transform_delay_;      // s
  bubblesim::ScanMapperOptions options_;
  bubblesim::ScanMapper mapper_;
  ros::Time mapped_at_;  // time stamp of the last scan in the map, 0 before the first
  ros::Time began_at_;   // time stamp of the first scan
  ros::Time published_at_;

  tf2_ros::Buffer transforms_{kMemory};
  tf2_ros::TransformListener listener_{transforms_};
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher maps_ = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  ros::Publisher metadata_ = node_.advertise<nav_msgs::MapMetaData>("map_metadata", 1, true);
  ros::ServiceServer saving_ = own_.advertiseService("save_map", &Mapper::save, this);
  ros::ServiceServer resetting_ = own_.advertiseService("reset", &Mapper::reset, this);
  ros::ServiceServer giving_ = node_.advertiseService("dynamic_map", &Mapper::give, this);
  message_filters::Subscriber<Scan> scans_{node_, "scan", kQueue};
  bubblesim::PlacedMessages<Scan> placed_{scans_,
                                          transforms_,
                                          odom_frame_,
                                          kQueue,
                                          node_,
                                          [this](const Scan::ConstPtr& scan) { take(scan); },
                                          [this](const Scan::ConstPtr& scan, auto reason) { lose(*scan, reason); }};
};

}  // namespace

int main(int argc, char** argv) { return bubblesim::run_node<Mapper>(argc, argv, "mapper"); }
