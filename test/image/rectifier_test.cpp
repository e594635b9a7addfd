#include "posefusion/image/rectifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace posefusion {
namespace {

constexpr int kStepPx = 40;

CameraModel Freiburg1() {
  CameraModel camera{640, 480, 517.306408, 516.469215, 318.643040, 255.313989, {}};
  camera.distortion = {0.262383, -0.953104, -0.005358, 0.002628, 1.163314};
  return camera;
}

/// Where a pixel of the distorted image must lie after rectification, by OpenCV's own inverse.
cv::Point2d UndistortedPixel(const CameraModel& camera, const cv::Point2d& pixel) {
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  std::vector<cv::Point2d> result;
  cv::undistortPoints(std::vector<cv::Point2d>{pixel}, result, K, distortion, cv::noArray(), K);
  return result.front();
}

/// A frame with a coded colour, depth and mask value at every pixel: smooth in u and v.
RgbdFrame RampFrame(const CameraModel& camera) {
  RgbdFrame frame;
  frame.camera = camera;
  frame.rgb.create(camera.height, camera.width, CV_8UC3);
  frame.depth_m.create(camera.height, camera.width, CV_32FC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      frame.rgb.at<cv::Vec3b>(v, u) =
          cv::Vec3b(cv::saturate_cast<uchar>(u * 0.3), cv::saturate_cast<uchar>(v * 0.4), 100);
      frame.depth_m.at<float>(v, u) = static_cast<float>(1000 + u);
    }
  }
  return frame;
}

TEST(Rectifier, MovesPixelsToWhereUndistortPointsPutsThem) {
  const CameraModel camera = Freiburg1();
  const RgbdFrame frame = RampFrame(camera);
  const RgbdFrame rectified = Rectifier(camera).Rectify(frame);
  int num_checked = 0;
  for (int v = kStepPx; v < camera.height - kStepPx; v += kStepPx) {
    for (int u = kStepPx; u < camera.width - kStepPx; u += kStepPx) {
      const cv::Point2d target = UndistortedPixel(camera, cv::Point2d(u, v));
      const cv::Point pixel(cvRound(target.x), cvRound(target.y));
      // Half a pixel of rounding on either side, and one of the ramp.
      EXPECT_NEAR(rectified.depth_m.at<float>(pixel), 1000 + u, 1.1) << u << " " << v;
      EXPECT_NEAR(rectified.rgb.at<cv::Vec3b>(pixel)[0], 0.3 * u, 1.1) << u << " " << v;
      EXPECT_NEAR(rectified.rgb.at<cv::Vec3b>(pixel)[1], 0.4 * v, 1.1) << u << " " << v;
      ++num_checked;
    }
  }
  EXPECT_GT(num_checked, 100);
}

TEST(Rectifier, NearestDepthIsWithoutHalfPixelShift) {
  const CameraModel camera = Freiburg1();
  const RgbdFrame rectified = Rectifier(camera).Rectify(RampFrame(camera));
  double error_sum = 0;
  int num_checked = 0;
  for (int v = 40; v < camera.height - 40; ++v) {
    for (int u = 40; u < camera.width - 40; u += 7) {
      // The ramp in depth codes the column it was taken from; the bilinear one is exact.
      const double source_u = rectified.depth_m.at<float>(v, u) - 1000;
      const double x = (u - camera.cx) / camera.fx;
      const double y = (v - camera.cy) / camera.fy;
      const double r2 = x * x + y * y;
      const auto& d = camera.distortion;
      const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
      const double expected_x = x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x);
      error_sum += source_u - (camera.fx * expected_x + camera.cx);
      ++num_checked;
    }
  }
  constexpr double kMeanTolerancePx = 0.02;  ///< a floor instead of rounding would give 0.5
  EXPECT_NEAR(error_sum / num_checked, 0, kMeanTolerancePx);
}

TEST(Rectifier, OutsideIsBlackWithoutDepthAndNobody) {
  CameraModel camera = Freiburg1();
  camera.distortion = {0.4, 0, 0, 0, 0};  // pincushion: the corners come from outside
  RgbdFrame frame = RampFrame(camera);
  frame.depth_m.setTo(2.0);
  const Rectifier rectifier(camera);
  const RgbdFrame rectified = rectifier.Rectify(frame);
  EXPECT_EQ(rectified.depth_m.at<float>(0, 0), 0);
  EXPECT_EQ(rectified.rgb.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(rectifier.Rectify(PeopleInFrame{cv::Mat(480, 640, CV_8UC1, cv::Scalar(255)), {}})
                .mask.at<uchar>(0, 0),
            0);
  cv::Mat valid;
  cv::inRange(rectified.depth_m, 1.999, 2.001, valid);
  EXPECT_EQ(cv::countNonZero(valid), cv::countNonZero(rectified.depth_m)) << "depths were mixed";
}

TEST(Rectifier, WithoutDistortionNothingIsCopied) {
  const CameraModel camera = Freiburg1().Undistorted();
  const RgbdFrame frame = RampFrame(camera);
  const cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
  const Rectifier rectifier(camera);
  EXPECT_EQ(rectifier.Rectify(frame).rgb.data, frame.rgb.data);
  EXPECT_EQ(rectifier.Rectify(frame).depth_m.data, frame.depth_m.data);
  EXPECT_EQ(rectifier.Rectify(PeopleInFrame{mask, {}}).mask.data, mask.data);
}

TEST(Rectifier, EarlierFramesStayAsTheyWere) {
  const CameraModel camera = Freiburg1();
  const Rectifier rectifier(camera);
  RgbdFrame frame = RampFrame(camera);
  const RgbdFrame first = rectifier.Rectify(frame);
  const cv::Mat copy = first.rgb.clone();
  frame.rgb = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(255));
  const RgbdFrame second = rectifier.Rectify(frame);
  EXPECT_NE(first.rgb.data, second.rgb.data);
  EXPECT_EQ(cv::norm(first.rgb, copy), 0);
  EXPECT_EQ(second.camera, camera.Undistorted());
}

TEST(Rectifier, RefusesAnotherCamera) {
  const Rectifier rectifier(Freiburg1());
  CameraModel other = Freiburg1();
  other.fx += 1;
  EXPECT_THROW(rectifier.Rectify(RampFrame(other)), std::invalid_argument);
  EXPECT_THROW(rectifier.Rectify(PeopleInFrame{cv::Mat(10, 10, CV_8UC1), {}}),
               std::invalid_argument);
  EXPECT_TRUE(rectifier.Rectify(PeopleInFrame{}).mask.empty());
  EXPECT_THROW(Rectifier(CameraModel{}), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
