#include "posefusion_ros/conversions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <boost/make_shared.hpp>
#include <boost/weak_ptr.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "posefusion_ros/shared_image.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

sensor_msgs::ImagePtr MakeImage(const std::string& encoding, std::uint32_t pixel_bytes) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->width = 4;
  image->height = 2;
  image->encoding = encoding;
  image->step = 4 * pixel_bytes + 4;  // rows may be padded
  image->data.assign(image->step * 2U, 0);
  for (std::size_t i = 0; i < image->data.size(); ++i) {
    image->data[i] = static_cast<std::uint8_t>(i);
  }
  return image;
}

sensor_msgs::CameraInfo MakeInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D = {0.1, -0.2, 0.001, 0.002, 0.3};
  info.K = {500, 0, 320, 0, 501, 240, 0, 0, 1};
  info.P = {490, 0, 321, 0, 0, 491, 241, 0, 0, 0, 1, 0};
  return info;
}

void ExpectInfoRefused(const sensor_msgs::CameraInfo& info, const std::string& why) {
  EXPECT_THAT([&] { ToCameraModel(info, false, "/cam/info"); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("/cam/info"), HasSubstr(why))));
}

TEST(Conversions, StampsAreExact) {
  for (const StampNs stamp : {0LL, 1'305'031'102'175'304'123LL}) {
    EXPECT_EQ(ToStampNs(ToRosTime(stamp)), stamp);
  }
}

TEST(Conversions, Rgb8SharesPixelsAndHoldsTheMessage) {
  auto image = MakeImage("rgb8", 3);
  const std::uint8_t* const pixels = image->data.data();
  const boost::weak_ptr<sensor_msgs::Image> watched(image);
  cv::Mat rgb = ToRgb(image, "/rgb");
  EXPECT_EQ(rgb.data, pixels);
  EXPECT_EQ(rgb.step, image->step);
  image.reset();
  cv::Mat part = rgb(cv::Rect(1, 0, 2, 2));
  rgb.release();
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(part.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 4, 5));
  part.release();
  EXPECT_TRUE(watched.expired());
}

TEST(Conversions, OtherColourEncodingsAreConverted) {
  EXPECT_EQ(ToRgb(MakeImage("bgr8", 3), "").at<cv::Vec3b>(0, 1), cv::Vec3b(5, 4, 3));
  EXPECT_EQ(ToRgb(MakeImage("rgba8", 4), "").at<cv::Vec3b>(0, 1), cv::Vec3b(4, 5, 6));
  EXPECT_EQ(ToRgb(MakeImage("bgra8", 4), "").at<cv::Vec3b>(0, 1), cv::Vec3b(6, 5, 4));
  EXPECT_EQ(ToRgb(MakeImage("mono8", 1), "").at<cv::Vec3b>(1, 1), cv::Vec3b(9, 9, 9));
}

TEST(Conversions, DepthBecomesMetresWithZeroForNone) {
  auto metres = MakeImage("32FC1", 4);
  const std::array<float, 4> row = {1.5F, std::numeric_limits<float>::quiet_NaN(), -1.0F,
                                    std::numeric_limits<float>::infinity()};
  std::memcpy(metres->data.data(), row.data(), sizeof row);
  const cv::Mat from_metres = ToDepthM(metres, "");
  EXPECT_EQ(from_metres.at<float>(0, 0), 1.5F);
  for (int u = 1; u < 4; ++u) EXPECT_EQ(from_metres.at<float>(0, u), 0.0F) << u;

  auto millimetres = MakeImage("16UC1", 2);
  const std::uint16_t two_metres = 2000;
  std::memcpy(millimetres->data.data(), &two_metres, sizeof two_metres);
  EXPECT_FLOAT_EQ(ToDepthM(millimetres, "").at<float>(0, 0), 2.0F);
}

TEST(Conversions, UnknownEncodingsAndTornImagesAreRefusedByName) {
  EXPECT_THAT(
      [] { ToRgb(MakeImage("yuv422", 2), "/cam/rgb"); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("/cam/rgb"), HasSubstr("yuv422"))));
  EXPECT_THAT(
      [] { ToDepthM(MakeImage("mono8", 1), "/cam/depth"); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("/cam/depth"), HasSubstr("mono8"))));
  auto torn = MakeImage("rgb8", 3);
  torn->data.resize(5);
  EXPECT_THROW(ToRgb(torn, ""), std::invalid_argument);
  auto empty = MakeImage("rgb8", 3);
  empty->width = 0;
  EXPECT_THROW(ToRgb(empty, ""), std::invalid_argument);
  auto swapped = MakeImage("16UC1", 2);
  swapped->is_bigendian = 1;
  EXPECT_THROW(ToDepthM(swapped, ""), std::invalid_argument);
}

