#include "posefusion/simulation/robot_model.h"

namespace posefusion {
namespace {

Eigen::Isometry3d Offset(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// REP-103: from a link (x forward, y left, z up) to an optical frame.
Eigen::Matrix3d LinkToOptical() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R;
}

}  // namespace

std::vector<std::string> JointNames() { return {"CHEST_P", "CHEST_Y", "NECK_Y", "NECK_P"}; }

std::vector<double> JointAngles(const NeckAngles& neck) {
  return {0, 0, neck.yaw_rad, neck.pitch_rad};
}

std::vector<LinkPose> HeadChain(const NeckAngles& neck) {
  Eigen::Isometry3d T_chest_neck = Offset(0.01, 0, 0.36);
  T_chest_neck.rotate(Eigen::AngleAxisd(neck.yaw_rad, Eigen::Vector3d::UnitZ()));
  Eigen::Isometry3d T_neck_head = Offset(0, 0, 0.04);
  T_neck_head.rotate(Eigen::AngleAxisd(neck.pitch_rad, Eigen::Vector3d::UnitY()));
  Eigen::Isometry3d T_link_optical = Offset(0, 0.02, 0);
  T_link_optical.linear() = LinkToOptical();
  return {{kRootLink, "CHEST_P_LINK", Offset(0, 0, 0.18)},
          {"CHEST_P_LINK", "CHEST_Y_LINK", Offset(0, 0, 0.01)},
          {"CHEST_Y_LINK", "NECK_Y_LINK", T_chest_neck, true},
          {"NECK_Y_LINK", "NECK_P_LINK", T_neck_head, true},
          {"NECK_P_LINK", "camera_link", Offset(0.09, 0, 0.12)},
          {"camera_link", kCameraLink, T_link_optical}};
}

Eigen::Isometry3d T_body_camera(const NeckAngles& neck) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (const LinkPose& link : HeadChain(neck)) T = T * link.T_parent_link;
  return T;
}

}  // namespace posefusion
