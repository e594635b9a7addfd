#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace posefusion {

/// Joints of the head that move; the chest is held still.
struct NeckAngles {
  double yaw_rad = 0;    ///< NECK_Y, left is positive
  double pitch_rad = 0;  ///< NECK_P, down is positive
};

/// A link of the chain from the root to the camera.
struct LinkPose {
  std::string parent;
  std::string name;
  Eigen::Isometry3d T_parent_link;
  bool moves = false;  ///< depends on the neck's angles
};

/// Names of joints in joint_states.txt and on /joint_states, in the order of JointAngles.
std::vector<std::string> JointNames();
std::vector<double> JointAngles(const NeckAngles& neck);

constexpr const char* kRootLink = "BODY";
constexpr const char* kCameraLink = "camera_rgb_optical_frame";

/// Height of BODY above the soles of a robot that stands, metres.
constexpr double kBodyHeightM = 0.79;

/// BODY -> CHEST_P_LINK -> CHEST_Y_LINK -> NECK_Y_LINK -> NECK_P_LINK -> camera_link ->
/// camera_rgb_optical_frame. Link names and order of joints are HRP-4's; lengths are chosen so that
/// the camera of a standing robot is 1.5 m above the floor.
std::vector<LinkPose> HeadChain(const NeckAngles& neck);

/// Product of the chain.
Eigen::Isometry3d T_body_camera(const NeckAngles& neck);

}  // namespace posefusion