TEST(Conversions, CameraInfoGivesIntrinsicsAndDistortion) {
  const CameraModel camera = ToCameraModel(MakeInfo(), false, "");
  EXPECT_EQ(camera.fx, 500);
  EXPECT_EQ(camera.fy, 501);
  EXPECT_EQ(camera.cx, 320);
  EXPECT_EQ(camera.cy, 240);
  EXPECT_EQ(camera.distortion, (std::array<double, 5>{0.1, -0.2, 0.001, 0.002, 0.3}));
}

TEST(Conversions, RectifiedImagesUseTheProjectionMatrix) {
  const CameraModel camera = ToCameraModel(MakeInfo(), true, "");
  EXPECT_EQ(camera.fx, 490);
  EXPECT_EQ(camera.cy, 241);
  EXPECT_FALSE(camera.HasDistortion());
}

TEST(Conversions, UnusableCameraInfoIsRefusedByName) {
  auto info = MakeInfo();
  info.distortion_model = "equidistant";
  ExpectInfoRefused(info, "equidistant");
  info = MakeInfo();
  info.K.fill(0);
  ExpectInfoRefused(info, "not calibrated");
  info = MakeInfo();
  info.binning_x = 2;
  ExpectInfoRefused(info, "binning");
  info = MakeInfo();
  info.width = 0;
  ExpectInfoRefused(info, "size");
}

TEST(Conversions, DistortionModelDoesNotMatterWithoutDistortion) {
  auto info = MakeInfo();
  info.distortion_model = "";
  info.D.clear();
  EXPECT_FALSE(ToCameraModel(info, false, "").HasDistortion());
}

TEST(Conversions, PoseAndCovarianceKeepTheirOrder) {
  Eigen::Isometry3d T(Eigen::Translation3d(1, 2, 3));
  T.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  Matrix6d covariance;
  for (int i = 0; i < 36; ++i) covariance(i / 6, i % 6) = i;
  const auto pose = ToPoseWithCovariance(T, covariance);
  EXPECT_EQ(pose.pose.position.z, 3);
  EXPECT_NEAR(pose.pose.orientation.w, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pose.pose.orientation.z, std::sqrt(0.5), 1e-12);
  for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(pose.covariance[i], static_cast<double>(i));
}

TEST(Conversions, StaticDepthHasNoneWherePeopleAreAndComesBackExactly) {
  const cv::Mat depth_m = (cv::Mat_<float>(2, 2) << 1.25F, 0, 2.5F, 3.1F);
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(2, 2) << 0, 0, 255, 0);
  const auto message = ToStaticDepthMessage(depth_m, mask, {});
  EXPECT_EQ(message->encoding, "32FC1");
  EXPECT_TRUE(std::isnan(ShareImage(message, CV_32FC1, "").at<float>(1, 0)));
  const cv::Mat expected = (cv::Mat_<float>(2, 2) << 1.25F, 0, 0, 3.1F);
  EXPECT_EQ(cv::countNonZero(ToDepthM(message, "") != expected), 0);
}

TEST(Conversions, MasksComeBackExactlyAndOthersAreRefused) {
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(2, 3) << 0, 255, 0, 0, 0, 255);
  const auto message = ToMaskMessage(mask, {});
  EXPECT_EQ(message->encoding, "mono8");
  EXPECT_EQ(cv::countNonZero(ToMask(message, "") != mask), 0);
  message->encoding = "rgb8";
  EXPECT_THROW(ToMask(message, "/static/mask"), std::invalid_argument);
}

TEST(Conversions, EmptyMaskOfATornImageTakesNoMemory) {
  sensor_msgs::Image rgb;
  rgb.width = rgb.height = 0xFFFFFFFF;
  EXPECT_EQ(EmptyMaskMessage(rgb)->data.size(), 0U);
  rgb.width = rgb.height = 2;
  rgb.data.resize(12);
  EXPECT_EQ(EmptyMaskMessage(rgb)->data, std::vector<std::uint8_t>(4, 0));
}

TEST(Conversions, CloudCarriesEveryField) {
  SurfelCloud cloud;
  cloud.position_m = {{1, 2, 3}, {4, 5, 6}};
  cloud.normal = {{0, 0, 1}, {0, 1, 0}};
  cloud.rgb = {{10, 20, 30}, {255, 0, 1}};
  cloud.radius_m = {0.01F, 0.02F};
  cloud.confidence = {3, 4};
  std_msgs::Header header;
  header.frame_id = "map";
  const auto message = ToPointCloud2(cloud, header);
  EXPECT_EQ(message->width, 2U);
  EXPECT_EQ(message->header.frame_id, "map");
  sensor_msgs::PointCloud2ConstIterator<float> z(*message, "z");
  sensor_msgs::PointCloud2ConstIterator<float> normal_y(*message, "normal_y");
  sensor_msgs::PointCloud2ConstIterator<float> confidence(*message, "confidence");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> red(*message, "r");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> blue(*message, "b");
  EXPECT_EQ(*z, 3);
  EXPECT_EQ(*red, 10);
  EXPECT_EQ(*blue, 30);
  EXPECT_EQ(*(normal_y + 1), 1);
  EXPECT_EQ(*(confidence + 1), 4);
}

}  // namespace
}  // namespace posefusion
