#include "posefusion/image/rgbd_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

RgbdFrame GoodFrame() {
  RgbdFrame frame;
  frame.rgb = cv::Mat::zeros(24, 32, CV_8UC3);
  frame.depth_m = cv::Mat::zeros(24, 32, CV_32FC1);
  frame.camera = {32, 24, 25, 25, 16, 12, {}};
  return frame;
}

void ExpectRefused(const RgbdFrame& frame, const std::string& message) {
  EXPECT_THAT([&] { CheckFrame(frame, "frame 7"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("frame 7: " + message)));
}

TEST(RgbdFrame, FittingImagesPass) { EXPECT_NO_THROW(CheckFrame(GoodFrame(), "frame 7")); }

TEST(RgbdFrame, WrongTypesAndSizesAreNamed) {
  RgbdFrame frame = GoodFrame();
  frame.rgb = cv::Mat::zeros(24, 32, CV_8UC1);
  ExpectRefused(frame, "colour is not 8UC3");
  frame = GoodFrame();
  frame.depth_m = cv::Mat::zeros(24, 32, CV_16UC1);
  ExpectRefused(frame, "depth is not 32FC1");
  frame = GoodFrame();
  frame.depth_m = cv::Mat::zeros(12, 16, CV_32FC1);
  ExpectRefused(frame, "depth has 16x12 pixels, the camera 32x24");
  frame = GoodFrame();
  frame.rgb = cv::Mat();
  EXPECT_THROW(CheckFrame(frame, "frame 7"), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
