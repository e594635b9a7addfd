#include "posefusion_ros/conversions.h"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "posefusion/image/depth_units.h"
#include "posefusion_ros/shared_image.h"

namespace posefusion {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr StampNs kNanosecondsPerSecond = 1'000'000'000;

[[noreturn]] void Refuse(const std::string& topic, const std::string& why) {
  throw std::invalid_argument(topic + ": " + why);
}

void CheckSameCamera(const CameraModel& camera, const sensor_msgs::CameraInfo& info,
                     const std::string& topic) {
  const bool binned = info.binning_x > 1 || info.binning_y > 1;
  const bool cut_out = info.roi.width != 0 && static_cast<int>(info.roi.width) != camera.width;
  if (binned || cut_out) Refuse(topic, "binning and regions of interest are not supported");
}

std::array<double, 5> PlumbBobDistortion(const sensor_msgs::CameraInfo& info,
                                         const std::string& topic) {
  std::array<double, 5> distortion{};
  const bool none = std::all_of(info.D.begin(), info.D.end(), [](double k) { return k == 0; });
  if (none) return distortion;
  if (info.distortion_model != sensor_msgs::distortion_models::PLUMB_BOB || info.D.size() > 5) {
    Refuse(topic, "distortion model '" + info.distortion_model + "' with " +
                      std::to_string(info.D.size()) + " coefficients is not plumb_bob with 5");
  }
  std::copy(info.D.begin(), info.D.end(), distortion.begin());
  return distortion;
}

/// A message with room for the pixels.
sensor_msgs::ImagePtr MakeImage(const cv::Mat& pixels, const std::string& encoding,
                                const std_msgs::Header& header) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->header = header;
  image->width = static_cast<std::uint32_t>(pixels.cols);
  image->height = static_cast<std::uint32_t>(pixels.rows);
  image->encoding = encoding;
  image->step = image->width * static_cast<std::uint32_t>(pixels.elemSize());
  image->data.resize(static_cast<std::size_t>(image->step) * image->height);
  return image;
}

}  // namespace

StampNs ToStampNs(const ros::Time& time) {
  return static_cast<StampNs>(time.sec) * kNanosecondsPerSecond + time.nsec;
}

ros::Time ToRosTime(StampNs stamp_ns) {
  return ros::Time(static_cast<std::uint32_t>(stamp_ns / kNanosecondsPerSecond),
                   static_cast<std::uint32_t>(stamp_ns % kNanosecondsPerSecond));
}

CameraModel ToCameraModel(const sensor_msgs::CameraInfo& info, bool images_are_rectified,
                          const std::string& topic) {
  CameraModel camera;
  camera.width = static_cast<int>(info.width);
  camera.height = static_cast<int>(info.height);
  const bool calibrated = images_are_rectified ? info.P[0] != 0 : info.K[0] != 0;
  if (!calibrated) Refuse(topic, "the camera is not calibrated (all intrinsics are zero)");
  if (images_are_rectified) {
    camera.fx = info.P[0];
    camera.fy = info.P[5];
    camera.cx = info.P[2];
    camera.cy = info.P[6];
  } else {
    camera.fx = info.K[0];
    camera.fy = info.K[4];
    camera.cx = info.K[2];
    camera.cy = info.K[5];
    camera.distortion = PlumbBobDistortion(info, topic);
  }
  CheckSameCamera(camera, info, topic);
  camera.Check(topic);
  return camera;
}

cv::Mat ToRgb(const sensor_msgs::ImageConstPtr& image, const std::string& topic) {
  const auto convert = [&](int type, int code) {
    cv::Mat rgb;
    cv::cvtColor(ShareImage(image, type, topic), rgb, code);
    return rgb;
  };
  const std::string& encoding = image->encoding;
  if (encoding == encodings::RGB8) return ShareImage(image, CV_8UC3, topic);
  if (encoding == encodings::BGR8) return convert(CV_8UC3, cv::COLOR_BGR2RGB);
  if (encoding == encodings::RGBA8) return convert(CV_8UC4, cv::COLOR_RGBA2RGB);
  if (encoding == encodings::BGRA8) return convert(CV_8UC4, cv::COLOR_BGRA2RGB);
  if (encoding == encodings::MONO8) return convert(CV_8UC1, cv::COLOR_GRAY2RGB);
  Refuse(topic, "colour encoding '" + encoding + "' is none of rgb8 bgr8 rgba8 bgra8 mono8");
}

