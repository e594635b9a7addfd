#include "posefusion/image/depth_units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(DepthUnits, MillimetresBecomeMetres) {
  const cv::Mat raw = (cv::Mat_<std::uint16_t>(1, 3) << 0, 1, 65535);
  const cv::Mat depth_m = DepthToMetres(raw, "depth");
  EXPECT_EQ(depth_m.type(), CV_32FC1);
  EXPECT_EQ(depth_m.at<float>(0), 0);
  EXPECT_FLOAT_EQ(depth_m.at<float>(1), 0.001F);
  EXPECT_FLOAT_EQ(depth_m.at<float>(2), 65.535F);
}

TEST(DepthUnits, AnyScaleIsAccepted) {
  const cv::Mat raw = (cv::Mat_<std::uint16_t>(1, 1) << 7500);
  EXPECT_FLOAT_EQ(DepthToMetres(raw, "depth", 5000).at<float>(0), 1.5F);
}

TEST(DepthUnits, InvalidFloatsBecomeZero) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const cv::Mat raw = (cv::Mat_<float>(1, 6) << kNan, kInfinity, -kInfinity, -1, 0, 2.5F);
  const cv::Mat depth_m = DepthToMetres(raw, "depth");
  for (int u = 0; u < 5; ++u) EXPECT_EQ(depth_m.at<float>(u), 0) << u;
  EXPECT_EQ(depth_m.at<float>(5), 2.5F);
  EXPECT_NE(depth_m.data, raw.data);
}

TEST(DepthUnits, WorksOnRowsWithGaps) {
  const cv::Mat raw(4, 6, CV_16UC1, cv::Scalar(1000));
  const cv::Mat depth_m = DepthToMetres(raw(cv::Rect(1, 1, 3, 2)), "depth");
  EXPECT_EQ(depth_m.size(), cv::Size(3, 2));
  EXPECT_EQ(cv::countNonZero(depth_m == 1.0), 6);
}

TEST(DepthUnits, RefusesOtherTypesNamingSourceAndType) {
  EXPECT_THAT(
      [] { DepthToMetres(cv::Mat(2, 2, CV_8UC3), "camera/depth"); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("camera/depth"), HasSubstr("8UC3"))));
  EXPECT_THROW(DepthToMetres(cv::Mat(2, 2, CV_64FC1), "depth"), std::invalid_argument);
  EXPECT_THROW(DepthToMetres(cv::Mat(2, 2, CV_16UC1), "depth", 0), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
