#include "posefusion_ros/people_drawing.h"

#include <array>
#include <opencv2/core.hpp>

#include "posefusion/segmentation/mask_overlay.h"
#include "posefusion/skeleton/joints.h"

namespace posefusion {
namespace {

using visualization_msgs::Marker;

constexpr double kBoneWidthM = 0.02;
constexpr double kJointSizeM = 0.05;
constexpr double kLifetimeS = 1;  // keypoints may stop coming
const cv::Scalar kMaskColor(255, 60, 60);

constexpr std::array<std::array<float, 3>, 5> kPersonColors = {
    {{1, 0.8F, 0.2F}, {0.3F, 0.9F, 1}, {0.5F, 1, 0.4F}, {1, 0.5F, 0.9F}, {1, 0.55F, 0.35F}}};

Marker MakeMarker(const std_msgs::Header& header, const char* name, std::size_t person, int type,
                  double size_m) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.id = static_cast<int>(person);
  marker.type = type;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = size_m;
  const auto& color = kPersonColors[person % kPersonColors.size()];
  marker.color.r = color[0];
  marker.color.g = color[1];
  marker.color.b = color[2];
  marker.color.a = 1;
  marker.lifetime = ros::Duration(kLifetimeS);
  marker.frame_locked = 1;  // drawn where the camera's frame is now
  return marker;
}

geometry_msgs::Point ToPoint(const Eigen::Vector3f& p_camera) {
  geometry_msgs::Point point;
  point.x = p_camera.x();
  point.y = p_camera.y();
  point.z = p_camera.z();
  return point;
}

/// Points of the lifted joints by joint; null for the others.
std::array<const Seed*, kNumCocoJoints> JointsOf(const PersonSeeds& person) {
  std::array<const Seed*, kNumCocoJoints> joints{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (person.found[i]) joints[i] = &person.seeds[next++];
  }
  return joints;
}

}  // namespace

cv::Mat DrawMask(const cv::Mat& rgb, const cv::Mat& mask) {
  cv::Mat drawn = rgb.clone();
  TintMask(rgb, mask, kMaskColor, drawn);
  return drawn;
}

visualization_msgs::MarkerArray ToSkeletonMarkers(const std::vector<PersonSeeds>& people,
                                                  const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(MakeMarker(header, "", 0, Marker::SPHERE_LIST, kJointSizeM));
  array.markers.back().action = Marker::DELETEALL;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const auto joints = JointsOf(people[i]);
    Marker bones = MakeMarker(header, "bones", i, Marker::LINE_LIST, kBoneWidthM);
    Marker points = MakeMarker(header, "joints", i, Marker::SPHERE_LIST, kJointSizeM);
    for (const Bone& bone : kBones) {
      if (joints[bone.from] == nullptr || joints[bone.to] == nullptr) continue;
      bones.points.push_back(ToPoint(joints[bone.from]->p_camera));
      bones.points.push_back(ToPoint(joints[bone.to]->p_camera));
    }
    for (const Seed* joint : joints) {
      if (joint != nullptr) points.points.push_back(ToPoint(joint->p_camera));
    }
    if (!bones.points.empty()) array.markers.push_back(bones);
    if (!points.points.empty()) array.markers.push_back(points);
  }
  return array;
}

}  // namespace posefusion