cv::Mat ToDepthM(const sensor_msgs::ImageConstPtr& image, const std::string& topic) {
  const std::string& encoding = image->encoding;
  if (encoding != encodings::TYPE_32FC1 && encoding != encodings::TYPE_16UC1) {
    Refuse(topic, "depth encoding '" + encoding + "' is neither 32FC1 (metres) nor 16UC1 (mm)");
  }
  if (image->is_bigendian != 0) Refuse(topic, "big-endian depth is not supported");
  if (encoding == encodings::TYPE_32FC1)
    return DepthToMetres(ShareImage(image, CV_32FC1, topic), topic);
  return DepthToMetres(ShareImage(image, CV_16UC1, topic), topic);
}

sensor_msgs::ImagePtr ToRgb8Message(const cv::Mat& rgb, const std_msgs::Header& header) {
  const auto image = MakeImage(rgb, encodings::RGB8, header);
  rgb.copyTo(cv::Mat(rgb.rows, rgb.cols, CV_8UC3, image->data.data()));
  return image;
}

sensor_msgs::ImagePtr ToDepthMessage(const cv::Mat& depth_m, const std_msgs::Header& header) {
  const auto image = MakeImage(depth_m, encodings::TYPE_32FC1, header);
  cv::Mat pixels(depth_m.rows, depth_m.cols, CV_32FC1, image->data.data());
  depth_m.copyTo(pixels);
  pixels.setTo(std::numeric_limits<float>::quiet_NaN(), depth_m == 0);
  return image;
}

sensor_msgs::ImagePtr ToStaticDepthMessage(const cv::Mat& depth_m, const cv::Mat& mask,
                                           const std_msgs::Header& header) {
  const auto image = ToDepthMessage(depth_m, header);
  cv::Mat pixels(depth_m.rows, depth_m.cols, CV_32FC1, image->data.data());
  pixels.setTo(std::numeric_limits<float>::quiet_NaN(), mask);
  return image;
}

sensor_msgs::ImagePtr ToMaskMessage(const cv::Mat& mask, const std_msgs::Header& header) {
  const auto image = MakeImage(mask, encodings::MONO8, header);
  mask.copyTo(cv::Mat(mask.rows, mask.cols, CV_8UC1, image->data.data()));
  return image;
}

sensor_msgs::ImagePtr EmptyMaskMessage(const sensor_msgs::Image& rgb) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header = rgb.header;
  image->encoding = encodings::MONO8;
  const std::size_t num_pixels = static_cast<std::size_t>(rgb.width) * rgb.height;
  if (rgb.data.size() < num_pixels) return image;
  image->width = image->step = rgb.width;
  image->height = rgb.height;
  image->data.resize(num_pixels);
  return image;
}

cv::Mat ToMask(const sensor_msgs::ImageConstPtr& mask, const std::string& topic) {
  if (mask->encoding != encodings::MONO8) {
    Refuse(topic, "mask encoding '" + mask->encoding + "' is not mono8");
  }
  return ShareImage(mask, CV_8UC1, topic);
}

sensor_msgs::CameraInfo ToCameraInfo(const CameraModel& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(camera.distortion.begin(), camera.distortion.end());
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

geometry_msgs::Pose ToPoseMessage(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  geometry_msgs::Pose pose;
  pose.position.x = T.translation().x();
  pose.position.y = T.translation().y();
  pose.position.z = T.translation().z();
  pose.orientation.x = q.x();
  pose.orientation.y = q.y();
  pose.orientation.z = q.z();
  pose.orientation.w = q.w();
  return pose;
}

geometry_msgs::TransformStamped ToTransformMessage(const Eigen::Isometry3d& T_parent_child,
                                                   const std::string& parent,
                                                   const std_msgs::Header& child) {
  const geometry_msgs::Pose pose = ToPoseMessage(T_parent_child);
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = child.stamp;
  transform.header.frame_id = parent;
  transform.child_frame_id = child.frame_id;
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.translation.z = pose.position.z;
  transform.transform.rotation = pose.orientation;
  return transform;
}

geometry_msgs::PoseWithCovariance ToPoseWithCovariance(const Eigen::Isometry3d& T,
                                                       const Matrix6d& covariance) {
  geometry_msgs::PoseWithCovariance pose;
  pose.pose = ToPoseMessage(T);
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(pose.covariance.data()) = covariance;
  return pose;
}

}  // namespace posefusion
