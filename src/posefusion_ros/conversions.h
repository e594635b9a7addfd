#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <string>

#include "posefusion/common/lie.h"
#include "posefusion/common/stamp.h"
#include "posefusion/image/camera_model.h"
#include "posefusion/surfel/surfel_cloud.h"

namespace posefusion {

/// The border between messages and the core. Everything here is pure and thread-safe; what cannot
/// be used is refused with std::invalid_argument naming the topic.

StampNs ToStampNs(const ros::Time& time);
ros::Time ToRosTime(StampNs stamp_ns);

/// Pinhole camera with the plumb_bob distortion of the message, or, for images that the driver has
/// rectified already, the camera of the projection matrix without distortion.
/// @throws for a camera without intrinsics and for other distortion models.
CameraModel ToCameraModel(const sensor_msgs::CameraInfo& info, bool images_are_rectified,
                          const std::string& topic);

/// CV_8UC3 R G B. rgb8 shares the pixels of the message, which lives as long as the image does;
/// bgr8, rgba8, bgra8 and mono8 are converted. @throws for other encodings and torn images.
cv::Mat ToRgb(const sensor_msgs::ImageConstPtr& image, const std::string& topic);

/// CV_32FC1 metres, 0 = none, from 32FC1 metres or 16UC1 millimetres (REP-118).
/// @throws for other encodings and torn images.
cv::Mat ToDepthM(const sensor_msgs::ImageConstPtr& image, const std::string& topic);

/// rgb8 image of R G B pixels.
sensor_msgs::ImagePtr ToRgb8Message(const cv::Mat& rgb, const std_msgs::Header& header);

/// 32FC1 image in metres, NaN = none.
sensor_msgs::ImagePtr ToDepthMessage(const cv::Mat& depth_m, const std_msgs::Header& header);

/// The same with the people of the mask (CV_8UC1, not 0 = person) set to none.
sensor_msgs::ImagePtr ToStaticDepthMessage(const cv::Mat& depth_m, const cv::Mat& mask,
                                           const std_msgs::Header& header);

/// mono8 image of a person mask (CV_8UC1, 255 = person).
sensor_msgs::ImagePtr ToMaskMessage(const cv::Mat& mask, const std_msgs::Header& header);

/// A person mask without anybody for a colour image; 0 x 0 when the image is torn.
sensor_msgs::ImagePtr EmptyMaskMessage(const sensor_msgs::Image& rgb);

/// CV_8UC1 person mask that shares the pixels of the message. @throws for other encodings than
/// mono8 and torn images.
cv::Mat ToMask(const sensor_msgs::ImageConstPtr& mask, const std::string& topic);

/// Camera with its distortion; R is the identity and P the same camera without distortion.
sensor_msgs::CameraInfo ToCameraInfo(const CameraModel& camera, const std_msgs::Header& header);

geometry_msgs::Pose ToPoseMessage(const Eigen::Isometry3d& T);

geometry_msgs::TransformStamped ToTransformMessage(const Eigen::Isometry3d& T_parent_child,
                                                   const std::string& parent,
                                                   const std_msgs::Header& child);

/// Pose with the covariance in REP-103 order: x y z and rotation about x y z, row-major.
geometry_msgs::PoseWithCovariance ToPoseWithCovariance(const Eigen::Isometry3d& T,
                                                       const Matrix6d& covariance);

/// Fields x y z rgb normal_x normal_y normal_z radius confidence, all float32.
sensor_msgs::PointCloud2Ptr ToPointCloud2(const SurfelCloud& cloud, const std_msgs::Header& header);

}  // namespace posefusion
