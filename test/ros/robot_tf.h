#pragma once

#include <string>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/robot_model.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/tf_tree.h"

namespace posefusion {

constexpr double kSmallStepS = 0.01;  ///< tf of robots comes at 100 Hz

inline geometry_msgs::TransformStamped MakeTransform(const std::string& parent,
                                                     const std::string& child, StampNs stamp_ns,
                                                     const Eigen::Isometry3d& T_parent_child) {
  std_msgs::Header header;
  header.stamp = ToRosTime(stamp_ns);
  header.frame_id = child;
  return ToTransformMessage(T_parent_child, parent, header);
}

/// A robot that walks on a circle and turns its neck quickly.
inline Eigen::Isometry3d WalkingBody(double time_s) {
  Eigen::Isometry3d T_odom_body(Eigen::Translation3d(std::cos(0.3 * time_s), std::sin(0.3 * time_s),
                                                     0.79 + 0.01 * std::sin(6 * time_s)));
  T_odom_body.rotate(Eigen::AngleAxisd(0.3 * time_s, Eigen::Vector3d::UnitZ()));
  return T_odom_body;
}
inline NeckAngles TurningNeck(double time_s) {
  return {0.6 * std::sin(2 * time_s), 0.2 + 0.2 * std::sin(3 * time_s)};
}
inline Eigen::Isometry3d OdomToCameraTruth(double time_s) {
  return WalkingBody(time_s) * T_body_camera(TurningNeck(time_s));
}

/// What the robot tells at that time: odom -> BODY -> ... -> camera_rgb_optical_frame.
inline std::vector<geometry_msgs::TransformStamped> RobotTransforms(
    double time_s, const std::string& odom = "odom") {
  const StampNs stamp_ns = StampFromSeconds(time_s);
  std::vector<geometry_msgs::TransformStamped> transforms = {
      MakeTransform(odom, kRootLink, stamp_ns, WalkingBody(time_s))};
  for (const LinkPose& link : HeadChain(TurningNeck(time_s))) {
    transforms.push_back(MakeTransform(link.parent, link.name, stamp_ns, link.T_parent_link));
  }
  return transforms;
}

inline void AddRobot(TfTree& tree, double from_s, double to_s) {
  for (double time_s = from_s; time_s <= to_s + 1e-9; time_s += kSmallStepS) {
    for (const auto& transform : RobotTransforms(time_s)) tree.Add(transform, "/robot", false);
  }
}

}  // namespace posefusion
