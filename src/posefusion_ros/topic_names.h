#pragma once

namespace posefusion {

/// Every topic of the system in one place. All names are relative, so launch files can put the
/// nodelets into namespaces and remap.

// From the camera driver or a bag.
constexpr const char* kCameraRgbTopic = "camera/rgb/image_rect_color";
constexpr const char* kCameraDepthTopic = "camera/depth_registered/image_rect";
constexpr const char* kCameraInfoTopic = "camera/rgb/camera_info";

// From the robot.
constexpr const char* kImuTopic = "imu";
constexpr const char* kTfTopic = "/tf";  // absolute, as everywhere in ROS
constexpr const char* kTfStaticTopic = "/tf_static";

// From BlurFilter: the same messages, without the blurred ones.
constexpr const char* kSharpRgbTopic = "sharp/rgb/image_rect_color";
constexpr const char* kSharpDepthTopic = "sharp/depth_registered/image_rect";
constexpr const char* kSharpInfoTopic = "sharp/rgb/camera_info";
// And the blurred ones.
constexpr const char* kBlurredRgbTopic = "blurred/rgb/image_rect_color";
constexpr const char* kBlurredDepthTopic = "blurred/depth_registered/image_rect";
constexpr const char* kBlurredInfoTopic = "blurred/rgb/camera_info";
constexpr const char* kBlurScoreTopic = "blur_score";

// Keypoints of people: from elsewhere or a bag, and checked from SkeletonIngest.
constexpr const char* kSkeletonsInTopic = "skeletons_in";
constexpr const char* kSkeletonsTopic = "skeletons";

// From HumanRemoval: frames without people. The info of a frame comes last.
constexpr const char* kStaticDepthTopic = "static/depth";
constexpr const char* kStaticMaskTopic = "static/mask";
constexpr const char* kStaticInfoTopic = "static/info";
constexpr const char* kOverlayTopic = "static/overlay";
constexpr const char* kSkeletonMarkersTopic = "skeleton_markers";

// From Mapping.
constexpr const char* kHeadPoseTopic = "head_pose";
constexpr const char* kOdometryTopic = "odometry";
constexpr const char* kPathTopic = "path";
constexpr const char* kStatusTopic = "status";
constexpr const char* kSurfelCloudTopic = "surfel_cloud";
constexpr const char* kModelImageTopic = "model/image";

}  // namespace posefusion
